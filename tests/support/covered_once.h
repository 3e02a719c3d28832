#pragma once

#include <gtest/gtest.h>

#include "project/image.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace tetraglass::tests {

/// Expects of `draw`, which takes a scene to its picture, that rays through edges and faces that
/// cells share meet each cell exactly once, and that silhouettes are decided as the reference does:
/// as if the ray were moved to the right and up.
template <class Draw>
void expect_edges_covered_once(const Draw& draw) {
  // Pixel centres at the quarters of the bricks, on their diagonals; half a brick to the side on
  // their edges.
  const mesh::TetMesh mesh = box({0, 0, 0}, {8, 8, 8}, 8, 8, 8, [](const auto&) { return 0.0; });
  project::Scene scene =
      make_scene(mesh, project::Mode::thickness, constant_medium({1, 1, 1}, 1), 16);
  for (const double shift : {0.0, 0.25, 0.5}) {
    scene.camera = down_z(8, {4 + shift, 4 + shift});
    const project::Frame frame(scene.camera, 16, 16);
    const project::Image image = draw(scene);
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x) {
        const Eigen::Vector2d at = frame.image_plane(x, y).array() + 4 + shift;
        const bool inside = (at.array() >= 0).all() && (at.array() < 8).all();
        EXPECT_NEAR(image.pixel(x, y)[0], inside ? 8 : 0, 1e-5) << x << ' ' << y << ' ' << shift;
      }
    }
  }
}

}  // namespace tetraglass::tests
