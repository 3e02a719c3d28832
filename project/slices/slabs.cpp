#include "project/slices/slabs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetraglass::project::slices {
namespace {

using Eigen::Vector3d;

/// Multiples of `step` from `middle`: the last not above `low` to the first not below `high`.
std::vector<double> multiples(double middle, double step, double low, double high) {
  std::vector<double> result;
  const double first = std::floor((low - middle) / step);
  const double last = std::ceil((high - middle) / step);
  for (double k = first; k <= last; ++k) result.push_back(middle + k * step);
  return result;
}

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

std::vector<Slab> planes(const GridView& view, double distance) {
  Range depth;
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& corner : view.corners({})) {
    depth.include(corner.z());
    middle += corner / 8;
  }
  if (!view.parallel()) depth.low = std::max(depth.low, 0.0);
  std::vector<Slab> result;
  if (!(depth.low < depth.high)) return result;
  const std::vector<double> at = multiples(middle.z(), distance, depth.low, depth.high);
  for (std::size_t i = at.size() - 1; i > 0; --i) {
    result.push_back(
        {{static_cast<float>(at[i - 1] - view.focus()), static_cast<float>(at[i] - view.focus())},
         {at[i - 1], at[i]}});
  }
  return result;
}

std::vector<Slab> shells(const GridView& view, double distance) {
  Range far;
  Vector3d middle = Vector3d::Zero();
  double deepest = 0;
  for (const Vector3d& corner : view.corners({})) {
    far.include(corner.norm());
    deepest = std::max(deepest, corner.z());
    middle += corner / 8;
  }
  std::vector<Slab> result;
  if (!(deepest > 0)) return result;
  // All of the grid is within 1 of its centre.
  const double nearest = std::max(middle.norm() - 1, 0.0);
  const std::vector<double> at = multiples(middle.norm(), distance, nearest, far.high);
  for (std::size_t i = at.size() - 1; i > 0; --i) {
    result.push_back(
        {{static_cast<float>(at[i - 1] - view.focus()), static_cast<float>(at[i] - view.focus())},
         {at[i - 1] / view.most_stretch(), at[i]}});
  }
  return result;
}

/// Half way between the points of an axis, and its ends.
std::vector<double> between_points(const std::vector<double>& row) {
  std::vector<double> result = {-1};
  for (std::size_t i = 0; i + 1 < row.size(); ++i) {
    result.push_back((row[i] + row[i + 1]) / row.back() - 1);
  }
  result.push_back(1);
  return result;
}

std::vector<Slab> textures(const GridView& view, const mesh::RectilinearGrid& grid,
                           double distance) {
  constexpr double kAll = std::numeric_limits<double>::infinity();
  const int axis = view.stack_axis();
  const std::vector<double> at =
      distance > 0 ? multiples(0, distance / view.plane_distance(axis), -1, 1)
                   : between_points(grid.coordinates[static_cast<std::size_t>(axis)]);
  std::vector<Slab> result;
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    result.push_back({{static_cast<float>(at[i]), static_cast<float>(at[i + 1])},
                      {-kAll, kAll},
                      std::max(at[i], -1.0),
                      std::min(at[i + 1], 1.0)});
  }
  if (view.parallel()) {
    if (view.away()[axis] > 0) std::ranges::reverse(result);
    return result;
  }
  // Rays go away from the eye on either side of it.
  const double eye = view.eye()[axis];
  std::ranges::stable_sort(result, std::greater<>(), [&](const Slab& slab) {
    return std::abs(slab.low + slab.high - 2 * eye);
  });
  return result;
}

}  // namespace

std::vector<Slab> make_slabs(const GridView& view, const mesh::RectilinearGrid& grid, Stack stack,
                             double distance) {
  if (stack == Stack::textures) return textures(view, grid, distance);
  if (stack == Stack::shells && !view.parallel()) return shells(view, distance);
  return planes(view, distance);
}

}  // namespace tetraglass::project::slices
