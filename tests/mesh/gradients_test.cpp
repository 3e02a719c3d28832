#include "mesh/gradients.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "mesh/samples.h"
#include "support/meshes.h"

namespace tetraglass::mesh {
namespace {

using Eigen::Vector3d;

// A box whose inner points are moved about, so that no two cells are alike.
TetMesh crooked(const tests::FieldFunction& f) {
  TetMesh mesh = tests::box({0, 0, 0}, {4, 4, 4}, 4, 4, 4, [](const auto&) { return 0.0; });
  std::mt19937 bits(7);
  std::uniform_real_distribution<double> shift(-0.2, 0.2);
  for (Vector3d& p : mesh.points) {
    const bool inner = p.minCoeff() > 0 && p.maxCoeff() < 4;
    if (inner) p += Vector3d(shift(bits), shift(bits), shift(bits));
  }
  mesh.fields.clear();
  tests::add_point_field(mesh, "s", f);
  return mesh;
}

TEST(Gradients, OfALinearFieldAreItsSlopeEverywhere) {
  const Vector3d slope(2, -3, 0.5);
  const TetMesh mesh = crooked([&](const Vector3d& p) { return 7 + slope.dot(p); });
  const ScalarField field = select_scalar(mesh, "s");
  for (const Vector3d& g : cell_gradients(mesh, field)) EXPECT_LT((g - slope).norm(), 1e-12);
  for (const Vector3d& g : vertex_gradients(mesh, field)) EXPECT_LT((g - slope).norm(), 1e-12);
  for (const Vector3d& g : least_squares_gradients(mesh, field)) {
    EXPECT_LT((g - slope).norm(), 1e-12);
  }
}

// Slivers: cells whose four points are nearly in a plane, between the layers of a box squeezed to
// dihedral angles of 1e-6. Their own gradients amplify the rounding of values by the inverse of
// that; at points around which there are fuller cells, neither mean may.
TEST(Gradients, OfALinearFieldAreExactBesideSlivers) {
  const Vector3d slope(2, -3, 0.5);
  TetMesh mesh = tests::box({0, 0, 0}, {4, 4, 4}, 4, 4, 4, [](const auto&) { return 0.0; });
  constexpr double kThin = 1e-6;
  for (Vector3d& p : mesh.points) {
    if (p.z() == 2) p.z() = 1 + kThin;  // the layer between z = 1 and 2 becomes thin
  }
  mesh.fields.clear();
  tests::add_point_field(mesh, "s", [&](const Vector3d& p) { return 7 + slope.dot(p); });
  double thinnest = 180;
  for (const Cell& c : mesh.cells) {
    const double volume = tests::volume(mesh, c);
    ASSERT_GT(volume, 0);
    thinnest = std::min(thinnest, volume);
  }
  ASSERT_LT(thinnest, 1e-6);
  const ScalarField field = select_scalar(mesh, "s");
  for (const Vector3d& g : vertex_gradients(mesh, field)) {
    EXPECT_LT((g - slope).norm(), 1e-10 * slope.norm());
  }
  for (const Vector3d& g : least_squares_gradients(mesh, field)) {
    EXPECT_LT((g - slope).norm(), 1e-10 * slope.norm());
  }
  // Rounding of s (about 2^-53 * 20) over a height of 1e-6: 2e-9 at most.
  for (const Vector3d& g : cell_gradients(mesh, field)) EXPECT_LT((g - slope).norm(), 1e-8);
}

// Both converge for smooth fields; least squares does so faster, for it is of second order where
// neighbours lie evenly around.
TEST(Gradients, OfSmoothFieldsComeNearerOnFinerMeshes) {
  const auto errors = [](int n) {
    const TetMesh mesh = tests::box({0, 0, 0}, {1, 1, 1}, n, n, n, [](const Vector3d& p) {
      return std::sin(3 * p.x()) * std::cos(2 * p.y()) + p.z() * p.z();
    });
    const ScalarField field = select_scalar(mesh, "s");
    const auto by_volume = vertex_gradients(mesh, field);
    const auto by_fit = least_squares_gradients(mesh, field);
    Eigen::Array2d worst(0, 0);
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
      const Vector3d& p = mesh.points[i];
      const Vector3d exact(3 * std::cos(3 * p.x()) * std::cos(2 * p.y()),
                           -2 * std::sin(3 * p.x()) * std::sin(2 * p.y()), 2 * p.z());
      worst = worst.max(Eigen::Array2d((by_volume[i] - exact).norm(), (by_fit[i] - exact).norm()));
    }
    return worst;
  };
  const Eigen::Array2d coarse = errors(8);
  const Eigen::Array2d fine = errors(16);
  EXPECT_LT(fine[0], 0.6 * coarse[0]);  // of first order at the boundary
  EXPECT_LT(fine[1], 0.6 * coarse[1]);
  EXPECT_LT(fine[1], fine[0]);
}

TEST(Gradients, ByLeastSquaresLeaveOutCellsWithValuesThatAreNotFinite) {
  TetMesh mesh = tests::unit_tetrahedron([](const Vector3d& p) { return p.x(); });
  mesh.fields[0].values[2] = std::numeric_limits<double>::quiet_NaN();
  const ScalarField field = select_scalar(mesh, "s");
  for (const Vector3d& g : least_squares_gradients(mesh, field)) EXPECT_EQ(g, Vector3d::Zero());
}

// By the divergence theorem, the integral of the gradient over the mesh is that of s n over its
// boundary; the sum of volume times gradient over all vertices of a cell is four times the cell's.
TEST(Gradients, IntegrateToTheFluxThroughTheBoundary) {
  const TetMesh mesh = crooked([](const Vector3d& p) { return p.x() * p.y() + p.z() * p.z(); });
  const ScalarField field = select_scalar(mesh, "s");
  const std::vector<Vector3d> in_cells = cell_gradients(mesh, field);
  const std::vector<Vector3d> at_vertices = vertex_gradients(mesh, field);
  std::vector<double> volumes(mesh.points.size(), 0);
  Vector3d integral = Vector3d::Zero();
  Vector3d flux = Vector3d::Zero();
  for (std::size_t i = 0; i < mesh.cells.size(); ++i) {
    const double volume = tests::volume(mesh, mesh.cells[i]);
    integral += volume * in_cells[i];
    for (const std::uint32_t v : mesh.cells[i]) volumes[v] += volume;
    for (const auto& face : kFaceVertices) {  // the inner faces cancel
      const auto at = [&](std::size_t k) {
        return mesh.cells[i][static_cast<std::size_t>(face[k])];
      };
      const Vector3d& a = mesh.points[at(0)];
      const Vector3d normal = 0.5 * (mesh.points[at(1)] - a).cross(mesh.points[at(2)] - a);
      flux += normal * (field.values[at(0)] + field.values[at(1)] + field.values[at(2)]) / 3;
    }
  }
  EXPECT_LT((integral - flux).norm(), 1e-10 * flux.norm());
  Vector3d at_all_vertices = Vector3d::Zero();
  for (std::size_t v = 0; v < volumes.size(); ++v) at_all_vertices += volumes[v] * at_vertices[v];
  EXPECT_LT((at_all_vertices - 4 * integral).norm(), 1e-10 * integral.norm());
}

TEST(Gradients, OfFlatCellsAreZeroAndLeaveTheVerticesAlone) {
  TetMesh mesh = tests::unit_tetrahedron([](const Vector3d& p) { return p.x() + 2 * p.y(); });
  mesh.points.emplace_back(0.5, 0.5, 0);
  mesh.fields[0].values.push_back(100);
  mesh.cells.push_back({0, 1, 2, 4});
  const ScalarField field = select_scalar(mesh, "s");
  EXPECT_LT((cell_gradients(mesh, field)[0] - Vector3d(1, 2, 0)).norm(), 1e-15);
  EXPECT_EQ(cell_gradients(mesh, field)[1], Vector3d::Zero());
  const std::vector<Vector3d> at_vertices = vertex_gradients(mesh, field);
  for (std::size_t v = 0; v < 4; ++v) EXPECT_LT((at_vertices[v] - Vector3d(1, 2, 0)).norm(), 1e-15);
  EXPECT_EQ(at_vertices[4], Vector3d::Zero());  // only the flat cell is around it
}

TEST(Gradients, LeaveOutValuesThatAreNotFinite) {
  TetMesh mesh = crooked([](const Vector3d& p) { return p.z(); });
  mesh.fields[0].values[0] = std::numeric_limits<double>::quiet_NaN();
  mesh.points.emplace_back(9, 9, 9);
  mesh.fields[0].values.push_back(1);
  const ScalarField field = select_scalar(mesh, "s");
  const std::vector<Vector3d> in_cells = cell_gradients(mesh, field);
  for (std::size_t i = 0; i < in_cells.size(); ++i) {
    const Cell& c = mesh.cells[i];
    const bool touches = std::find(c.begin(), c.end(), 0U) != c.end();
    EXPECT_LT((in_cells[i] - Vector3d(0, 0, touches ? 0 : 1)).norm(), 1e-12);
  }
  const std::vector<Vector3d> at_vertices = vertex_gradients(mesh, field);
  EXPECT_EQ(at_vertices[0], Vector3d::Zero());
  EXPECT_EQ(at_vertices.back(), Vector3d::Zero());
  EXPECT_LT((at_vertices[1] - Vector3d::UnitZ()).norm(), 1e-12);
}

TEST(Gradients, OfACellFieldAreZero) {
  TetMesh mesh = tests::unit_tetrahedron();
  mesh.fields = {Field{"c", Location::cell, 1, {3.0}}};
  const ScalarField field = select_scalar(mesh, "c");
  EXPECT_EQ(cell_gradients(mesh, field), std::vector<Vector3d>(1, Vector3d::Zero()));
  EXPECT_EQ(vertex_gradients(mesh, field), std::vector<Vector3d>(4, Vector3d::Zero()));
  EXPECT_EQ(least_squares_gradients(mesh, field), std::vector<Vector3d>(4, Vector3d::Zero()));
}

// The gradient of |p| is p / |p|; linear interpolation over an edge h errs by about h / |p|.
TEST(Gradients, AtVerticesOfTheSphereSampleAreRadial) {
  const TetMesh mesh = make_sample("sphere");
  const std::vector<Vector3d> at_vertices = vertex_gradients(mesh, select_scalar(mesh, "sphere"));
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const Vector3d& p = mesh.points[v];
    if (p.norm() < 0.5 || p.cwiseAbs().maxCoeff() > 0.99) continue;
    ASSERT_LT((at_vertices[v] - p.normalized()).norm(), 2.0 / 31 / p.norm()) << "point " << v;
  }
}

}  // namespace
}  // namespace tetraglass::mesh
