#include <algorithm>

#include <gtest/gtest.h>

#include "mesh/adjacency.h"
#include "mesh/check.h"
#include "mesh/distance.h"
#include "mesh/gradients.h"
#include "mesh/import.h"
#include "support/data.h"
#include "support/meshes.h"

// What is derived from meshes that people use: facts known from elsewhere, and identities.
namespace tetraglass::mesh {
namespace {

TetMesh read(const char* file) {
  return import_mesh((tests::data_folder() / file).string()).mesh;
}

TEST(RealMeshes, TheCubeOfTetrahedronVtuIsConvex) {
  SKIP_WITHOUT_DATA();
  const TetMesh mesh = read("tets/Tetrahedron.vtu");
  const Soundness soundness = check(mesh);
  EXPECT_TRUE(soundness.convex);
  EXPECT_EQ(soundness.parts, 1U);
  EXPECT_EQ(soundness.degenerate, 0U);
  // In the cube [0, 2]^3 the distance to the boundary is the distance to the nearest side.
  const std::vector<double> distances = boundary_distance(mesh);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const auto& p = mesh.points[i].array();
    EXPECT_NEAR(distances[i], std::min(p.minCoeff(), (2 - p).minCoeff()), 1e-14);
  }
}

// Every inner face belongs to two cells: 4 cells = 2 inner + boundary. Volumes are those of the
// sources.
TEST(RealMeshes, AreManifoldAndOfKnownVolume) {
  SKIP_WITHOUT_DATA();
  struct Known {
    const char* file;
    std::size_t cells;
    double volume;
  };
  for (const Known& known :
       {Known{"tets/octahedron.ele", 1224, 256.0 / 3}, Known{"tets/a_grid.vtk", 4802, 0.0913993},
        Known{"tets/CylinderLinear.vtk", 1522, 3.05608e-05},
        Known{"tets/bracket_appended_compressed.vtu", 206208, 0.00270362},
        Known{"tets/piezo_mesh_micro.vtk", 42744, 0.934806}}) {
    const TetMesh mesh = read(known.file);
    EXPECT_EQ(mesh.cells.size(), known.cells) << known.file;
    double volume = 0;
    for (const Cell& cell : mesh.cells) volume += tests::volume(mesh, cell);
    EXPECT_NEAR(volume / known.volume, 1, 1e-5) << known.file;
    const Adjacency adjacency = face_adjacency(mesh);
    std::size_t linked = 0;
    for (const auto& neighbors : adjacency.neighbors) {
      linked += static_cast<std::size_t>(
          std::count_if(neighbors.begin(), neighbors.end(), [](auto n) { return n != kNoCell; }));
    }
    EXPECT_EQ(4 * mesh.cells.size(), linked + adjacency.boundary_faces) << known.file;
    EXPECT_EQ(adjacency.crowded_faces, 0U) << known.file;
    const Soundness soundness = check(mesh);
    EXPECT_EQ(soundness.degenerate, 0U) << known.file;
    EXPECT_GT(soundness.min_dihedral_degrees, 0) << known.file;
    EXPECT_LE(soundness.min_dihedral_degrees, 70.53) << known.file;  // that of the regular cell
  }
}

TEST(RealMeshes, MeshesWithHolesAreNotConvex) {
  SKIP_WITHOUT_DATA();
  EXPECT_FALSE(check(read("tets/piezo_mesh_micro.vtk")).convex);
  EXPECT_FALSE(check(read("tets/bracket_appended_compressed.vtu")).convex);
}

// Volume-weighted means need no division by the volume of a sliver: they are accurate whatever the
// cells.
TEST(RealMeshes, TheGradientOfACoordinateIsItsUnitVector) {
  SKIP_WITHOUT_DATA();
  for (const char* file : {"tets/a_grid.vtk", "tets/piezo_mesh_micro.vtk"}) {
    const TetMesh mesh = read(file);
    for (const Eigen::Vector3d& g : vertex_gradients(mesh, select_scalar(mesh, "x"))) {
      if (g.isZero(0)) continue;  // a point that no cell uses
      EXPECT_LT((g - Eigen::Vector3d::UnitX()).norm(), 1e-9) << file;
    }
  }
}

}  // namespace
}  // namespace tetraglass::mesh
