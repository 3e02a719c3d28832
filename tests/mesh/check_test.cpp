#include "mesh/check.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

#include "mesh/samples.h"
#include "support/meshes.h"

namespace tetraglass::mesh {
namespace {

using Eigen::Vector3d;

TetMesh box(int nx, int ny, int nz) {
  return tests::box({0, 0, 0}, {double(nx), double(ny), double(nz)}, nx, ny, nz,
                    [](const auto&) { return 0.0; });
}

// Drops the bricks of 6 cells whose index `drop` names.
template <typename F>
TetMesh without(const TetMesh& mesh, const F& drop) {
  TetMesh result = mesh;
  result.cells.clear();
  for (const Cell& cell : mesh.cells) {
    Vector3d center = Vector3d::Zero();
    for (const std::uint32_t v : cell) center += 0.25 * mesh.points[v];
    if (!drop(center)) result.cells.push_back(cell);
  }
  return result;
}

bool between(double low, double x, double high) {
  return low < x && x < high;
}

TEST(Check, OfNothing) {
  const Soundness soundness = check(TetMesh{});
  EXPECT_EQ(soundness.parts, 0U);
  EXPECT_FALSE(soundness.convex);
  EXPECT_FALSE(soundness.delaunay);
  EXPECT_EQ(soundness.min_dihedral_degrees, 0);
}

TEST(Check, ABoxIsConvexAndOneTetrahedronIsDelaunay) {
  const Soundness one = check(tests::unit_tetrahedron());
  EXPECT_TRUE(one.convex);
  EXPECT_TRUE(one.delaunay);
  EXPECT_EQ(one.boundary_faces, 4U);
  EXPECT_NEAR(one.min_dihedral_degrees, std::acos(1 / std::sqrt(3.0)) * 180 / std::numbers::pi,
              1e-12);
  const Soundness many = check(box(3, 4, 5));
  EXPECT_TRUE(many.convex);
  EXPECT_TRUE(many.delaunay);  // the eight corners of a brick are on one sphere
  EXPECT_EQ(many.parts, 1U);
}

TEST(Check, TheRegularTetrahedronHasEqualAngles) {
  TetMesh mesh = tests::unit_tetrahedron();
  for (const double scale : {1e-160, 1.0, 1e160}) {
    mesh.points = {{scale, scale, scale},
                   {scale, -scale, -scale},
                   {-scale, scale, -scale},
                   {-scale, -scale, scale}};
    std::swap(mesh.points[0], mesh.points[1]);
    mesh.cells = {{0, 1, 2, 3}};
    const Soundness soundness = check(mesh);
    EXPECT_NEAR(soundness.min_dihedral_degrees, std::acos(1.0 / 3) * 180 / std::numbers::pi, 1e-12);
    EXPECT_EQ(soundness.dihedral_histogram[14], 1U);  // 70.5 degrees
  }
}

TEST(Check, ADentTakesAwayConvexity) {
  const TetMesh mesh = box(3, 3, 3);
  const auto dent = without(mesh, [](const Vector3d& c) { return c.minCoeff() > 2; });
  EXPECT_FALSE(check(dent).convex);
  TetMesh pushed = mesh;
  for (Vector3d& p : pushed.points) {
    if (p == Vector3d(1, 1, 3)) p.z() = std::nextafter(3.0, 0.0);
  }
  EXPECT_FALSE(check(pushed).convex);  // by the last bit
  for (Vector3d& p : pushed.points) {
    if (p.head<2>() == Eigen::Vector2d(1, 1) && p.z() > 2.5) p.z() = std::nextafter(3.0, 4.0);
  }
  EXPECT_FALSE(check(pushed).convex);  // a bump on a flat side bends inwards at its foot
}

TEST(Check, ACavityTakesAwayConvexity) {
  const TetMesh hollow =
      without(box(3, 3, 3), [](const Vector3d& c) { return c.minCoeff() > 1 && c.maxCoeff() < 2; });
  const Soundness soundness = check(hollow);
  EXPECT_EQ(soundness.parts, 1U);
  EXPECT_EQ(soundness.boundary_faces, 6U * 18U + 12U);
  EXPECT_FALSE(soundness.convex);
  EXPECT_FALSE(soundness.delaunay);
}

TEST(Check, ATunnelTakesAwayConvexity) {
  const TetMesh ring = without(
      box(3, 3, 1), [](const Vector3d& c) { return between(1, c.x(), 2) && between(1, c.y(), 2); });
  EXPECT_FALSE(check(ring).convex);
}

// A brick cut through along a diagonal sheet that ends inside: at its end the surface folds back by
// a full turn, though no orientation is positive.
TEST(Check, ASlitTakesAwayConvexity) {
  TetMesh mesh = box(2, 2, 1);
  // The points of the plane x = 1 with y < 1 are doubled for the cells on its right.
  std::vector<std::uint32_t> twin(mesh.points.size());
  std::iota(twin.begin(), twin.end(), 0U);
  for (std::uint32_t v = 0; v < twin.size(); ++v) {
    const Vector3d p = mesh.points[v];
    if (p.x() != 1 || p.y() > 0.5) continue;
    twin[v] = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back(p);
  }
  for (Cell& cell : mesh.cells) {
    double x = 0;
    for (const std::uint32_t v : cell) x += mesh.points[v].x() / 4;
    if (x < 1) continue;
    for (std::uint32_t& v : cell) {
      if (v < twin.size()) v = twin[v];
    }
  }
  const Soundness soundness = check(mesh);
  EXPECT_EQ(soundness.parts, 1U);
  EXPECT_GT(soundness.boundary_faces, 32U);
  EXPECT_FALSE(soundness.convex);
}

TEST(Check, CountsFaceConnectedParts) {
  TetMesh mesh = box(2, 2, 2);
  mesh = without(mesh, [](const Vector3d& c) {  // two bricks left, sharing only the middle point
    return !(c.maxCoeff() < 1 || c.minCoeff() > 1);
  });
  const Soundness soundness = check(mesh);
  EXPECT_EQ(soundness.parts, 2U);
  EXPECT_FALSE(soundness.convex);
  EXPECT_EQ(check(without(make_sample("sphere", 5000),
                          [](const Vector3d& c) { return c.norm() > 0.6 && c.norm() < 1.45; }))
                .parts,
            9U);  // the ball and the eight corners of the cube
}

TEST(Check, TellsWhetherAConvexMeshIsDelaunay) {
  // Two tetrahedra over the triangle 1 2 3; the outer points are far apart, or near.
  TetMesh mesh = tests::unit_tetrahedron();
  mesh.points = {{0, 0, -1}, {1, 0, 0}, {-0.5, 0.8, 0}, {-0.5, -0.8, 0}, {0, 0, 1}};
  mesh.cells = {{0, 1, 2, 3}, {4, 1, 3, 2}};
  for (Cell& c : mesh.cells) {
    if (tests::volume(mesh, c) < 0) std::swap(c[2], c[3]);
  }
  EXPECT_TRUE(check(mesh).convex);
  EXPECT_TRUE(check(mesh).delaunay);
  mesh.points[0].z() = -0.1;
  mesh.points[4].z() = 0.1;  // the spheres are now huge
  EXPECT_TRUE(check(mesh).convex);
  EXPECT_FALSE(check(mesh).delaunay);
}

TEST(Check, CountsFlatCellsAndNan) {
  TetMesh mesh = box(1, 1, 1);
  mesh.cells.push_back({0, 1, 2, 3});  // four corners of a side
  mesh.fields[0].values[1] = std::numeric_limits<double>::quiet_NaN();
  mesh.fields.push_back({"V", Location::cell, 3, std::vector<double>(3 * mesh.cells.size(), 1.0)});
  mesh.fields[1].values[4] = std::numeric_limits<double>::infinity();
  Soundness soundness = check(mesh);
  EXPECT_EQ(soundness.degenerate, 1U);
  EXPECT_EQ(soundness.nan_values, 2U);
  EXPECT_EQ(std::accumulate(soundness.dihedral_histogram.begin(),
                            soundness.dihedral_histogram.end(), std::size_t{0}),
            6U);
  mesh.points[7].x() = std::numeric_limits<double>::quiet_NaN();
  soundness = check(mesh);
  EXPECT_EQ(soundness.nan_values, 3U);
  EXPECT_FALSE(soundness.convex);
}

TEST(Check, FindsDoubledCells) {
  TetMesh mesh = box(2, 2, 2);
  mesh.cells.push_back(mesh.cells[0]);
  const Soundness soundness = check(mesh);
  EXPECT_GT(soundness.crowded_faces, 0U);
  EXPECT_FALSE(soundness.convex);
}

TEST(Check, TheRadiusRatioIsThatOfTheInscribedAndTheCircumscribedSphere) {
  TetMesh regular;
  regular.points = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  regular.cells = {{0, 1, 2, 3}};
  EXPECT_NEAR(check(regular).min_radius_ratio, 1, 1e-15);
  EXPECT_EQ(check(regular).radius_ratio_histogram.back(), 1U);
  // Of the corner of a cube: 1 / (3 + sqrt 3) and sqrt(3) / 2.
  for (const double unit : {1e-120, 1.0, 1e120}) {
    TetMesh corner = tests::unit_tetrahedron();
    for (Vector3d& p : corner.points) p *= unit;
    const Soundness soundness = check(corner);
    const double ratio = 3 / (3 + std::sqrt(3.0)) / (std::sqrt(3.0) / 2);
    EXPECT_NEAR(soundness.min_radius_ratio, ratio, 1e-14) << unit;
    EXPECT_EQ(soundness.radius_ratio_histogram[14], 1U) << unit;  // 0.732
  }
}

}  // namespace
}  // namespace tetraglass::mesh
