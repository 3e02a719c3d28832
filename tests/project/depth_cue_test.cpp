#include "project/depth_cue.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "project/compare.h"
#include "project/gl/gl_projector.h"
#include "project/plan.h"
#include "project/reference/reference.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace tetraglass::project {
namespace {

using tests::constant_medium;

Image draw(const Scene& scene, Layout layout) {
  Request request;
  request.projector = Projector::gl;
  request.gl.layout = layout;
  Stats stats;
  return render_gl(scene, plan(scene, request), stats);
}

Image reference(const Scene& scene) {
  Stats stats;
  return render_reference(scene, stats);
}

TEST(DepthCue, IsLinearBetweenItsEnds) {
  const DepthCue cue{2, 6};
  EXPECT_EQ(cue.intensity(-1), 1);
  EXPECT_EQ(cue.intensity(2), 1);
  EXPECT_EQ(cue.intensity(3), 0.75);
  EXPECT_EQ(cue.intensity(6), 0);
  EXPECT_EQ(cue.intensity(1e300), 0);
}

// The surface x + z = 0 over [-1, 1]^3, seen from z = 10 along -z: at x it lies at the depth 10 +
// x.
TEST(DepthCue, DarkensAnObliquePlaneLinearly) {
  const mesh::TetMesh mesh =
      tests::box({-1, -1, -1}, {1, 1, 1}, 4, 4, 4, [](const auto& p) { return p.x() + p.z(); });
  Scene scene = tests::make_scene(mesh, Mode::iso, constant_medium({1, 1, 1}, 1), 40);
  scene.camera = tests::down_z(2);
  scene.isosurfaces = {{0, {0.8, 0.4, 1}, 1}};
  scene.depth_cue = DepthCue{9.5, 10.5};
  const Frame frame(scene.camera, 40, 40);
  for (const Image& image : {reference(scene), draw(scene, Layout::indexed)}) {
    for (int x = 0; x < 40; ++x) {
      const double at = frame.image_plane(x, 20).x();
      const double expected = std::clamp(0.5 - at, 0.0, 1.0);
      EXPECT_NEAR(image.pixel(x, 20)[0], 0.8 * expected, 1e-5) << x;
      EXPECT_NEAR(image.pixel(x, 20)[2], expected, 1e-5) << x;
      EXPECT_EQ(image.pixel(x, 20)[3], 1) << x;
    }
  }
}

TEST(DepthCue, IsThatOfTheReferenceInAllLayouts) {
  const mesh::TetMesh mesh =
      tests::box({-1, -1, -1}, {1, 1, 1}, 6, 6, 6, [](const auto& p) { return p.norm(); });
  for (const bool parallel : {true, false}) {
    for (const double opacity : {0.4, 1.0}) {
      Scene scene = tests::make_scene(mesh, Mode::iso, constant_medium({1, 1, 1}, 1), 96);
      scene.camera.parallel = parallel;
      scene.shading = Shading::flat;
      scene.isosurfaces = {{0.4, {1, 0, 0.2}, opacity}, {0.8, {0.1, 1, 0}, opacity}};
      const double eye = scene.camera.eye.norm();  // the mesh is centred on the origin
      scene.depth_cue = DepthCue{eye - 0.7, eye + 0.6};
      const Image expected = reference(scene);
      for (const Layout layout : {Layout::indexed, Layout::strip, Layout::faces12}) {
        // On rims a ray meets a surface or not by the rounding of floats.
        const Image image = draw(scene, layout);
        int different = 0;
        for (std::size_t i = 0; i < image.rgba.size(); ++i) {
          different += std::abs(image.rgba[i] - expected.rgba[i]) > 2e-3F ? 1 : 0;
        }
        EXPECT_LE(different, has_faces12(layout) ? 40 : 4)
            << to_string(layout) << " parallel " << parallel << " opacity " << opacity;
      }
    }
  }
}

TEST(DepthCue, IsRefusedWhereItIsNotHad) {
  const mesh::TetMesh mesh = tests::unit_tetrahedron();
  Scene scene = tests::make_scene(mesh, Mode::iso, constant_medium({1, 1, 1}, 1));
  scene.depth_cue = DepthCue{1, 2};
  EXPECT_EQ(plan(scene, {}).projector, Projector::gl);
  Request request;
  request.projector = Projector::cpu;
  EXPECT_THROW((void)plan(scene, request), base::UsageError);
  scene.mode = Mode::full;
  EXPECT_THROW((void)plan(scene, {}), base::UsageError);
}

}  // namespace
}  // namespace tetraglass::project
