#include "mesh/surface_fields.h"

#include <cmath>

#include <gtest/gtest.h>

#include "mesh/adjacency.h"
#include "mesh/tetrahedralize.h"
#include "support/meshes.h"

namespace tetraglass::mesh {
namespace {

/// The surface of the box mesh, as triangles with the point field f.
MeshData skin(const TetMesh& mesh, const tests::FieldFunction& f) {
  MeshData data;
  data.points = mesh.points;
  const Adjacency adjacency = face_adjacency(mesh);
  for (std::size_t i = 0; i < mesh.cells.size(); ++i) {
    for (std::size_t face = 0; face < 4; ++face) {
      if (adjacency.neighbors[i][face] != kNoCell) continue;
      std::array<std::uint32_t, 3> t{};
      for (std::size_t k = 0; k < 3; ++k) {
        t[k] = mesh.cells[i][static_cast<std::size_t>(kFaceVertices[face][k])];
      }
      data.add_cell(CellType::triangle, t);
    }
  }
  data.fields.push_back({"f", Location::point, 1, {}});
  for (const Eigen::Vector3d& p : data.points) data.fields[0].values.push_back(f(p));
  return data;
}

TetMesh bare_box(int n) {
  TetMesh mesh = tests::box({0, 0, 0}, {1, 1, 1}, n, n, n, [](const auto&) { return 0.0; });
  mesh.fields.clear();
  return mesh;
}

TEST(SurfaceFields, LinearFieldsAreContinuedExactly) {
  TetMesh mesh = bare_box(6);
  const auto linear = [](const Eigen::Vector3d& p) { return 3 + p.x() - 2 * p.y() + 5 * p.z(); };
  std::vector<std::string> notes;
  carry_surface_fields(skin(mesh, linear), mesh, notes);
  ASSERT_EQ(mesh.fields.size(), 1U);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    EXPECT_NEAR(mesh.fields[0].values[i], linear(mesh.points[i]), 1e-6);
  }
  EXPECT_EQ(notes.size(), 1U);
}

// x y z is harmonic; the error of linear elements goes down with the square of their size.
TEST(SurfaceFields, HarmonicFieldsAreContinuedWithTheErrorOfLinearElements) {
  const auto harmonic = [](const Eigen::Vector3d& p) {
    return std::exp(p.x()) * std::sin(p.y()) + p.x() * p.y() * p.z();
  };
  const auto error = [&](int n) {
    TetMesh mesh = bare_box(n);
    std::vector<std::string> notes;
    carry_surface_fields(skin(mesh, harmonic), mesh, notes);
    double largest = 0;
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
      largest = std::max(largest, std::abs(mesh.fields[0].values[i] - harmonic(mesh.points[i])));
    }
    return largest;
  };
  const double coarse = error(4);
  EXPECT_LT(coarse, 2e-3);
  EXPECT_LT(error(8), 0.35 * coarse);
}

TEST(SurfaceFields, PointsAddedOnTheSurfaceTakeItsValuesThere) {
  const auto linear = [](const Eigen::Vector3d& p) { return p.x() + p.y() + p.z(); };
  const MeshData coarse = skin(bare_box(1), linear);
  TetMesh fine = bare_box(4);
  std::vector<std::string> notes;
  carry_surface_fields(coarse, fine, notes);
  for (std::size_t i = 0; i < fine.points.size(); ++i) {
    EXPECT_NEAR(fine.fields[0].values[i], linear(fine.points[i]), 1e-6);
  }
}

TEST(SurfaceFields, NothingWithinExceedsTheSurface) {
  TetMesh mesh = bare_box(5);
  const auto spike = [](const Eigen::Vector3d& p) { return p.norm() == 0 ? 1.0 : 0.0; };
  std::vector<std::string> notes;
  carry_surface_fields(skin(mesh, spike), mesh, notes);
  for (const double value : mesh.fields[0].values) {
    EXPECT_GE(value, -1e-7);
    EXPECT_LE(value, 1);
  }
}

}  // namespace
}  // namespace tetraglass::mesh
