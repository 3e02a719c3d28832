#include "project/slices/grid_texture.h"

#include <gtest/gtest.h>

#include "tests/support/grids.h"

namespace tetraglass::project::slices {
namespace {

std::size_t bytes_of(const Scene& scene, const SlicesPlan& plan) {
  const auto context = gl::Context::create(ContextKind::osmesa);
  const GridTexture texture(*context, scene, plan, points_of(whole_grid(*scene.grid)), 2);
  return texture.bytes();
}

TEST(GridTexture, CompressionTakesHalfAByteANumber) {
  const mesh::TetMesh mesh = tests::box({0, 0, 0}, {1, 1, 1}, 31, 15, 9, tests::bent);
  const Scene scene = tests::grid_scene(mesh, Mode::full, tests::smooth_medium());
  SlicesPlan plan;
  plan.stack = Stack::textures;
  const std::size_t points = 32 * 16 * 10;
  EXPECT_EQ(bytes_of(scene, plan), 4 * points);
  plan.texels = TexelBits::bits8;
  EXPECT_EQ(bytes_of(scene, plan), points);
  plan.classify = Classify::pre;
  EXPECT_EQ(bytes_of(scene, plan), 4 * points);
  plan.compress = true;
  EXPECT_EQ(bytes_of(scene, plan), points);
  plan.classify = Classify::post;
  EXPECT_EQ(bytes_of(scene, plan), points / 2);
}

// A block of 4 x 4 texels has 8 values from its least to its most, in steps of 1/7 of the range.
TEST(GridTexture, CompressionRoundsToASeventhOfABlocksRange) {
  const mesh::TetMesh mesh = tests::grid_mesh([](const Eigen::Vector3d& p) { return p.x(); });
  Scene scene = tests::grid_scene(
      mesh, Mode::absorption, preint::TransferFunction({{-1, {1, 1, 1}, 0}, {1, {1, 1, 1}, 1}}));
  scene.camera = tests::down_z(2);
  SlicesRequest request;
  request.stack = Stack::textures;
  const Image exact = tests::draw_slices(scene, request);
  request.compress = true;
  const Image image = tests::draw_slices(scene, request);
  // Of 8 points along x a block has 4: 3/7 of the extinctions, 0 to 1; half a step, and that of 8
  // bits, times the depth.
  const double step = 3.0 / 7 / 7;
  double largest = 0;
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) {
    largest = std::max(
        largest, std::abs(std::log1p(-double(image.rgba[i])) - std::log1p(-double(exact.rgba[i]))));
  }
  EXPECT_LT(largest, 4 * (step / 2 + 1.0 / 255));
  EXPECT_GT(largest, 1e-3);
}

// Colors are stored in 5 and 6 bits, opacities in 8.
TEST(GridTexture, S3tcKeepsAConstantMediumToItsBits) {
  const mesh::TetMesh mesh = tests::grid_mesh([](const auto&) { return 0.5; });
  Scene scene = tests::grid_scene(mesh, Mode::full, tests::constant_medium({0.2, 0.5, 1}, 1));
  SlicesRequest request;
  request.stack = Stack::textures;
  request.classify = Classify::pre;
  request.texels = TexelBits::bits8;
  const Image rounded = tests::draw_slices(scene, request);
  request.compress = true;
  const Image image = tests::draw_slices(scene, request);
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    ASSERT_NEAR(image.rgba[i + 3], rounded.rgba[i + 3], 1e-3);
    // A driver's color is off by a step at most, 1/31, of slabs with alpha >= 1 - exp(-1/4).
    for (std::size_t c = 0; c < 3; ++c) {
      ASSERT_NEAR(image.rgba[i + c], rounded.rgba[i + c], 1 / 31.0 / 0.22 * image.rgba[i + 3]);
    }
  }
}

}  // namespace
}  // namespace tetraglass::project::slices
