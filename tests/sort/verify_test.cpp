#include "sort/verify.h"

#include <gtest/gtest.h>

#include "mesh/samples.h"
#include "sort/views.h"
#include "support/meshes.h"

namespace tetraglass::sort {
namespace {

// A row of bricks along x; any order of the bricks but one is wrong when seen along x.
mesh::TetMesh row(int n) {
  return tests::box({0, 0, 0}, {double(n), 1, 1}, n, 1, 1, [](const auto&) { return 0.0; });
}

TEST(Verify, CountsFacesInTheWrongOrder) {
  // Two cells above and below the plane z = 0.
  mesh::TetMesh mesh = tests::unit_tetrahedron();
  mesh.points.emplace_back(0, 0, -1);
  mesh.cells.push_back({0, 2, 1, 4});
  const CellLinks links = link_cells(mesh, all_cells(mesh));
  const std::vector<std::uint32_t> up_first = {0, 1};
  const std::vector<std::uint32_t> down_first = {1, 0};
  const auto wrong = [&](const std::vector<std::uint32_t>& order, const View& view) {
    return check_faces(mesh, links, order, view).wrong;
  };
  EXPECT_EQ(wrong(down_first, from({0.2, 0.2, 5})), 0U);
  EXPECT_EQ(wrong(up_first, from({0.2, 0.2, 5})), 1U);
  EXPECT_EQ(wrong(down_first, from({0.2, 0.2, -5})), 1U);
  EXPECT_EQ(wrong(up_first, parallel({0, 0.1, 1})), 0U);
  EXPECT_EQ(wrong(down_first, parallel({0, 0.1, 1})), 1U);
  // Edge-on, no order is wrong.
  EXPECT_EQ(check_faces(mesh, links, up_first, from({9, 1, 0})).faces, 0U);
  EXPECT_EQ(check_faces(mesh, links, up_first, parallel({1, 2, 0})).faces, 0U);
}

TEST(Verify, FindsEveryRayThatMeetsAWrongPair) {
  const mesh::TetMesh mesh = row(4);
  std::vector<std::uint32_t> order = all_cells(mesh);
  // Swapping whole bricks is wrong on every ray along x; the cells within a brick are wrong too.
  std::rotate(order.begin(), order.begin() + 6, order.end());
  const RayCheck check = check_rays(mesh, order, parallel({-1, 0, 0}), 200);
  EXPECT_EQ(check.rays, 200U);
  EXPECT_EQ(check.wrong, 200U);
  EXPECT_EQ(check.overlapping, 0U);
}

// Rays along x through boxes whose faces lie across them: the pieces of a ray fill [0, 4].
TEST(Verify, RaysMeetEveryCellOnTheirWay) {
  const mesh::TetMesh mesh = row(4);
  for (const View& view : {parallel({1, 1e-3, 2e-3}), from({-5, 0.4, 0.6})}) {
    const RayCheck check = check_fragments(mesh, all_cells(mesh), view, 200);
    EXPECT_EQ(check.wrong, 0U);
    EXPECT_EQ(check.overlapping, 0U);
    EXPECT_GE(check.pieces, 4 * check.rays);
  }
}

TEST(Verify, TellsOverlapsFromWrongOrders) {
  mesh::TetMesh mesh = tests::unit_tetrahedron();
  mesh.cells.push_back(mesh.cells[0]);
  for (const std::vector<std::uint32_t>& order :
       {std::vector<std::uint32_t>{0, 1}, std::vector<std::uint32_t>{1, 0}}) {
    const RayCheck check = check_rays(mesh, order, from({3, 4, 5}), 50);
    EXPECT_EQ(check.wrong, 0U);
    EXPECT_EQ(check.overlapping, 50U);
  }
}

TEST(Verify, RaysStartAtTheEye) {
  const mesh::TetMesh mesh = row(9);
  const View inside = from({4.5, 0.3, 0.4});
  std::vector<std::uint32_t> order = all_cells(mesh);
  // Farthest first on both sides of the eye.
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::abs(int(a) / 6 - 4) > std::abs(int(b) / 6 - 4);
  });
  std::vector<std::uint32_t> one_per_brick;
  for (const std::uint32_t cell : order) {
    if (cell % 6 == 0) one_per_brick.push_back(cell);
  }
  EXPECT_EQ(check_rays(mesh, one_per_brick, inside, 300).wrong, 0U);
  std::reverse(one_per_brick.begin(), one_per_brick.end());
  EXPECT_GT(check_rays(mesh, one_per_brick, inside, 300).wrong, 0U);
}

// Whatever hides what: each pixel sorts for itself.
TEST(Verify, FragmentsAreRightInCycles) {
  const mesh::TetMesh mesh = mesh::make_sample("cycle");
  for (const View& view : random_views(mesh, 12)) {
    EXPECT_EQ(check_fragments(mesh, all_cells(mesh), view, 300).wrong, 0U);
  }
  EXPECT_EQ(check_fragments(mesh, all_cells(mesh), parallel({0, 0, -1}), 3000).wrong, 0U);
}

TEST(Verify, OfNoCells) {
  const mesh::TetMesh empty;
  EXPECT_EQ(check_rays(empty, {}, from({1, 2, 3}), 10).rays, 0U);
  EXPECT_EQ(check_faces(empty, link_cells(empty, {}), {}, from({1, 2, 3})).faces, 0U);
}

}  // namespace
}  // namespace tetraglass::sort
