#include "project/slices/outline.h"

#include <algorithm>

namespace tetraglass::project::slices {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Points, without an allocation: there are thousands of outlines in a frame.
template <class Point, std::size_t Most>
class Points {
 public:
  void add(const Point& point) { points_[size_++] = point; }
  void remove_last() { --size_; }
  void clear() { size_ = 0; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const Point& operator[](std::size_t i) const { return points_[i]; }
  [[nodiscard]] const Point& back() const { return points_[size_ - 1]; }
  [[nodiscard]] Point* begin() { return points_.data(); }
  [[nodiscard]] Point* end() { return points_.data() + size_; }
  [[nodiscard]] const Point* begin() const { return points_.data(); }
  [[nodiscard]] const Point* end() const { return points_.data() + size_; }

 private:
  std::array<Point, Most> points_;
  std::size_t size_ = 0;
};

// A box between two planes has at most 8 corners and 2 cuts of 12 edges; its outline with a margin
// four times as many; and a cut at the tile adds one at each of the four sides.
using Corners = Points<Vector3d, 32>;
using Polygon = Points<Vector2d, 136>;

double cross(const Vector2d& o, const Vector2d& a, const Vector2d& b) {
  return (a - o).x() * (b - o).y() - (a - o).y() * (b - o).x();
}

/// Andrew's monotone chain. Of points that all coincide: one of them.
Polygon convex_hull(Polygon& points) {
  std::sort(points.begin(), points.end(), [](const Vector2d& a, const Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  Polygon hull;
  const std::size_t count = points.size();
  const auto chain = [&](bool back) {
    const std::size_t first = hull.size();
    for (std::size_t i = 0; i < count; ++i) {
      const Vector2d& point = points[back ? count - 1 - i : i];
      while (hull.size() >= first + 2 && cross(hull[hull.size() - 2], hull.back(), point) <= 0) {
        hull.remove_last();
      }
      hull.add(point);
    }
    hull.remove_last();  // the next chain begins with it
  };
  chain(false);
  chain(true);
  if (hull.size() == 0) hull.add(points[0]);
  return hull;
}

/// The corners of the part between the depths: those of the whole and where its edges are cut.
void cut_corners(const std::array<Vector3d, 8>& corners, const Depths& depths, Corners& result) {
  for (std::size_t i = 0; i < 8; ++i) {
    const Vector3d& a = corners[i];
    if (a.z() >= depths.near && a.z() <= depths.far) result.add(a);
    for (const std::size_t bit : {1U, 2U, 4U}) {
      if ((i & bit) != 0) continue;
      const Vector3d& b = corners[i | bit];
      for (const double depth : {depths.near, depths.far}) {
        if ((a.z() < depth) != (b.z() < depth)) {
          Vector3d point = a + (depth - a.z()) / (b.z() - a.z()) * (b - a);
          point.z() = depth;
          result.add(point);
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
    if (over_a <= 0) result.add(a);
    if ((over_a <= 0) != (over_b <= 0)) {
      Vector2d point = a + over_a / (over_a - over_b) * (b - a);
      point[axis] = sign * limit;  // however far the ends are off
      result.add(point);
    }
  }
  return result;
}

std::vector<Vector2d> whole(const gl::Tile& tile) {
  const double right = tile.width + 1;
  const double bottom = tile.height + 1;
  return {{-1, -1}, {right, -1}, {right, bottom}, {-1, bottom}};
}

}  // namespace

std::vector<Vector2d> outline(const GridView& view, const std::array<Vector3d, 8>& corners,
                              const Depths& depths, const gl::Tile& tile, double margin) {
  double nearest = corners[0].z();
  double farthest = nearest;
  for (const Vector3d& corner : corners) {
    nearest = std::min(nearest, corner.z());
    farthest = std::max(farthest, corner.z());
  }
  const Depths seen{std::max(depths.near, nearest), std::min(depths.far, farthest)};
  if (!(seen.near <= seen.far)) return {};
  if (!view.parallel()) {
    if (!(seen.far > 0)) return {};
    // What reaches the plane of the eye has no bounds on the screen, or none that numbers hold.
    constexpr double kNear = 1e-6;
    if (!(seen.near > kNear * seen.far)) return whole(tile);
  }
  Corners points;
  cut_corners(corners, seen, points);
  if (points.size() == 0) return {};
  Polygon images;
  for (const Vector3d& point : points) {
    images.add(view.pixel(point) - Vector2d(tile.x, tile.y));
  }
  const Polygon inner = convex_hull(images);
  images.clear();
  for (const Vector2d& at : inner) {
    for (const double x : {-margin, margin}) {
      for (const double y : {-margin, margin}) images.add(at + Vector2d(x, y));
    }
  }
  Polygon polygon = convex_hull(images);
  const auto beyond = [&](const Vector2d& at) {
    return at.minCoeff() < -1 || at.x() > tile.width + 1 || at.y() > tile.height + 1;
  };
  if (std::any_of(polygon.begin(), polygon.end(), beyond)) {
    polygon = cut(polygon, 0, -1, 1);
    polygon = cut(polygon, 0, 1, tile.width + 1);
    polygon = cut(polygon, 1, -1, 1);
    polygon = cut(polygon, 1, 1, tile.height + 1);
  }
  if (polygon.size() < 3) return {};
  return {polygon.begin(), polygon.end()};
}

}  // namespace tetraglass::project::slices
