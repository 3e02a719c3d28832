#include <random>

#include <gtest/gtest.h>

#include "project/slices/outline.h"
#include "project/slices/slabs.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace tetraglass::project::slices {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

struct Seen {
  mesh::TetMesh mesh =
      tests::box({-1, -0.5, -2}, {1, 0.75, 2}, 4, 3, 5, [](const Vector3d& p) { return p.x(); });
  Scene scene = tests::make_scene(mesh, Mode::full, tests::constant_medium({1, 1, 1}, 1));
  Seen() { scene.grid = mesh::rectilinear_grid(mesh); }

  [[nodiscard]] GridView view(const Camera& camera) {
    scene.camera = camera;
    const Frame frame = make_frame(scene);
    const gl::Normalization normalization(scene);
    return {scene, normalization, frame, gl::ViewUniforms(frame, normalization, scene).focus()};
  }
};

std::vector<Camera> cameras(const Camera& outside) {
  Camera inside = outside;
  inside.eye = {0.1, 0.2, 0.3};
  inside.fov_degrees = 120;
  Camera parallel = outside;
  parallel.parallel = true;
  return {outside, inside, parallel, tests::down_z(3)};
}

bool contains(const std::vector<Vector2d>& polygon, const Vector2d& p) {
  int left = 0;
  int right = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d a = polygon[i] - p;
    const Vector2d b = polygon[(i + 1) % polygon.size()] - p;
    (a.x() * b.y() - a.y() * b.x() >= 0 ? left : right)++;
  }
  return left == 0 || right == 0;
}

// Points of the grid, drawn at random: each is in the slab that holds it, and its image in the
// slab's outline.
TEST(SlabOutline, CoversTheImageOfItsSlab) {
  Seen seen;
  std::mt19937 random;
  const auto number = [&] { return double(random()) / 2147483647.5 - 1; };
  for (const Camera& camera : cameras(seen.scene.camera)) {
    const GridView view = seen.view(camera);
    const auto corners = view.corners({});
    const gl::Tile tile{10, 5, 40, 50};
    for (const Stack stack : {Stack::planes, Stack::shells, Stack::textures}) {
      const std::vector<Slab> slabs = make_slabs(view, *seen.scene.grid, stack, 0.07);
      for (int i = 0; i < 2000; ++i) {
        const Vector3d weight(0.5 + 0.5 * number(), 0.5 + 0.5 * number(), 0.5 + 0.5 * number());
        const Vector3d p = corners[0] + weight.x() * (corners[1] - corners[0]) +
                           weight.y() * (corners[2] - corners[0]) +
                           weight.z() * (corners[4] - corners[0]);
        if (!view.parallel() && p.z() <= 0) continue;
        const Vector2d pixel = view.pixel(p) - Vector2d(tile.x, tile.y);
        if (pixel.minCoeff() < 0 || pixel.x() > tile.width || pixel.y() > tile.height) continue;
        const double place = stack == Stack::textures ? view.to_box(p)[view.stack_axis()]
                             : stack == Stack::shells && !view.parallel() ? p.norm() - view.focus()
                                                                          : p.z() - view.focus();
        int found = 0;
        for (const Slab& slab : slabs) {
          if (place < slab.bounds[0] || place >= slab.bounds[1]) continue;
          ++found;
          GridBox box;
          box.low[view.stack_axis()] = std::max(-1.0, slab.low);
          box.high[view.stack_axis()] = std::min(1.0, slab.high);
          ASSERT_TRUE(contains(outline(view, view.corners(box), slab.depths, tile, 0.01), pixel));
        }
        ASSERT_EQ(found, 1) << to_string(stack);
      }
    }
  }
}

TEST(SlabOutline, NothingIsSeenBehindTheEyeOrBesideTheTile) {
  Seen seen;
  Camera away = seen.scene.camera;
  away.target = 2 * away.eye - away.target;
  const GridView behind = seen.view(away);
  const gl::Tile tile{0, 0, 64, 64};
  EXPECT_TRUE(outline(behind, behind.corners({}), {0, 1e9}, tile, 0.1).empty());
  EXPECT_TRUE(make_slabs(behind, *seen.scene.grid, Stack::planes, 0.1).empty());
  EXPECT_TRUE(make_slabs(behind, *seen.scene.grid, Stack::shells, 0.1).empty());
  const GridView parallel = seen.view(tests::down_z(3));
  EXPECT_TRUE(outline(parallel, parallel.corners({}), {0, 1e9}, {500, 0, 64, 64}, 0.1).empty());
}

// However near one looks: the grid is far larger than the picture.
TEST(SlabOutline, CoversATileWithinTheGrid) {
  Seen seen;
  for (const double height : {1e-3, 1e-10, 1e-18}) {
    Camera camera = seen.scene.camera;
    camera.parallel = true;
    camera.ortho_height = height;
    const GridView view = seen.view(camera);
    const std::vector<Vector2d> polygon =
        outline(view, view.corners({}), {-1e9, 1e9}, {0, 0, 64, 64}, 0.01);
    for (const Vector2d& corner :
         {Vector2d(0, 0), Vector2d(64, 0), Vector2d(64, 64), Vector2d(0, 64)}) {
      EXPECT_TRUE(!polygon.empty() && contains(polygon, corner)) << height;
    }
  }
}

TEST(Slabs, FollowEachOtherFromFarToNear) {
  Seen seen;
  for (const Camera& camera : cameras(seen.scene.camera)) {
    const GridView view = seen.view(camera);
    for (const Stack stack : {Stack::planes, Stack::shells}) {
      const std::vector<Slab> slabs = make_slabs(view, *seen.scene.grid, stack, 0.07);
      ASSERT_GT(slabs.size(), 10U);
      for (std::size_t i = 0; i + 1 < slabs.size(); ++i) {
        EXPECT_EQ(slabs[i].bounds[0], slabs[i + 1].bounds[1]);
      }
    }
    // One at each of the grid's planes.
    const std::vector<Slab> textures = make_slabs(view, *seen.scene.grid, Stack::textures, 0);
    EXPECT_EQ(textures.size(), seen.scene.grid->size(static_cast<std::size_t>(view.stack_axis())));
  }
}

}  // namespace
}  // namespace tetraglass::project::slices
