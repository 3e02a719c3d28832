#include "project/slices/bricks.h"

#include <string>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "tests/support/grids.h"

namespace tetraglass::project::slices {
namespace {

using Eigen::Vector3i;

mesh::RectilinearGrid grid_of(int x, int y, int z) {
  mesh::RectilinearGrid grid;
  const std::array<int, 3> size = {x, y, z};
  for (std::size_t k = 0; k < 3; ++k) {
    grid.even[k] = true;
    for (int i = 0; i < size[k]; ++i) grid.coordinates[k].push_back(i);
  }
  return grid;
}

TEST(Bricks, FillTheGridOnceWithNoMorePointsThanFit) {
  const mesh::RectilinearGrid grid = grid_of(21, 13, 34);
  for (const int border : {0, 1, 3}) {
    for (const std::size_t most : {1000U, 20U * 20U * 20U}) {
      const std::vector<Brick> bricks =
          make_bricks(grid, Vector3i::Constant(border), most, 17 + 2 * border);
      int voxels = 0;
      for (const Brick& brick : bricks) {
        const Vector3i size = brick.voxels.high - brick.voxels.low;
        const Vector3i points = brick.points.high - brick.points.low + Vector3i::Ones();
        EXPECT_GT(size.minCoeff(), 0);
        voxels += size.prod();
        EXPECT_LE(points.prod(), static_cast<int>(most));
        EXPECT_LE(points.maxCoeff(), 17 + 2 * border);
        for (int k = 0; k < 3; ++k) {
          EXPECT_EQ(brick.points.low[k], std::max(0, brick.voxels.low[k] - border));
        }
      }
      EXPECT_EQ(voxels, 20 * 12 * 33);
    }
  }
  EXPECT_EQ(make_bricks(grid, Vector3i::Ones(), 1000000, 2048).size(), 1U);
  EXPECT_THROW(static_cast<void>(make_bricks(grid, Vector3i::Ones(), 63, 2048)),
               base::UnavailableError);
}

// The same picture with and without bricks: every slab is drawn once, with the same values.
TEST(Bricks, HaveNoSeams) {
  const mesh::TetMesh mesh =
      tests::box(tests::kGridBox.min(), tests::kGridBox.max(), 20, 12, 27, tests::bent);
  for (const Mode mode : {Mode::full, Mode::thickness}) {
    Scene scene = tests::grid_scene(mesh, mode, tests::smooth_medium(), 48);
    for (const tests::View& view : tests::grid_views()) {
      scene.camera = view.camera;
      for (const Stack stack : {Stack::planes, Stack::shells}) {
        for (const Classify classify : {Classify::integrated, Classify::post, Classify::pre}) {
          const bool outside = view.name == std::string("outside");
          if (classify != Classify::integrated && (mode != Mode::full || !outside)) continue;
          SlicesRequest request;
          request.stack = stack;
          request.classify = classify;
          request.slices = 70;
          Stats whole;
          const Image image = tests::draw_slices(scene, request, &whole);
          request.brick_bytes = classify == Classify::pre ? 32000 : 8000;
          Stats parts;
          EXPECT_LT(tests::difference(tests::draw_slices(scene, request, &parts), image).largest,
                    tests::kSliceRounding)
              << view.name << ' ' << to_string(stack) << ' ' << to_string(classify);
          EXPECT_EQ(parts.fragments, whole.fragments) << view.name << ' ' << to_string(stack);
        }
      }
    }
  }
}

TEST(Bricks, ShadedSurfacesHaveNoSeams) {
  const mesh::TetMesh mesh =
      tests::box(tests::kGridBox.min(), tests::kGridBox.max(), 24, 18, 33, tests::bent);
  Scene scene = tests::grid_scene(mesh, Mode::iso, tests::smooth_medium(), 64);
  scene.isosurfaces = {{0.2, {1, 0.5, 0.2}, 0.6}};
  scene.shading = Shading::smooth;
  SlicesRequest request;
  request.slices = 70;
  const Image image = tests::draw_slices(scene, request);
  request.brick_bytes = 8000;
  EXPECT_LT(tests::difference(tests::draw_slices(scene, request), image).rms, 1e-5);
}

}  // namespace
}  // namespace tetraglass::project::slices
