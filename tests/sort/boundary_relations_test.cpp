#include "sort/boundary_relations.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "sort/face_pair.h"
#include "sort/views.h"

namespace tetraglass::sort {
namespace {

using Eigen::Vector3d;

// Faces of two cells: 0 with an exit and 1 with an entry.
struct Pair {
  mesh::TetMesh mesh;
  BoundaryFace exit{0, {0, 1, 2}};
  BoundaryFace entry{1, {3, 4, 5}};
};

// Turned so that a viewer `view` sees the entry from outside and the exit from inside.
Pair make_pair(const std::array<Vector3d, 3>& exit, const std::array<Vector3d, 3>& entry,
               const View& view) {
  Pair pair;
  pair.mesh.points.assign(exit.begin(), exit.end());
  pair.mesh.points.insert(pair.mesh.points.end(), entry.begin(), entry.end());
  const auto outward = [&](const std::array<Vector3d, 3>& t) {
    const Vector3d n = (t[1] - t[0]).cross(t[2] - t[0]);
    return view.parallel ? -n.dot(view.direction) : n.dot(view.eye - t[0]);
  };
  if (outward(exit) > 0) std::swap(pair.exit.vertices[1], pair.exit.vertices[2]);
  if (outward(entry) < 0) std::swap(pair.entry.vertices[1], pair.entry.vertices[2]);
  return pair;
}

bool related(const Pair& pair, const View& view) {
  return !boundary_relations(pair.mesh, {pair.exit}, {pair.entry}, view).empty();
}

// The distance from `origin` to the triangle along a ray, if it meets it.
std::optional<double> meet(const std::array<Vector3d, 3>& t, const Vector3d& origin,
                           const Vector3d& direction) {
  Eigen::Matrix3d m;
  m << t[1] - t[0], t[2] - t[0], -direction;
  const Vector3d solution = m.inverse() * (origin - t[0]);
  const double a = solution[0];
  const double b = solution[1];
  if (a < 0 || b < 0 || a + b > 1) return std::nullopt;
  return solution[2];
}

bool cross(const std::array<Vector3d, 3>& a, const std::array<Vector3d, 3>& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (const auto* pair : {&a, &b}) {
      const auto& other = pair == &a ? b : a;
      const std::optional<double> t = meet(other, (*pair)[i], (*pair)[(i + 1) % 3] - (*pair)[i]);
      if (t && *t > 0 && *t < 1) return true;
    }
  }
  return false;
}

// Random pairs of triangles that do not cross, by dense sampling of the exit.
TEST(BoundaryRelations, AgreeWithRays) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto point = [&] { return Vector3d(unit(random), unit(random), unit(random)); };
  int hidden = 0;
  int clear = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const std::array<Vector3d, 3> exit = {point(), point(), point()};
    std::array<Vector3d, 3> entry = {point(), point(), point()};
    if (trial % 4 == 0) {
      for (Vector3d& p : entry) p = 0.3 * p + 0.7 * exit[0];
    }
    if (cross(exit, entry)) continue;
    const View view =
        trial % 3 == 0 ? parallel(point()) : from(trial % 3 == 1 ? point() * 3 : point() * 0.2);
    int behind = 0;
    int before = 0;
    constexpr int kSteps = 40;
    for (int i = 0; i < kSteps; ++i) {
      for (int j = 0; i + j < kSteps; ++j) {
        const Vector3d p = exit[0] + (i + 0.4) / kSteps * (exit[1] - exit[0]) +
                           (j + 0.4) / kSteps * (exit[2] - exit[0]);
        const Vector3d direction = view.parallel ? view.direction : Vector3d(p - view.eye);
        const std::optional<double> t = meet(entry, p, direction);
        if (!t || (!view.parallel && *t < -1)) continue;
        ++(*t > 0 ? behind : before);
      }
    }
    ASSERT_FALSE(behind > 0 && before > 0);
    const Pair pair = make_pair(exit, entry, view);
    if (behind > 0) {
      ASSERT_TRUE(related(pair, view)) << "trial " << trial;
      ++hidden;
    } else if (before > 0) {
      ASSERT_FALSE(related(pair, view)) << "trial " << trial;
      ++clear;
    }
  }
  EXPECT_GT(hidden, 300);
  EXPECT_GT(clear, 300);
}

TEST(BoundaryRelations, OfFacesThatShareAnEdgeOrAVertexOnly) {
  const View down = parallel({0, 0, -1});
  // Side by side in the image: sharing the edge from (0,0,0) to (1,0,0).
  const Pair edge = make_pair({Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 1)},
                              {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, -1, -1)}, down);
  EXPECT_FALSE(related(edge, down));
  // Folded over: a part of the entry lies under the exit.
  const Pair folded = make_pair({Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 1)},
                                {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, -1)}, down);
  EXPECT_TRUE(related(folded, down));
  const View up = parallel({0, 0, 1});
  EXPECT_FALSE(related(make_pair({Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 1)},
                                 {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, -1)}, up),
                       up));
}

// Parts in contact whose faces do not match.
TEST(BoundaryRelations, OfFacesInContact) {
  for (const View& view : {parallel({0.1, 0.2, -1}), from({0.3, 0.2, 4})}) {
    const Pair pair =
        make_pair({Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)},
                  {Vector3d(0.1, 0.1, 0), Vector3d(2, 0, 0), Vector3d(0, 2, 0)}, view);
    EXPECT_TRUE(related(pair, view));
  }
}

// Crossing bars: neither lies on one side of the other one's plane, no vertex covers the other.
TEST(BoundaryRelations, AreDecidedByCrossingEdges) {
  for (const double height : {-0.5, 0.5}) {
    for (const View& view : {parallel({0, 0, -1}), from({0, 0, 5}), from({0.1, 0, 1})}) {
      const Pair pair =
          make_pair({Vector3d(-1, -0.1, 0.2), Vector3d(1, -0.1, -0.2), Vector3d(1, 0.1, 0.2)},
                    {Vector3d(-0.1, -1, height + 0.2), Vector3d(-0.1, 1, height - 0.2),
                     Vector3d(0.1, 1, height + 0.2)},
                    view);
      EXPECT_EQ(related(pair, view), height < 0);
    }
  }
}

}  // namespace
}  // namespace tetraglass::sort
