// What every order of cells has in common: the real meshes, and input that is hardly a mesh.

#include <algorithm>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "mesh/import.h"
#include "mesh/samples.h"
#include "sort/cell_sorter.h"
#include "sort/verify.h"
#include "sort/views.h"
#include "support/data.h"
#include "support/meshes.h"

namespace tetraglass::sort {
namespace {

class EveryOrder : public testing::TestWithParam<Method> {
 protected:
  // All cells are there; of exact orders no face and no ray is wrong.
  static void expect_order(const mesh::TetMesh& mesh, const View& view, bool has_faces = true) {
    const std::vector<std::uint32_t> cells = all_cells(mesh);
    CellSorter sorter(GetParam(), mesh, cells);
    const Order& order = sorter.sort(view);
    EXPECT_EQ(order.method, to_string(GetParam()));
    std::vector<std::uint32_t> sorted = order.cells;
    std::sort(sorted.begin(), sorted.end());
    ASSERT_EQ(sorted, cells);
    EXPECT_EQ(order.exact, GetParam() != Method::centroid);
    if (!order.exact) return;
    if (has_faces) {
      EXPECT_EQ(check_faces(mesh, link_cells(mesh, cells), order.cells, view).wrong, 0U);
    }
    EXPECT_EQ(check_rays(mesh, order.cells, view, 50).wrong, 0U);
  }
};

TEST_P(EveryOrder, OfNoCellAndOfOne) {
  expect_order(mesh::TetMesh{}, from({1, 2, 3}));
  const mesh::TetMesh one = tests::unit_tetrahedron();
  for (const View& view : {from({1, 2, 3}), from({0.1, 0.1, 0.1}), from({0, 0, 0}), from({5, 5, 0}),
                           parallel({1, 0, 0}), parallel({1, 1, 1})}) {
    expect_order(one, view);
  }
}

// In the planes of many faces, on an edge and on a vertex.
TEST_P(EveryOrder, OfAnEyeInThePlanesOfFaces) {
  const mesh::TetMesh mesh =
      tests::box({0, 0, 0}, {4, 4, 4}, 4, 4, 4, [](const auto&) { return 0.0; });
  for (const View& view : {from({2, 2, 2}), from({2, 2, 9}), from({2, 1.5, 1}), from({-3, 0, 0}),
                           parallel({1, 0, 0}), parallel({1, 1, 0})}) {
    expect_order(mesh, view);
  }
}

TEST_P(EveryOrder, OfCellsWithoutVolumeAndDoubledCells) {
  mesh::TetMesh mesh = tests::box({0, 0, 0}, {2, 2, 2}, 2, 2, 2, [](const auto&) { return 0.0; });
  mesh.cells.push_back({0, 1, 2, 2});
  mesh.cells.push_back({3, 3, 3, 3});
  for (const View& view : random_views(mesh, 6)) expect_order(mesh, view);
  mesh.cells.push_back(mesh.cells[7]);
  try {
    for (const View& view : random_views(mesh, 6)) expect_order(mesh, view, false);
  } catch (const base::InputError&) {
    EXPECT_EQ(GetParam(), Method::power);  // it may refuse a mesh, not order it wrongly
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, EveryOrder,
                         testing::Values(Method::centroid, Method::power, Method::mpvo),
                         [](const auto& method) { return to_string(method.param); });

// Of whole meshes as engineers have them, parallel, from outside and from inside.
// scripts/verify-orders does the same from 50 views.
void expect_exact(const std::string& file) {
  const mesh::TetMesh mesh = mesh::import_mesh((tests::data_folder() / file).string()).mesh;
  const std::vector<std::uint32_t> cells = all_cells(mesh);
  const CellLinks links = link_cells(mesh, cells);
  CellSorter mpvo(Method::mpvo, mesh, cells);
  CellSorter centroid(Method::centroid, mesh, cells);
  std::size_t wrong = 0;
  for (const View& view : random_views(mesh, 3)) {
    const Order& order = mpvo.sort(view);
    EXPECT_TRUE(order.exact);
    EXPECT_EQ(check_faces(mesh, links, order.cells, view).wrong, 0U);
    EXPECT_EQ(check_rays(mesh, order.cells, view, 20).wrong, 0U);
    wrong += check_faces(mesh, links, centroid.sort(view).cells, view).wrong;
  }
  EXPECT_GT(wrong, 0U);  // what the check would have found
}

TEST(RealMeshes, BluntFinIsInExactOrder) {
  SKIP_WITHOUT_DATA();
  expect_exact("classics/bluntfinxyz.bin");
}

TEST(RealMeshes, LiquidOxygenPostIsInExactOrder) {
  SKIP_WITHOUT_DATA();
  expect_exact("classics/postxyz.bin");
}

TEST(RealMeshes, ElephantByTetGenIsInExactOrder) {
#ifndef TETRAGLASS_WITH_TETGEN
  GTEST_SKIP() << "this build fills no surfaces with TetGen";
#endif
  SKIP_WITHOUT_DATA();
  expect_exact("surfaces/elephant.off");
}

}  // namespace
}  // namespace tetraglass::sort
