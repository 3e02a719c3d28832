#include "mesh/rectilinear_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "base/errors.h"

namespace tetraglass::mesh {
namespace {

using Eigen::Vector3d;

[[noreturn]] void fail() {
  throw base::InputError(
      "its points are not those of a uniform or rectilinear grid, which slices need: draw its "
      "cells (--projector auto)");
}

/// The straight row of points `stride` apart in the list, as long as it goes on: their distances
/// from the first.
class RowFinder {
 public:
  explicit RowFinder(const std::vector<Vector3d>& points) : points_(points) {
    Vector3d largest = Vector3d::Zero();
    for (const Vector3d& p : points_) largest = largest.cwiseMax(p.cwiseAbs());
    // Coordinates may have been computed, or stored, in single precision.
    constexpr double kRounding = 0x1p-22;
    tolerance_ = kRounding * largest.maxCoeff();
  }

  [[nodiscard]] double tolerance() const { return tolerance_; }

  /// Sets the axis of the grid to the row.
  void find(std::size_t stride, std::size_t axis, RectilinearGrid& grid) const {
    std::vector<double>& row = grid.coordinates[axis];
    row = {0};
    // The direction is best known from the farthest point: it is found again with every one.
    Vector3d direction = Vector3d::Zero();
    for (std::size_t i = stride; i < points_.size(); i += stride) {
      const Vector3d away = points_[i] - points_[0];
      const double distance = away.norm();
      if (!(distance > row.back())) break;
      if (row.size() > 1 &&
          !((away - distance * direction).norm() <= 8 * tolerance_ * (1 + distance / row.back()))) {
        break;
      }
      direction = away / distance;
      row.push_back(distance);
    }
    if (row.size() < 2) fail();
    const auto last = static_cast<double>(row.size() - 1);
    const double step = row.back() / last;
    grid.even[axis] = true;
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (!(std::abs(row[i] - static_cast<double>(i) * step) <= 4 * tolerance_)) {
        grid.even[axis] = false;
      }
    }
    grid.axes.col(static_cast<Eigen::Index>(axis)) = direction;
    if (!grid.even[axis]) return;
    grid.axes.col(static_cast<Eigen::Index>(axis)) *= step;
    for (std::size_t i = 0; i < row.size(); ++i) row[i] = static_cast<double>(i);
  }

 private:
  const std::vector<Vector3d>& points_;
  double tolerance_ = 0;
};

void check_points(const std::vector<Vector3d>& points, const RectilinearGrid& grid,
                  double tolerance) {
  const std::size_t nx = grid.size(0);
  const std::size_t ny = grid.size(1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3d at(grid.coordinates[0][i % nx], grid.coordinates[1][i / nx % ny],
                      grid.coordinates[2][i / (nx * ny)]);
    if (!((points[i] - grid.origin - grid.axes * at).cwiseAbs().maxCoeff() <= 8 * tolerance)) {
      fail();
    }
  }
}

/// Whether the tetrahedra lie in one voxel each and fill them all. In units of voxels six times the
/// volume of a tetrahedron is a whole number, and six are a voxel.
bool fills_voxels(const TetMesh& mesh, const RectilinearGrid& grid) {
  const std::size_t nx = grid.size(0);
  const std::size_t ny = grid.size(1);
  std::vector<std::uint8_t> filled((nx - 1) * (ny - 1) * (grid.size(2) - 1), 0);
  for (const Cell& cell : mesh.cells) {
    std::array<Eigen::Vector3i, 4> at;
    for (std::size_t v = 0; v < 4; ++v) {
      at[v] = {static_cast<int>(cell[v] % nx), static_cast<int>(cell[v] / nx % ny),
               static_cast<int>(cell[v] / (nx * ny))};
    }
    const Eigen::Vector3i low = at[0].cwiseMin(at[1]).cwiseMin(at[2].cwiseMin(at[3]));
    const Eigen::Vector3i high = at[0].cwiseMax(at[1]).cwiseMax(at[2].cwiseMax(at[3]));
    if ((high - low).maxCoeff() > 1) return false;
    if ((high - low).minCoeff() < 1) continue;  // no volume
    const auto voxel =
        (static_cast<std::size_t>(low.z()) * (ny - 1) + static_cast<std::size_t>(low.y())) *
            (nx - 1) +
        static_cast<std::size_t>(low.x());
    const int volume = std::abs((at[1] - at[0]).cross(at[2] - at[0]).dot(at[3] - at[0]));
    filled[voxel] = static_cast<std::uint8_t>(std::min(7, filled[voxel] + volume));
  }
  return std::ranges::all_of(filled, [](std::uint8_t sixths) { return sixths == 6; });
}

/// Whether there is one cell with all corners of a voxel in each.
bool fills_voxels(const MeshData& data, const RectilinearGrid& grid) {
  const std::size_t nx = grid.size(0);
  const std::size_t ny = grid.size(1);
  const std::size_t voxels = (nx - 1) * (ny - 1) * (grid.size(2) - 1);
  std::vector<bool> filled(data.points.size(), false);  // by the first point of a voxel
  std::size_t count = 0;
  for (std::size_t i = 0; i < data.cell_count(); ++i) {
    if (dimension(data.types[i]) < 3) continue;
    const std::span<const std::uint32_t> cell = data.cell(i);
    const bool box = data.types[i] == CellType::voxel || data.types[i] == CellType::hexahedron;
    if (!box || cell.size() != 8) return false;
    const std::size_t first = *std::ranges::min_element(cell);
    if (first >= data.points.size() || filled[first]) return false;
    unsigned corners = 0;
    for (const std::uint32_t point : cell) {
      for (unsigned corner = 0; corner < 8; ++corner) {
        const std::size_t step =
            (corner & 1U) + (corner >> 1U & 1U) * nx + (corner >> 2U & 1U) * nx * ny;
        if (point == first + step) corners |= 1U << corner;
      }
    }
    if (corners != 255) return false;
    filled[first] = true;
    ++count;
  }
  return count == voxels;
}

RectilinearGrid grid_of_points(const std::vector<Vector3d>& points) {
  if (points.size() < 8) fail();
  RectilinearGrid grid;
  grid.origin = points[0];
  const RowFinder rows(points);
  std::size_t stride = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    rows.find(stride, axis, grid);
    stride *= grid.size(axis);
    if (points.size() % stride != 0) fail();
  }
  if (stride != points.size() || grid.axes.determinant() == 0) fail();
  check_points(points, grid, rows.tolerance());
  return grid;
}

