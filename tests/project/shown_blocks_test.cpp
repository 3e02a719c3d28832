#include "project/slices/shown_blocks.h"

#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace tetraglass::project::slices {
namespace {

using Eigen::Vector3i;

/// How many of the boxes have the voxel.
int count(const std::vector<Block>& blocks, const Vector3i& voxel) {
  int found = 0;
  for (const Block& block : blocks) {
    if ((voxel.array() >= block.low.array()).all() && (voxel.array() < block.high.array()).all()) {
      ++found;
    }
  }
  return found;
}

TEST(ShownBlocks, HoldWhatShowsOnceAndLittleElse) {
  // 1 within a ball around (30, 10, 20), 0 elsewhere.
  const auto ball = [](const Eigen::Vector3d& p) {
    return (p - Eigen::Vector3d(30, 10, 20)).norm() < 7 ? 1.0 : 0.0;
  };
  const mesh::TetMesh mesh = tests::box({0, 0, 0}, {70, 33, 48}, 70, 33, 48, ball);
  const mesh::RectilinearGrid grid = mesh::rectilinear_grid(mesh);
  const BlockRanges ranges(grid, mesh.fields[0].values);
  const auto shows = [](double, double most) { return most > 0; };
  for (const int reach : {0, 1, 20}) {
    const std::vector<Block> blocks =
        ranges.shown(whole_grid(grid), Vector3i::Constant(reach), shows);
    int voxels = 0;
    for (int z = 0; z < 48; ++z) {
      for (int y = 0; y < 33; ++y) {
        for (int x = 0; x < 70; ++x) {
          const int found = count(blocks, {x, y, z});
          ASSERT_LE(found, 1);
          voxels += found;
          // Its own corners lie within half a voxel's diagonal of its centre.
          const Eigen::Vector3d centre(x + 0.5, y + 0.5, z + 0.5);
          const bool near = (centre - Eigen::Vector3d(30, 10, 20)).norm() < 7 + reach;
          ASSERT_TRUE(!near || found == 1);
        }
      }
    }
    EXPECT_LE(voxels, reach == 0 ? 2 * 2 * 2 * 16 * 16 * 16 : 70 * 33 * 48);
  }
  const auto all =
      ranges.shown(whole_grid(grid), Vector3i::Zero(), [](double, double) { return true; });
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].high, Vector3i(70, 33, 48));
  EXPECT_EQ(box_of(all[0], grid).low, GridBox().low);
  EXPECT_EQ(box_of(all[0], grid).high, GridBox().high);
}

}  // namespace
}  // namespace tetraglass::project::slices
