#include "sort/mpvo.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "mesh/samples.h"
#include "sort/verify.h"
#include "sort/views.h"
#include "support/meshes.h"

namespace tetraglass::sort {
namespace {

using Eigen::Vector3d;

void expect_exact(const mesh::TetMesh& mesh, MpvoSorter& sorter, const View& view,
                  std::size_t rays) {
  const Order order = sorter.sort(view);
  EXPECT_EQ(order.method, "mpvo");
  EXPECT_TRUE(order.exact);
  EXPECT_EQ(order.cycles, 0U);
  std::vector<std::uint32_t> sorted = order.cells;
  std::sort(sorted.begin(), sorted.end());
  ASSERT_EQ(sorted, all_cells(mesh));
  EXPECT_EQ(check_faces(mesh, link_cells(mesh, all_cells(mesh)), order.cells, view).wrong, 0U);
  const RayCheck check = check_rays(mesh, order.cells, view, rays);
  EXPECT_EQ(check.wrong, 0U) << "of " << check.rays;
  EXPECT_EQ(check.overlapping, 0U);
}

// Convex; with cavities; in parts; with needles of cells.
TEST(Mpvo, HasNoWrongFaceAndNoWrongRay) {
  for (const char* name : {"sphere", "cavity", "shells", "needles"}) {
    SCOPED_TRACE(name);
    const mesh::TetMesh mesh = mesh::make_sample(name, 4000);
    MpvoSorter sorter(mesh, all_cells(mesh));
    // Nearly every needle on a ray has to be decided in exact numbers.
    const bool is_slow = std::string(name) == "needles";
    for (const View& view : random_views(mesh, is_slow ? 9 : 50)) {
      expect_exact(mesh, sorter, view, is_slow ? 5 : 40);
    }
  }
}

// Faces seen edge-on, by the zeros of the coordinates and by cancellation; the eye in the planes of
// many faces, on edges and on a vertex.
TEST(Mpvo, SeesFacesEdgeOn) {
  for (const char* name : {"sphere", "cavity"}) {
    SCOPED_TRACE(name);
    const mesh::TetMesh mesh = mesh::make_sample(name, 2000);
    MpvoSorter sorter(mesh, all_cells(mesh));
    const Vector3d vertex = mesh.points[mesh.cells[99][2]];
    for (const View& view : {parallel({1, 0, 0}), parallel({0, 0, -1}), parallel({1, 1, 0}),
                             parallel({1, -1, 1}), from({0, 0, 0}), from({5, 0, 0}),
                             from({1, 1, 1}), from(vertex), from(vertex + Vector3d(3, 3, 0))}) {
      expect_exact(mesh, sorter, view, 100);
    }
  }
}

TEST(Mpvo, FindsTheCyclesOfTheSample) {
  const mesh::TetMesh mesh = mesh::make_sample("cycle");
  const Order order = sort_mpvo(mesh, all_cells(mesh), parallel({0, 0, -1}));
  EXPECT_FALSE(order.exact);
  EXPECT_EQ(order.cycles, 2U);  // the ring and the three bars
  EXPECT_EQ(order.cyclic_cells.size(), mesh.cells.size());
  EXPECT_EQ(order.cells.size(), mesh.cells.size());
  // Of the ring's faces one is in the wrong order: the fewest that can be.
  EXPECT_EQ(
      check_faces(mesh, link_cells(mesh, all_cells(mesh)), order.cells, parallel({0, 0, -1})).wrong,
      1U);
  const Order aside = sort_mpvo(mesh, all_cells(mesh), parallel({1, 0.1, 0.2}));
  EXPECT_TRUE(aside.exact);
}

TEST(Mpvo, OfNothingAndOfOneCell) {
  const mesh::TetMesh empty;
  EXPECT_TRUE(sort_mpvo(empty, {}, from({1, 2, 3})).cells.empty());
  const mesh::TetMesh mesh = tests::unit_tetrahedron();
  const std::vector<std::uint32_t> one = {0};
  EXPECT_EQ(sort_mpvo(mesh, one, from({1, 2, 3})).cells, one);
  EXPECT_EQ(sort_mpvo(mesh, one, from(mesh.points[0])).cells, one);
  EXPECT_TRUE(sort_mpvo(mesh, {}, from({1, 2, 3})).cells.empty());
}

// A cell without volume between two cells: they see each other through it.
TEST(Mpvo, PassesOverCellsWithoutVolume) {
  mesh::TetMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, 1}, {0.2, 0.2, -1}, {0.3, 0.3, 0}};
  mesh.cells = {{0, 1, 2, 3}, {0, 1, 2, 5}, {0, 5, 1, 4}, {1, 5, 2, 4}, {2, 5, 0, 4}};
  MpvoSorter sorter(mesh, all_cells(mesh));
  for (const View& view : random_views(mesh, 30)) {
    const Order order = sorter.sort(view);
    EXPECT_TRUE(order.exact);
    EXPECT_EQ(order.cells.size(), mesh.cells.size());
    EXPECT_EQ(order.cells.front(), 1U);
    EXPECT_EQ(check_rays(mesh, order.cells, view, 200).wrong, 0U);
  }
}

TEST(Mpvo, OrdersDoubledCells) {
  mesh::TetMesh mesh = tests::box({0, 0, 0}, {1, 1, 1}, 2, 2, 2, [](const auto&) { return 0.0; });
  const std::size_t n = mesh.cells.size();
  for (std::size_t i = 0; i < n; i += 5) mesh.cells.push_back(mesh.cells[i]);
  MpvoSorter sorter(mesh, all_cells(mesh));
  for (const View& view : random_views(mesh, 30)) {
    const Order order = sorter.sort(view);
    EXPECT_TRUE(order.exact);
    EXPECT_EQ(check_rays(mesh, order.cells, view, 100).wrong, 0U);
  }
}

TEST(Mpvo, SortsOnlyTheCellsGiven) {
  const mesh::TetMesh mesh = mesh::make_sample("sphere", 3000);
  std::vector<std::uint32_t> cells = all_cells(mesh);
  std::shuffle(cells.begin(), cells.end(), std::mt19937(3));
  cells.resize(cells.size() / 3);
  MpvoSorter sorter(mesh, cells);
  std::sort(cells.begin(), cells.end());
  for (const View& view : random_views(mesh, 6)) {
    Order order = sorter.sort(view);
    // Loose cells hide each other in rings now and then.
    if (order.exact) {
      EXPECT_EQ(check_rays(mesh, order.cells, view, 200).wrong, 0U);
    }
    std::sort(order.cells.begin(), order.cells.end());
    EXPECT_EQ(order.cells, cells);
  }
}

TEST(Mpvo, SortsAMeshFarFromTheOriginAndFromAFarEye) {
  mesh::TetMesh mesh = mesh::make_sample("cavity", 2000);
  const Vector3d shift(0x1p30, -0x1p31, 0x1p29);
  for (Vector3d& p : mesh.points) p = (p * 0x1p8).array().round().matrix() * 0x1p-8 + shift;
  MpvoSorter sorter(mesh, all_cells(mesh));
  for (const View& view : random_views(mesh, 6)) expect_exact(mesh, sorter, view, 50);
  expect_exact(mesh, sorter, from(shift + 1e9 * Vector3d(1, 2, 3)), 50);
}

}  // namespace
}  // namespace tetraglass::sort
