#include "mesh/weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <unordered_map>
#include <utility>

#include "base/errors.h"
#include "mesh/cell_shapes.h"

namespace tetraglass::mesh {
namespace {

using Eigen::Vector3d;

/// A cube of the grid that points are sorted into.
using Cube = std::array<std::int64_t, 3>;

struct CubeHash {
  std::size_t operator()(const Cube& cube) const {
    std::uint64_t hash = 0;
    for (const std::int64_t i : cube) {
      hash = (hash ^ static_cast<std::uint64_t>(i)) * 0x9e3779b97f4a7c15U;
      hash ^= hash >> 29U;
    }
    return hash;
  }
};

class NearPoints {
 public:
  NearPoints(const std::vector<Vector3d>& points, double distance)
      : points_(points), distance_(distance) {
    double largest = 0;
    for (const Vector3d& p : points) {
      if (p.allFinite()) largest = std::max(largest, p.cwiseAbs().maxCoeff());
    }
    // Cubes are numbered in 64 bits; one of the side `distance` has all near points around it.
    constexpr double kMostCubes = 0x1p52;
    side_ = std::max({distance, largest / kMostCubes, std::numeric_limits<double>::min()});
    cubes_.reserve(points.size());
  }

  /// The first point kept that is near to point i, or i, which is kept then.
  std::uint32_t keep(std::uint32_t i) {
    const Vector3d& p = points_[i];
    if (!p.allFinite()) return i;
    const Cube home = cube_of(p);
    std::uint32_t first = i;
    const std::int64_t reach = distance_ > 0 ? 1 : 0;
    for (std::int64_t x = -reach; x <= reach; ++x) {
      for (std::int64_t y = -reach; y <= reach; ++y) {
        for (std::int64_t z = -reach; z <= reach; ++z) {
          const auto found = cubes_.find({home[0] + x, home[1] + y, home[2] + z});
          if (found == cubes_.end()) continue;
          for (std::uint32_t j = found->second; j != kNone; j = next_[j]) {
            if (j < first && (points_[j] - p).stableNorm() <= distance_) first = j;
          }
        }
      }
    }
    if (first == i) {
      const auto [entry, is_new] = cubes_.try_emplace(home, i);
      next_.resize(points_.size(), kNone);
      if (!is_new) next_[i] = std::exchange(entry->second, i);
    }
    return first;
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  [[nodiscard]] Cube cube_of(const Vector3d& p) const {
    Cube cube{};
    for (std::size_t k = 0; k < 3; ++k) {
      cube[k] = static_cast<std::int64_t>(std::floor(p[static_cast<Eigen::Index>(k)] / side_));
    }
    return cube;
  }

  const std::vector<Vector3d>& points_;
  const double distance_;
  double side_ = 1;
  std::unordered_map<Cube, std::uint32_t, CubeHash> cubes_;  ///< the last point in each
  std::vector<std::uint32_t> next_;                          ///< the one before it there
};

/// Calls f(index) for each point of a cell that connectivity names, by reference.
template <typename Connectivity, typename F>
void for_each_point(CellType type, Connectivity cell, const F& f) {
  if (type != CellType::polyhedron) {
    for (auto& i : cell) f(i);
    return;
  }
  for (std::size_t at = 1; at < cell.size();) {
    const std::size_t count = std::min<std::size_t>(cell[at], cell.size() - at - 1);
    for (std::size_t k = 1; k <= count; ++k) f(cell[at + k]);
    at += count + 1;
  }
}

bool has_collapsed(CellType type, std::span<const std::uint32_t> cell) {
  const int d = dimension(type);
  if (d < 1) return false;
  std::vector<std::uint32_t> points;
  for_each_point(type, cell, [&](std::uint32_t i) { points.push_back(i); });
  const CellShape* shape = find_shape(type);
  const auto corners = static_cast<std::size_t>(shape->corners);
  const auto needed = static_cast<std::size_t>(d) + 1;
  if (corners == needed && points.size() >= corners) points.resize(corners);  // a simplex
  std::ranges::sort(points);
  points.erase(std::ranges::unique(points).begin(), points.end());
  return points.size() < needed;
}

/// The values of the tuples that are kept.
void keep_tuples(Field& field, const std::vector<bool>& kept) {
  const auto n = static_cast<std::size_t>(field.components);
  if (field.values.size() != n * kept.size()) return;  // told where the field is used
  std::size_t out = 0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (!kept[i]) continue;
    for (std::size_t c = 0; c < n; ++c) field.values[out++] = field.values[i * n + c];
  }
  field.values.resize(out);
}

void check_indices(const MeshData& data) {
  for (std::size_t i = 0; i < data.cell_count(); ++i) {
    for_each_point(data.types[i], data.cell(i), [&](std::uint32_t p) {
      if (p >= data.points.size()) {
        throw base::InputError("cell " + std::to_string(i) + " names point " + std::to_string(p) +
                               ", but there are " + std::to_string(data.points.size()) + " points");
      }
    });
  }
}

std::size_t drop_collapsed(MeshData& data) {
  std::vector<bool> kept(data.cell_count(), true);
  std::size_t dropped = 0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    kept[i] = !has_collapsed(data.types[i], data.cell(i));
    dropped += kept[i] ? 0 : 1;
  }
  if (dropped == 0) return 0;
  MeshData left;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (kept[i]) left.add_cell(data.types[i], data.cell(i));
  }
  data.types = std::move(left.types);
  data.offsets = std::move(left.offsets);
  data.connectivity = std::move(left.connectivity);
  for (Field& field : data.fields) {
    if (field.location == Location::cell) keep_tuples(field, kept);
  }
  return dropped;
}

}  // namespace

Welding weld(MeshData& data, double distance) {
  check_indices(data);
  NearPoints near(data.points, distance);
  std::vector<std::uint32_t> number(data.points.size());
  std::vector<bool> kept(data.points.size());
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < number.size(); ++i) {
    const std::uint32_t first = near.keep(i);
    kept[i] = first == i;
    number[i] = kept[i] ? count++ : number[first];
  }
  Welding welding;
  welding.merged = data.points.size() - count;
  if (welding.merged == 0) return welding;
  for (std::size_t i = 0; i < data.cell_count(); ++i) {
    const std::span<std::uint32_t> cell(data.connectivity.data() + data.offsets[i],
                                        data.connectivity.data() + data.offsets[i + 1]);
    for_each_point(data.types[i], cell, [&](std::uint32_t& p) { p = number[p]; });
  }
  std::size_t out = 0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (kept[i]) data.points[out++] = data.points[i];
  }
  data.points.resize(out);
  for (Field& field : data.fields) {
    if (field.location == Location::point) keep_tuples(field, kept);
  }
  welding.collapsed = drop_collapsed(data);
  return welding;
}

std::size_t unused_points(const MeshData& data) {
  std::vector<bool> used(data.points.size(), false);
  for (std::size_t i = 0; i < data.cell_count(); ++i) {
    for_each_point(data.types[i], data.cell(i), [&](std::uint32_t p) {
      if (p < used.size()) used[p] = true;
    });
  }
  return static_cast<std::size_t>(std::ranges::count(used, false));
}

}  // namespace tetraglass::mesh
