#include "mesh/interior_points.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace tetraglass::mesh {
namespace {

using Eigen::Vector3d;

/// A box as a surface, turned outwards or inwards.
void add_box(TriangleSurface& surface, const Vector3d& low, const Vector3d& high, bool outwards) {
  const auto first = static_cast<std::uint32_t>(surface.points.size());
  for (int i = 0; i < 8; ++i) {
    surface.points.emplace_back(i % 2 == 0 ? low.x() : high.x(),
                                i / 2 % 2 == 0 ? low.y() : high.y(),
                                i / 4 == 0 ? low.z() : high.z());
  }
  for (const std::array<std::uint32_t, 4>& face : {std::array<std::uint32_t, 4>{0, 2, 3, 1},
                                                   {4, 5, 7, 6},
                                                   {0, 1, 5, 4},
                                                   {2, 6, 7, 3},
                                                   {0, 4, 6, 2},
                                                   {1, 3, 7, 5}}) {
    for (const auto& [b, c] : {std::pair(1, 2), std::pair(2, 3)}) {
      std::array<std::uint32_t, 3> t = {face[0] + first, face[static_cast<std::size_t>(b)] + first,
                                        face[static_cast<std::size_t>(c)] + first};
      if (!outwards) std::swap(t[1], t[2]);
      surface.triangles.push_back(t);
    }
  }
}

/// How deep a place lies in the box; negative outside.
double depth(const Vector3d& p, const Vector3d& low, const Vector3d& high) {
  return std::min((p - low).minCoeff(), (high - p).minCoeff());
}

TEST(InteriorPoints, FillTheSolidAndKeepTheirDistance) {
  const Vector3d low(1, 2, 3);
  const Vector3d high(3, 5, 4);
  TriangleSurface surface;
  add_box(surface, low, high, true);
  constexpr double kCells = 200'000;
  const double volume = (high - low).prod();
  const std::vector<Vector3d> points = interior_points(surface, volume / kCells);
  const double step = std::cbrt(12 * volume / kCells);
  // A point has the volume of 6 cells; a layer along the surface is left free.
  const double layer = std::sqrt(3) / 4 * step;
  const double inner = (high - low - Vector3d::Constant(2 * layer)).prod();
  EXPECT_NEAR(static_cast<double>(points.size()), inner / (volume / kCells * 6), 0.01 * kCells / 6);
  for (const Vector3d& p : points) ASSERT_GE(depth(p, low, high), layer * (1 - 1e-12));
  // Neighbours are sqrt(3) / 2 steps apart, none are nearer.
  std::vector<Vector3d> some(points.begin(), points.begin() + 500);
  for (const Vector3d& p : some) {
    double nearest = 1e300;
    for (const Vector3d& q : points) {
      if (p != q) nearest = std::min(nearest, (p - q).norm());
    }
    ASSERT_NEAR(nearest, std::sqrt(3) / 2 * step, 1e-9 * step);
  }
}

TEST(InteriorPoints, LeaveCavitiesFree) {
  for (const bool turned : {false, true}) {
    TriangleSurface surface;
    add_box(surface, {0, 0, 0}, {3, 3, 3}, true);
    add_box(surface, {1, 1, 1}, {2, 2, 2}, turned);
    surface.turned = turned ? 1 : 0;  // directions say nothing: a shell within a shell is a cavity
    const std::vector<Vector3d> points = interior_points(surface, 27.0 / 50'000);
    ASSERT_GT(points.size(), 1000U);
    for (const Vector3d& p : points) {
      ASSERT_GT(depth(p, {0, 0, 0}, {3, 3, 3}), 0);
      ASSERT_LT(depth(p, {1, 1, 1}, {2, 2, 2}), 0);
    }
  }
  TriangleSurface inclusion;
  add_box(inclusion, {0, 0, 0}, {3, 3, 3}, true);
  add_box(inclusion, {1, 1, 1}, {2, 2, 2}, true);
  const std::vector<Vector3d> points = interior_points(inclusion, 27.0 / 50'000);
  EXPECT_TRUE(std::ranges::any_of(points, [](const Vector3d& p) {
    return depth(p, {1, 1, 1}, {2, 2, 2}) > 0;
  }));
}

TEST(InteriorPoints, OfASheetAreNoneAndCostLittle) {
  TriangleSurface sheet;
  add_box(sheet, {0, 0, 0}, {1, 1, 1e-6}, true);
  EXPECT_TRUE(interior_points(sheet, 1e-6 / 1e5).empty());
  TriangleSurface thinner;
  add_box(thinner, {0, 0, 0}, {1, 1, 1e-12}, true);
  EXPECT_TRUE(interior_points(thinner, 1e-12 / 1e5).empty());
}

}  // namespace
}  // namespace tetraglass::mesh
