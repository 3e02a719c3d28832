#include "sort/image_triangle.h"

#include <random>

#include <gtest/gtest.h>

#include "mesh/predicates.h"

namespace tetraglass::sort {
namespace {

using Eigen::Vector2d;
using Corners = std::array<Vector2d, 3>;

ImageTriangle image(const Corners& corners) {
  double size = 0;
  for (const Vector2d& p : corners) size = std::max(size, p.cwiseAbs().maxCoeff());
  return {corners, size};
}

int turn(const Vector2d& p, const Vector2d& q, const Vector2d& r) {
  const auto in_space = [](const Vector2d& v) { return Eigen::Vector3d(v.x(), v.y(), 0); };
  return mesh::orientation(in_space(p), in_space(q), in_space(r), {0, 0, 1e3});
}

bool is_separated(const Corners& a, const Corners& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    int inside = 0;
    for (const Vector2d& p : b) {
      if (turn(a[i], a[(i + 1) % 3], p) * turn(a[0], a[1], a[2]) > 0) ++inside;
    }
    if (inside == 0) return true;
  }
  return false;
}

// Exact predicates judge; coordinates in steps of 1/8 make many triangles touch.
TEST(ImageTriangle, AgreesWithExactPredicates) {
  std::mt19937 random(3);
  std::array<int, 3> count{};
  for (int trial = 0; trial < 20000; ++trial) {
    std::uniform_real_distribution<double> any(-1, 1);
    std::uniform_int_distribution<int> steps(-8, 8);
    const auto corner = [&] {
      return trial % 2 == 0 ? Vector2d(any(random), any(random))
                            : Vector2d(steps(random) / 8.0, steps(random) / 8.0);
    };
    const Corners a = {corner(), corner(), corner()};
    const Corners b = {corner(), corner(), corner()};
    const Overlap found = find_overlap(image(a), image(b));
    ++count[static_cast<std::size_t>(found)];
    if (found == Overlap::uncertain) continue;
    ASSERT_EQ(found == Overlap::none, is_separated(a, b) || is_separated(b, a)) << trial;
  }
  for (const int often : count) EXPECT_GT(often, 500);
}

// Less apart than the coordinates may be off.
TEST(ImageTriangle, IsUncertainWithinTheErrorOfTheCorners) {
  const Corners left = {Vector2d(-1, 0), Vector2d(0, -1), Vector2d(0, 1)};
  const auto right = [](double gap) {
    return Corners{Vector2d(gap, -1), Vector2d(1, 0), Vector2d(gap, 1)};
  };
  EXPECT_EQ(find_overlap(image(left), image(right(0))), Overlap::uncertain);
  for (const double gap : {0x1p-49, -0x1p-49}) {
    EXPECT_EQ(find_overlap(image(left), image(right(gap))), Overlap::uncertain);
  }
  EXPECT_EQ(find_overlap(image(left), image(right(0x1p-30))), Overlap::none);
  EXPECT_EQ(find_overlap(image(left), image(right(-0x1p-30))), Overlap::some);
}

TEST(ImageTriangle, IsUncertainWithoutAreaAndBeyondTheRangeOfNumbers) {
  const Corners flat = {Vector2d(0, 0), Vector2d(1, 1), Vector2d(2, 2)};
  const Corners wide = {Vector2d(-1, -1), Vector2d(3, -1), Vector2d(0, 3)};
  EXPECT_EQ(find_overlap(image(flat), image(wide)), Overlap::uncertain);
  const Corners huge = {Vector2d(-1e300, -1e300), Vector2d(1e300, 0), Vector2d(0, 1e300)};
  EXPECT_EQ(find_overlap(image(huge), image(wide)), Overlap::uncertain);
  const Corners tiny = {Vector2d(0, 0), Vector2d(1e-200, 0), Vector2d(0, 1e-200)};
  EXPECT_EQ(find_overlap(image(tiny), image(tiny)), Overlap::uncertain);
}

}  // namespace
}  // namespace tetraglass::sort