[[noreturn]] void fail_for_missing_voxels() {
  throw base::InputError(
      "some voxels of its grid are left out, which slices cannot draw: draw its cells "
      "(--projector auto)");
}

}  // namespace

Vector3d RectilinearGrid::index_at(const Vector3d& coordinate) const {
  Vector3d index;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::vector<double>& row = coordinates[k];
    const double x = std::clamp(coordinate[static_cast<Eigen::Index>(k)], row.front(), row.back());
    const auto above = std::upper_bound(row.begin() + 1, row.end() - 1, x);
    const double low = *(above - 1);
    index[static_cast<Eigen::Index>(k)] =
        static_cast<double>(above - row.begin() - 1) + (x - low) / (*above - low);
  }
  return index;
}

RectilinearGrid rectilinear_grid(const TetMesh& mesh) {
  RectilinearGrid grid = grid_of_points(mesh.points);
  if (!mesh.cells.empty() && !fills_voxels(mesh, grid)) fail_for_missing_voxels();
  return grid;
}

RectilinearGrid rectilinear_grid(const MeshData& data) {
  RectilinearGrid grid = grid_of_points(data.points);
  if (!fills_voxels(data, grid)) fail_for_missing_voxels();
  return grid;
}

double interpolate(const RectilinearGrid& grid, std::span<const double> values,
                   const Vector3d& index) {
  std::array<std::size_t, 3> low{};
  Vector3d part;
  for (std::size_t k = 0; k < 3; ++k) {
    const double at = index[static_cast<Eigen::Index>(k)];
    low[k] = std::min(static_cast<std::size_t>(at), grid.size(k) - 2);
    part[static_cast<Eigen::Index>(k)] = at - static_cast<double>(low[k]);
  }
  const std::size_t nx = grid.size(0);
  const std::size_t plane = nx * grid.size(1);
  const std::size_t first = low[2] * plane + low[1] * nx + low[0];
  const auto along_x = [&](std::size_t point) {
    return values[point] + part.x() * (values[point + 1] - values[point]);
  };
  const auto along_y = [&](std::size_t point) {
    const double at = along_x(point);
    return at + part.y() * (along_x(point + nx) - at);
  };
  const double at = along_y(first);
  return at + part.z() * (along_y(first + plane) - at);
}

}  // namespace tetraglass::mesh
