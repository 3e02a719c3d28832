#include <cmath>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "project/gl/cell_projector.h"
#include "project/gl/functions.inl"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace tetraglass::project {
namespace {

Scene wave_scene(const mesh::TetMesh& mesh, Mode mode) {
  const preint::TransferFunction tf(
      {{-1.0, {0.1, 0.2, 0.9}, 0.0}, {0.2, {0.2, 1.0, 0.3}, 2.0}, {2.0, {1.0, 0.9, 0.2}, 5.0}});
  Scene scene = tests::make_scene(mesh, mode, tf, 128);
  if (mode == Mode::iso) {
    scene.isosurfaces = {{0.3, {1, 0, 0}, 1}};
    scene.shading = Shading::smooth;
  }
  return scene;
}

// The same shaders and, where there is no GPU, the same rasterizer.
TEST(GlContext, EglDrawsTheSamePicture) {
  std::unique_ptr<gl::Context> egl;
  try {
    egl = gl::Context::create(ContextKind::egl);
  } catch (const base::UnavailableError& error) {
    GTEST_SKIP() << error.what();
  }
  const auto osmesa = gl::Context::create(ContextKind::osmesa);
  std::cout << egl->description() << ", " << osmesa->description() << '\n';
  const mesh::TetMesh mesh =
      tests::box({0, 0, 0}, {1, 1, 1}, 5, 5, 5, [](const Eigen::Vector3d& p) {
        return std::sin(3 * p.x()) * std::cos(4 * p.y()) + p.z() * p.z();
      });
  for (const Mode mode :
       {Mode::thickness, Mode::full, Mode::emission, Mode::absorption, Mode::mip, Mode::iso}) {
    const Scene scene = wave_scene(mesh, mode);
    Request request;
    request.projector = Projector::gl;
    const Plan how = plan(scene, request);
    const Frame frame(scene.camera, scene.width, scene.height);
    Stats stats;
    gl::CellProjector first(*osmesa, scene, how, stats);
    gl::CellProjector second(*egl, scene, how, stats);
    const Image a = first.draw(frame, stats);
    const Image b = second.draw(frame, stats);
    const Image again = first.draw(frame, stats);  // the two contexts take turns
    double difference = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) {
      difference = std::max(difference, std::abs(double{a.rgba[i]} - b.rgba[i]));
    }
    EXPECT_LE(difference, 1e-6) << to_string(mode);
    EXPECT_EQ(a.rgba, again.rgba) << to_string(mode);
  }
}

// Every drawing ends with a check, so none of OpenGL's errors goes by unseen in any test.
TEST(GlContext, ErrorsBecomeExceptionsInTheWordsOfOpenGl) {
  ASSERT_NE(std::getenv("TETRAGLASS_GL_DEBUG"), nullptr) << "set by ctest";
  for (const ContextKind kind : {ContextKind::osmesa, ContextKind::egl}) {
    std::unique_ptr<gl::Context> context;
    try {
      context = gl::Context::create(kind);
    } catch (const base::UnavailableError& error) {
      std::cout << error.what() << '\n';
      continue;
    }
    EXPECT_NO_THROW(context->check("nothing"));
    context->gl().Enable(0x1234567);
    try {
      context->check("testing");
      FAIL() << to_string(kind) << " hides an error";
    } catch (const base::Error& error) {
      const std::string what = error.what();
      EXPECT_EQ(what.rfind("testing: OpenGL says: ", 0), 0U) << what;
      EXPECT_NE(what.find("glEnable"), std::string::npos) << what;
    }
    EXPECT_NO_THROW(context->check("nothing")) << "told once";
  }
}

TEST(GlContext, SaysWhyThereIsNone) {
  EXPECT_THROW((void)gl::Context::create(ContextKind::none), base::UnavailableError);
}

}  // namespace
}  // namespace tetraglass::project
