#include "mesh/distance.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "mesh/adjacency.h"
#include "mesh/samples.h"
#include "support/meshes.h"

namespace tetraglass::mesh {
namespace {

using Eigen::Vector3d;

TEST(BoundaryDistance, InABoxIsThatOfTheNearestSide) {
  const TetMesh mesh = tests::box({0, 0, 0}, {3, 4, 5}, 9, 10, 11, [](const auto&) { return 0.0; });
  const std::vector<double> distances = boundary_distance(mesh);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const Vector3d& p = mesh.points[i];
    const double expected = std::min(p.minCoeff(), (Vector3d(3, 4, 5) - p).minCoeff());
    ASSERT_NEAR(distances[i], expected, 1e-14) << "point " << i;
    if (expected == 0) {
      ASSERT_EQ(distances[i], 0) << "point " << i;
    }
  }
}

TEST(BoundaryDistance, InAHollowBoxIsThatOfTheCavityToo) {
  TetMesh mesh = tests::box({0, 0, 0}, {9, 9, 9}, 9, 9, 9, [](const auto&) { return 0.0; });
  TetMesh hollow = mesh;
  hollow.cells.clear();
  for (const Cell& cell : mesh.cells) {
    Vector3d center = Vector3d::Zero();
    for (const std::uint32_t v : cell) center += 0.25 * mesh.points[v];
    if (center.minCoeff() < 4 || center.maxCoeff() > 5) hollow.cells.push_back(cell);
  }
  const std::vector<double> distances = boundary_distance(hollow);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const Vector3d& p = mesh.points[i];
    const double outer = std::min(p.minCoeff(), (Vector3d(9, 9, 9) - p).minCoeff());
    const Vector3d nearest = p.cwiseMax(Vector3d(4, 4, 4)).cwiseMin(Vector3d(5, 5, 5));
    ASSERT_NEAR(distances[i], std::min(outer, (p - nearest).norm()), 1e-14) << "point " << i;
  }
}

// Every point to every triangle, by the plain minimization over sampled barycentric coordinates: no
// shared code. The samples only overestimate, by at most their spacing.
TEST(BoundaryDistance, OfACrookedMeshAgreesWithSampling) {
  TetMesh mesh = tests::box({0, 0, 0}, {3, 3, 3}, 3, 3, 3, [](const auto&) { return 0.0; });
  std::mt19937 bits(11);
  std::uniform_real_distribution<double> shift(-0.15, 0.15);
  for (Vector3d& p : mesh.points) p += Vector3d(shift(bits), shift(bits), shift(bits));
  const std::vector<double> distances = boundary_distance(mesh);
  const Adjacency adjacency = face_adjacency(mesh);
  constexpr int kSteps = 60;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
      for (std::size_t f = 0; f < 4; ++f) {
        if (adjacency.neighbors[c][f] != kNoCell) continue;
        std::array<Vector3d, 3> t;
        for (std::size_t v = 0; v < 3; ++v) {
          t[v] = mesh.points[mesh.cells[c][static_cast<std::size_t>(kFaceVertices[f][v])]];
        }
        for (int a = 0; a <= kSteps; ++a) {
          for (int b = 0; a + b <= kSteps; ++b) {
            const Vector3d q = (a * t[0] + b * t[1] + (kSteps - a - b) * t[2]) / kSteps;
            least = std::min(least, (q - mesh.points[i]).norm());
          }
        }
      }
    }
    ASSERT_LE(distances[i], least + 1e-14) << "point " << i;
    ASSERT_GE(distances[i], least - 2.0 / kSteps) << "point " << i;
  }
}

TEST(BoundaryDistance, IsZeroAtUnusedPointsAndInAnEmptyMesh) {
  EXPECT_TRUE(boundary_distance(TetMesh{}).empty());
  TetMesh mesh = tests::unit_tetrahedron();
  mesh.points.emplace_back(0.1, 0.1, 0.1);
  EXPECT_EQ(boundary_distance(mesh), std::vector<double>(5, 0.0));
  mesh.points[0].x() = std::numeric_limits<double>::quiet_NaN();
  for (const double d : boundary_distance(mesh)) EXPECT_EQ(d, 0);
}

}  // namespace
}  // namespace tetraglass::mesh
