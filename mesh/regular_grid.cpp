#include "mesh/regular_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/LU>
#include <fmt/format.h>

#include "base/errors.h"
#include "base/suggest.h"

namespace tetraglass::mesh {
namespace {

using Eigen::Vector3d;

/// Size, origin and axes of the grid of points.
class GridFinder {
 public:
  explicit GridFinder(const MeshData& data) : points_(data.points) {
    Vector3d largest = Vector3d::Zero();
    for (const Vector3d& p : points_) largest = largest.cwiseMax(p.cwiseAbs());
    // Coordinates may have been computed, or stored, in single precision.
    constexpr double kRounding = 0x1p-22;
    tolerance_ = kRounding * largest.maxCoeff();
  }

  Volume find() {
    Volume grid;
    const std::size_t nx = run(1);
    const std::size_t ny = points_.size() % nx == 0 ? run(nx) : 1;
    const std::size_t nz = points_.size() % (nx * ny) == 0 ? points_.size() / (nx * ny) : 1;
    if (nx < 2 || ny < 2 || nz < 2 || nx * ny * nz != points_.size()) fail();
    grid.size = {nx, ny, nz};
    grid.origin = points_[0];
    grid.axes.col(0) = (points_[nx - 1] - points_[0]) / static_cast<double>(nx - 1);
    grid.axes.col(1) = (points_[nx * (ny - 1)] - points_[0]) / static_cast<double>(ny - 1);
    grid.axes.col(2) = (points_[nx * ny * (nz - 1)] - points_[0]) / static_cast<double>(nz - 1);
    if (!(std::abs(grid.axes.determinant()) > 0)) fail();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Vector3d at(static_cast<double>(i % nx), static_cast<double>(i / nx % ny),
                        static_cast<double>(i / (nx * ny)));
      if (!((points_[i] - grid.origin - grid.axes * at).cwiseAbs().maxCoeff() <= tolerance_)) {
        fail();
      }
    }
    return grid;
  }

 private:
  [[noreturn]] static void fail() {
    throw base::InputError("its points are not those of a regular grid, as images have them");
  }

  /// How many points, `stride` apart in the list, follow each other in even steps.
  [[nodiscard]] std::size_t run(std::size_t stride) const {
    if (points_.size() <= stride) fail();
    const Vector3d step = points_[stride] - points_[0];
    std::size_t count = 2;
    while (count * stride < points_.size()) {
      const Vector3d expected = points_[(count - 1) * stride] + step;
      if (!((points_[count * stride] - expected).cwiseAbs().maxCoeff() <= 4 * tolerance_)) break;
      ++count;
    }
    return count;
  }

  const std::vector<Vector3d>& points_;
  double tolerance_ = 0;
};

const Field& chosen_field(const MeshData& data, const std::string& name) {
  std::vector<std::string> known;
  for (const Field& field : data.fields) {
    if (name.empty() ? field.components == 1 : field.name == name) return field;
    known.push_back(field.name);
  }
  if (name.empty()) throw base::InputError("holds no scalar field");
  throw base::InputError(fmt::format("no field '{}'{}", name, base::suggestion(name, known)));
}

}  // namespace

Volume regular_grid(const MeshData& data, const std::string& name) {
  Volume grid = GridFinder(data).find();
  const Field& field = chosen_field(data, name);
  grid.name = field.name;
  if (field.location == Location::cell) {
    grid.origin += 0.5 * grid.axes.rowwise().sum();
    for (std::size_t& n : grid.size) --n;
    if (*std::ranges::min_element(grid.size) < 2) {
      throw base::InputError("a field of the cells of an image needs two cells along each axis");
    }
  }
  if (field.tuples() != grid.points()) {
    throw base::InputError(fmt::format("the field '{}' has {} values instead of {}", field.name,
                                       field.tuples(), grid.points()));
  }
  grid.values.reserve(grid.points());
  for (std::size_t i = 0; i < grid.points(); ++i) {
    grid.values.push_back(field.values[i * static_cast<std::size_t>(field.components)]);
  }
  return grid;
}

void interpolate(const Volume& grid, std::span<const double> values, int components,
                 const Vector3d& place, std::span<double> result) {
  const Vector3d at = grid.axes.partialPivLu().solve(place - grid.origin);
  std::array<std::size_t, 3> low{};
  std::array<double, 3> part{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto last = static_cast<double>(grid.size[k] - 1);
    const double t = std::clamp(at[static_cast<Eigen::Index>(k)], 0.0, last);
    low[k] = static_cast<std::size_t>(std::min(std::floor(t), last - 1));
    part[k] = t - static_cast<double>(low[k]);
  }
  std::ranges::fill(result, 0.0);
  for (std::size_t corner = 0; corner < 8; ++corner) {
    double weight = 1;
    std::array<std::size_t, 3> i{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t up = corner >> k & 1U;
      weight *= up == 1 ? part[k] : 1 - part[k];
      i[k] = low[k] + up;
    }
    if (weight == 0) continue;  // a value there that is not finite does not matter
    const std::size_t point = (i[2] * grid.size[1] + i[1]) * grid.size[0] + i[0];
    for (std::size_t c = 0; c < result.size(); ++c) {
      result[c] += weight * values[point * static_cast<std::size_t>(components) + c];
    }
  }
}

}  // namespace tetraglass::mesh
