#include "project/slices/outline.h"

#include <algorithm>

namespace tetraglass::project::slices {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Polygon = std::vector<Vector2d>;

double cross(const Vector2d& o, const Vector2d& a, const Vector2d& b) {
  return (a - o).x() * (b - o).y() - (a - o).y() * (b - o).x();
}

/// Andrew's monotone chain. Of points that all coincide: one of them.
Polygon convex_hull(Polygon& points) {
  std::ranges::sort(points, [](const Vector2d& a, const Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  Polygon hull;
  const auto chain = [&](auto begin, auto end) {
    const std::size_t first = hull.size();
    for (auto point = begin; point != end; ++point) {
      while (hull.size() >= first + 2 && cross(hull[hull.size() - 2], hull.back(), *point) <= 0) {
        hull.pop_back();
      }
      hull.push_back(*point);
    }
    hull.pop_back();  // the next chain begins with it
  };
  chain(points.begin(), points.end());
  chain(points.rbegin(), points.rend());
  if (hull.empty()) hull.push_back(points.front());
  return hull;
}

/// The corners of the part between the depths: those of the whole and where its edges are cut.
void cut_corners(const std::array<Vector3d, 8>& corners, const Depths& depths,
                 std::vector<Vector3d>& result) {
  for (std::size_t i = 0; i < 8; ++i) {
    const Vector3d& a = corners[i];
    if (a.z() >= depths.near && a.z() <= depths.far) result.push_back(a);
    for (const std::size_t bit : {1U, 2U, 4U}) {
      if ((i & bit) != 0) continue;
      const Vector3d& b = corners[i | bit];
      for (const double depth : {depths.near, depths.far}) {
        if ((a.z() < depth) != (b.z() < depth)) {
          Vector3d point = a + (depth - a.z()) / (b.z() - a.z()) * (b - a);
          point.z() = depth;
          result.push_back(point);
        }
      }
    }
  }
}

/// The part of a convex polygon where sign * coordinate <= limit.
Polygon cut(const Polygon& polygon, int axis, double sign, double limit) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d& a = polygon[i];
    const Vector2d& b = polygon[(i + 1) % polygon.size()];
    const double over_a = sign * a[axis] - limit;
    const double over_b = sign * b[axis] - limit;
    if (over_a <= 0) result.push_back(a);
    if ((over_a <= 0) != (over_b <= 0)) result.push_back(a + over_a / (over_a - over_b) * (b - a));
  }
  return result;
}

Polygon whole(const gl::Tile& tile) {
  const double right = tile.width + 1;
  const double bottom = tile.height + 1;
  return {{-1, -1}, {right, -1}, {right, bottom}, {-1, bottom}};
}

}  // namespace

std::vector<Vector2d> outline(const GridView& view, const std::array<Vector3d, 8>& corners,
                              const Depths& depths, const gl::Tile& tile, double margin) {
  const auto [nearest, farthest] =
      std::ranges::minmax(corners, {}, [](const Vector3d& corner) { return corner.z(); });
  Depths seen{std::max(depths.near, nearest.z()), std::min(depths.far, farthest.z())};
  if (!(seen.near <= seen.far)) return {};
  if (!view.parallel()) {
    if (!(seen.far > 0)) return {};
    // What reaches the plane of the eye has no bounds on the screen, or none that numbers hold.
    constexpr double kNear = 1e-6;
    if (!(seen.near > kNear * seen.far)) return whole(tile);
  }
  std::vector<Vector3d> points;
  points.reserve(32);
  cut_corners(corners, seen, points);
  if (points.empty()) return {};
  Polygon images;
  for (const Vector3d& point : points) {
    images.push_back(view.pixel(point) - Vector2d(tile.x, tile.y));
  }
  Polygon polygon = convex_hull(images);
  images.clear();
  for (const Vector2d& at : polygon) {
    for (const double x : {-margin, margin}) {
      for (const double y : {-margin, margin}) images.emplace_back(at + Vector2d(x, y));
    }
  }
  polygon = convex_hull(images);
  polygon = cut(polygon, 0, -1, 1);
  polygon = cut(polygon, 0, 1, tile.width + 1);
  polygon = cut(polygon, 1, -1, 1);
  polygon = cut(polygon, 1, 1, tile.height + 1);
  return polygon.size() < 3 ? Polygon() : polygon;
}

}  // namespace tetraglass::project::slices
