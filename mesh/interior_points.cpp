#include "mesh/interior_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstdint>
#include <tuple>
#include <unordered_set>

#include <Eigen/Geometry>

namespace tetraglass::mesh {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A line of lattice points, parallel to x: one of the two cubic lattices, and its place in y and
/// z.
struct Row {
  std::int32_t lattice, j, k;
  auto operator<=>(const Row&) const = default;
};

/// Where a row goes through a triangle, into the surface (1) or out of it (-1).
struct Crossing {
  Row row;
  double x;
  int sign;
};

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

double squared_distance_to_segment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d edge = b - a;
  const double t = std::clamp((p - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
  return (a + t * edge - p).squaredNorm();
}

struct Corners {
  Vector3d a, b, c;

  [[nodiscard]] double squared_distance(const Vector3d& p) const {
    const Vector3d normal = (b - a).cross(c - a);
    const bool above = (b - a).cross(p - a).dot(normal) >= 0 &&
                       (c - b).cross(p - b).dot(normal) >= 0 &&
                       (a - c).cross(p - c).dot(normal) >= 0;
    if (above) {
      const double height = (p - a).dot(normal);
      return height * height / normal.squaredNorm();
    }
    return std::min({squared_distance_to_segment(p, a, b), squared_distance_to_segment(p, b, c),
                     squared_distance_to_segment(p, c, a)});
  }
};

class LatticeFiller {
 public:
  LatticeFiller(const TriangleSurface& surface, double volume_of_cell)
      : surface_(surface),
        // Any angles will do that are not those of common solids.
        turn_(Eigen::AngleAxisd(0.6, Vector3d::UnitZ()) *
              Eigen::AngleAxisd(1.1, Vector3d::UnitX())),
        center_(surface.points[0]) {
    // A cube of the lattice has 2 points and 12 tetrahedra.
    constexpr double kCellsOfCube = 12;
    step_ = std::cbrt(kCellsOfCube * volume_of_cell);
  }

  std::vector<Vector3d> fill() {
    std::vector<Corners> triangles;
    double area = 0;
    Eigen::AlignedBox3d box;
    for (const auto& t : surface_.triangles) {
      triangles.push_back({lattice(t[0]), lattice(t[1]), lattice(t[2])});
      const Corners& corners = triangles.back();
      box.extend(corners.a).extend(corners.b).extend(corners.c);
      area += (corners.b - corners.a).cross(corners.c - corners.a).norm() / 2;
    }
    // Farther out places could not be numbered; of a sheet as thin as that, all points are near.
    constexpr double kFarthest = 1 << 20;
    constexpr double kLargestArea = 1e8;
    if (box.min().minCoeff() < -kFarthest || box.max().maxCoeff() > kFarthest ||
        area > kLargestArea) {
      return {};
    }
    for (const Corners& corners : triangles) cross_rows(corners);
    find_inside();
    for (const Corners& corners : triangles) leave_out_near(corners);
    std::vector<Vector3d> points;
    for (const Place& place : inside_) {
      if (!wanted_.contains(number(place))) continue;
      const Vector3d at =
          Vector3d(place.i, place.row.j, place.row.k) + Vector3d::Constant(0.5 * place.row.lattice);
      points.emplace_back(center_ + turn_ * (step_ * at));
    }
    return points;
  }

 private:
  /// A point of the surface in the lattice, where its step is 1.
  [[nodiscard]] Vector3d lattice(std::uint32_t i) const {
    return turn_.inverse() * (surface_.points[i] - center_) / step_;
  }

  static std::int32_t up(double x) { return static_cast<std::int32_t>(std::ceil(x)); }
  static std::int32_t down(double x) { return static_cast<std::int32_t>(std::floor(x)); }

  void cross_rows(const Corners& t) {
    const Vector2d a = t.a.tail<2>();
    const Vector2d b = t.b.tail<2>();
    const Vector2d c = t.c.tail<2>();
    const double area = cross(b - a, c - a);
    if (area == 0) return;
    Eigen::AlignedBox2d box(a);
    box.extend(b).extend(c);
    for (int cubic = 0; cubic < 2; ++cubic) {
      const double shift = 0.5 * cubic;
      for (std::int32_t j = up(box.min().x() - shift); j <= down(box.max().x() - shift); ++j) {
        for (std::int32_t k = up(box.min().y() - shift); k <= down(box.max().y() - shift); ++k) {
          const Vector2d p(j + shift, k + shift);
          const double u = cross(c - b, p - b) / area;
          const double v = cross(a - c, p - c) / area;
          const double w = 1 - u - v;
          if (u < 0 || v < 0 || w < 0) continue;
          // The area is negative where the face turns towards where the row comes from.
          crossings_.push_back(
              {{cubic, j, k}, u * t.a.x() + v * t.b.x() + w * t.c.x(), area < 0 ? 1 : -1});
        }
      }
    }
  }

  /// Collects the places on the rows that are in the solid.
  void find_inside() {
    std::ranges::sort(crossings_, [](const Crossing& a, const Crossing& b) {
      return std::tie(a.row, a.x) < std::tie(b.row, b.x);
    });
    for (std::size_t begin = 0; begin < crossings_.size();) {
      std::size_t end = begin;
      int total = 0;
      for (; end < crossings_.size() && crossings_[end].row == crossings_[begin].row; ++end) {
        total += crossings_[end].sign;
      }
      // A row that grazes an edge may come out wrong; those beside it do not.
      if (total == 0 && (end - begin) % 2 == 0) fill_row(begin, end);
      begin = end;
    }
  }

  void fill_row(std::size_t begin, std::size_t end) {
    int total = 0;
    const Row& row = crossings_[begin].row;
    const double shift = 0.5 * row.lattice;
    for (std::size_t c = begin; c + 1 < end; ++c) {
      total += crossings_[c].sign;
      if (!is_solid(surface_, total, static_cast<int>(c + 1 - begin))) continue;
      const std::int32_t last = down(crossings_[c + 1].x - shift);
      for (std::int32_t i = up(crossings_[c].x - shift); i <= last; ++i) {
        inside_.push_back({row, i});
        wanted_.insert(number(inside_.back()));
      }
    }
  }

  /// Goes over the places beside the plane of the triangle, along the axis most nearly upright on
  /// it.
  void leave_out_near(const Corners& t) {
    const Vector3d normal = (t.b - t.a).cross(t.c - t.a);
    Eigen::Index x = 0;
    if (!(normal.cwiseAbs().maxCoeff(&x) > 0)) return;
    const Eigen::Index y = (x + 1) % 3;
    const Eigen::Index z = (x + 2) % 3;
    Eigen::AlignedBox3d box(t.a);
    box.extend(t.b).extend(t.c);
    const double reach = kNearest * normal.norm() / std::abs(normal[x]);
    for (int cubic = 0; cubic < 2; ++cubic) {
      const double shift = 0.5 * cubic;
      const Vector3d low = (box.min().array() - kNearest - shift).matrix();
      const Vector3d high = (box.max().array() + kNearest - shift).matrix();
      Vector3d p;
      for (std::int32_t j = up(low[y]); j <= down(high[y]); ++j) {
        p[y] = j + shift;
        for (std::int32_t k = up(low[z]); k <= down(high[z]); ++k) {
          p[z] = k + shift;
          const double plane =
              t.a[x] - shift -
              ((p[y] - t.a[y]) * normal[y] + (p[z] - t.a[z]) * normal[z]) / normal[x];
          const std::int32_t last = down(std::min(plane + reach, high[x]));
          for (std::int32_t i = up(std::max(plane - reach, low[x])); i <= last; ++i) {
            p[x] = i + shift;
            if (t.squared_distance(p) >= kNearest * kNearest) continue;
            std::array<std::int32_t, 3> at{};
            at[static_cast<std::size_t>(x)] = i;
            at[static_cast<std::size_t>(y)] = j;
            at[static_cast<std::size_t>(z)] = k;
            wanted_.erase(number({{cubic, at[1], at[2]}, at[0]}));
          }
        }
      }
    }
  }

  struct Place {
    Row row;
    std::int32_t i;
  };

  static std::uint64_t number(const Place& place) {
    const auto bits = [](std::int32_t n) { return static_cast<std::uint64_t>(n) & 0x1fffffU; };
    return (bits(place.i) << 43U) | (bits(place.row.j) << 22U) | (bits(place.row.k) << 1U) |
           static_cast<std::uint64_t>(place.row.lattice);
  }

  /// Half the distance of neighbours in the lattice.
  static constexpr double kNearest = 0.43301270189221932;  // sqrt(3) / 4

  const TriangleSurface& surface_;
  const Eigen::Quaterniond turn_;
  const Vector3d center_;
  double step_ = 0;
  std::vector<Crossing> crossings_;
  std::vector<Place> inside_;
  std::unordered_set<std::uint64_t> wanted_;  ///< those of them that are not near the surface
};

}  // namespace

std::vector<Vector3d> interior_points(const TriangleSurface& surface, double volume_of_cell) {
  if (surface.triangles.empty() || surface.inner_walls) return {};  // rows do not tell their inside
  return LatticeFiller(surface, volume_of_cell).fill();
}

}  // namespace tetraglass::mesh
