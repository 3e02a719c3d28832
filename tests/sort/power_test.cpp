#include "sort/power.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "mesh/samples.h"
#include "mesh/tetrahedralize.h"
#include "sort/verify.h"
#include "sort/views.h"
#include "support/meshes.h"

namespace tetraglass::sort {
namespace {

using Eigen::Vector3d;

mesh::TetMesh random_delaunay(int points) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(-1, 1);
  mesh::MeshData data;
  for (int i = 0; i < points; ++i) {
    data.points.emplace_back(unit(random), unit(random), unit(random));
  }
  std::vector<std::string> notes;
  return mesh::delaunay(data, notes);
}

void expect_exact(const mesh::TetMesh& mesh, PowerSorter& sorter, const View& view,
                  std::size_t rays) {
  const Order order = sorter.sort(view);
  EXPECT_EQ(order.method, "power");
  EXPECT_TRUE(order.exact);
  std::vector<std::uint32_t> sorted = order.cells;
  std::sort(sorted.begin(), sorted.end());
  ASSERT_EQ(sorted, all_cells(mesh));
  EXPECT_EQ(check_faces(mesh, link_cells(mesh, all_cells(mesh)), order.cells, view).wrong, 0U);
  EXPECT_EQ(check_rays(mesh, order.cells, view, rays).wrong, 0U);
}

TEST(Power, HasNoWrongFaceAndNoWrongRayOnARandomDelaunayMesh) {
#ifndef TETRAGLASS_WITH_CGAL
  GTEST_SKIP() << "this build makes no Delaunay tetrahedra";
#endif
  const mesh::TetMesh mesh = random_delaunay(700);
  PowerSorter sorter(mesh, all_cells(mesh));
  for (const View& view : random_views(mesh, 50)) expect_exact(mesh, sorter, view, 12);
  expect_exact(mesh, sorter, from(mesh.points[5]), 40);
}

// Five cells of one sphere in each voxel; with holes the spheres alone say what hides what.
TEST(Power, OrdersCellsOfOneSphereAndAcrossGaps) {
  for (const char* name : {"sphere", "cavity"}) {
    SCOPED_TRACE(name);
    const mesh::TetMesh mesh = mesh::make_sample(name, 1200);
    PowerSorter sorter(mesh, all_cells(mesh));
    for (const View& view : random_views(mesh, 50)) expect_exact(mesh, sorter, view, 12);
    // Whole layers of equal powers.
    for (const View& view : {parallel({1, 0, 0}), parallel({1, 1, 0}), from({0, 0, 0}),
                             from({9, 0, 0}), from(mesh.points[77])}) {
      expect_exact(mesh, sorter, view, 12);
    }
  }
}

TEST(Power, RefusesMeshesThatAreNotDelaunay) {
  const mesh::TetMesh mesh = mesh::make_sample("shells", 2000);
  EXPECT_THROW(PowerSorter(mesh, all_cells(mesh)), base::InputError);
}

// Two cells back to back, and apart from them a third one within the circumsphere of the first.
TEST(Power, LooksAcrossGaps) {
  mesh::TetMesh mesh = tests::unit_tetrahedron();
  mesh.points.insert(mesh.points.end(), {{0.5, 0.5, 0.5}, {3, 3, 0.5}, {3, 0.5, 3}, {0.5, 3, 3}});
  mesh.cells.push_back({4, 5, 6, 7});
  if (tests::volume(mesh, mesh.cells[1]) < 0) std::swap(mesh.cells[1][0], mesh.cells[1][1]);
  try {
    const PowerSorter sorter(mesh, all_cells(mesh));
    FAIL() << "not refused";
  } catch (const base::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("boundary face"), std::string::npos) << error.what();
  }
  for (Vector3d& p : mesh.points) {
    if (p.minCoeff() >= 0.5) p += Vector3d(2, 2, 2);
  }
  EXPECT_NO_THROW(PowerSorter(mesh, all_cells(mesh)));
}

// A regular triangulation that is no Delaunay one: a quadrilateral bipyramid cut into three cells
// around the axis by the weights of its ends.
TEST(Power, TakesWeights) {
  mesh::TetMesh mesh;
  mesh.points = {{0, 0, 2}, {0, 0, -2}, {1, 0, 0}, {-0.5, 0.8, 0}, {-0.5, -0.8, 0}};
  mesh.cells = {{0, 1, 2, 3}, {0, 1, 3, 4}, {0, 1, 4, 2}};
  for (mesh::Cell& cell : mesh.cells) {
    if (tests::volume(mesh, cell) < 0) std::swap(cell[2], cell[3]);
  }
  const std::vector<std::uint32_t> cells = all_cells(mesh);
  EXPECT_THROW(PowerSorter(mesh, cells), base::InputError);
  const std::vector<double> weights = {3.5, 3.5, 0, 0, 0};
  PowerSorter sorter(mesh, cells, weights);
  for (const View& view : random_views(mesh, 30)) expect_exact(mesh, sorter, view, 12);
}

TEST(Power, OfNothingOneCellAndCellsWithoutVolume) {
  const mesh::TetMesh empty;
  EXPECT_TRUE(PowerSorter(empty, {}).sort(from({1, 2, 3})).cells.empty());
  mesh::TetMesh mesh = tests::unit_tetrahedron();
  mesh.cells.push_back({0, 1, 2, 2});
  PowerSorter sorter(mesh, all_cells(mesh));
  EXPECT_EQ(sorter.sort(from({1, 2, 3})).cells, (std::vector<std::uint32_t>{1, 0}));
}

}  // namespace
}  // namespace tetraglass::sort
