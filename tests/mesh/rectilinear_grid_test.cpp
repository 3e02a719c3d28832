#include "mesh/rectilinear_grid.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "mesh/decompose.h"
#include "mesh/volume.h"
#include "support/meshes.h"

namespace tetraglass::mesh {
namespace {

Volume slanted(std::array<std::size_t, 3> size) {
  Volume volume;
  volume.size = size;
  volume.origin = {10, 20, 30};
  volume.axes << 0.1, 0.02, 0, 0, -0.3, 0.01, 0, 0, 0.5;
  for (std::size_t i = 0; i < volume.points(); ++i) volume.values.push_back(double(i % 17));
  return volume;
}

TEST(RectilinearGrid, IsFoundInADecomposedVolume) {
  const Volume volume = slanted({5, 4, 3});
  const TetMesh mesh = decompose(volume_mesh(volume)).mesh;
  const RectilinearGrid grid = rectilinear_grid(mesh);
  EXPECT_LT((grid.origin - volume.origin).norm(), 1e-14);
  EXPECT_LT((grid.axes - volume.axes).norm(), 1e-14);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_TRUE(grid.even[k]);
    EXPECT_EQ(grid.size(k), volume.size[k]);
    EXPECT_EQ(grid.coordinates[k].back(), double(volume.size[k] - 1));
  }
  EXPECT_EQ(mesh.fields[0].values, volume.values);
}

TEST(RectilinearGrid, UnevenAxesKeepTheirCoordinates) {
  TetMesh mesh = tests::box({0, 0, 0}, {3, 2, 4}, 3, 2, 4, [](const auto&) { return 0.0; });
  for (Eigen::Vector3d& p : mesh.points) p.y() = p.y() * p.y() + 1;  // 1, 2, 5
  const RectilinearGrid grid = rectilinear_grid(mesh);
  EXPECT_TRUE(grid.even[0] && !grid.even[1] && grid.even[2]);
  EXPECT_EQ(grid.coordinates[1], (std::vector<double>{0, 1, 4}));
  EXPECT_EQ(grid.origin, Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(grid.index_at({1.5, 2.5, 4}), Eigen::Vector3d(1.5, 1.5, 4));
  EXPECT_EQ(grid.index_at({-1, 9, 5}), Eigen::Vector3d(0, 2, 4));
}

TEST(RectilinearGrid, OtherMeshesAreRefused) {
  const TetMesh box = tests::box({0, 0, 0}, {3, 3, 3}, 3, 3, 3, [](const auto&) { return 0.0; });
  const auto refused = [](const TetMesh& mesh) {
    EXPECT_THROW(static_cast<void>(rectilinear_grid(mesh)), base::InputError);
  };
  TetMesh mesh = box;
  mesh.points[21].x() += 0.1;  // curvilinear
  refused(mesh);
  mesh = box;
  mesh.cells.erase(mesh.cells.begin() + 30);  // a hole
  refused(mesh);
  mesh = box;
  mesh.cells.push_back(mesh.cells[7]);  // one cell twice
  refused(mesh);
  mesh = box;
  mesh.points.emplace_back(9, 9, 9);
  refused(mesh);
  mesh = box;
  std::swap(mesh.points[0], mesh.points[63]);  // another order
  refused(mesh);
  refused(tests::unit_tetrahedron());
  refused({});
}

TEST(RectilinearGrid, IsFoundInCellsThatAreNotSplit) {
  const MeshData data = volume_mesh(slanted({5, 4, 3}));
  const RectilinearGrid grid = rectilinear_grid(data);
  EXPECT_EQ(grid.size(0), 5U);
  EXPECT_EQ(grid.size(2), 3U);
  TetMesh points;
  points.points = data.points;
  EXPECT_EQ(rectilinear_grid(points).axes, grid.axes);
  EXPECT_EQ(bounds(points).max(), bounds(decompose(data).mesh).max());
  const auto refused = [](const MeshData& other) {
    EXPECT_THROW(static_cast<void>(rectilinear_grid(other)), base::InputError);
  };
  MeshData missing = data;
  missing.types.pop_back();
  missing.offsets.pop_back();
  missing.connectivity.resize(missing.offsets.back());
  refused(missing);
  MeshData twice = data;
  std::copy_n(twice.connectivity.begin(), 8, twice.connectivity.begin() + 8);
  refused(twice);
  MeshData torn = data;
  std::swap(torn.connectivity[0], torn.connectivity[17]);
  refused(torn);
  MeshData outside = data;
  outside.connectivity[8] = 4000000000;
  refused(outside);
  MeshData tetrahedra = data;
  tetrahedra.types[3] = CellType::wedge;
  refused(tetrahedra);
  MeshData surface = data;  // cells below dimension 3 do not matter
  surface.add_cell(CellType::triangle, std::array<std::uint32_t, 3>{0, 1, 7});
  EXPECT_EQ(rectilinear_grid(surface).size(1), 4U);
}

TEST(RectilinearGrid, InterpolationIsExactForProductsOfCoordinates) {
  const auto f = [](const Eigen::Vector3d& p) {
    return (1 + 2 * p.x()) * (3 - p.y()) * (p.z() + 0.5);
  };
  const TetMesh mesh = tests::box({0, 0, 0}, {3, 2, 4}, 3, 2, 4, f);
  const RectilinearGrid grid = rectilinear_grid(mesh);
  for (const Eigen::Vector3d& at :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(3, 2, 4), Eigen::Vector3d(1.25, 0.5, 3.75)}) {
    EXPECT_NEAR(interpolate(grid, mesh.fields[0].values, at), f(at), 1e-13);
  }
}

}  // namespace
}  // namespace tetraglass::mesh
