#include "project/clip.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "project/compare.h"
#include "project/plan.h"
#include "project/render.h"
#include "tests/support/chord.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace tetraglass::project {
namespace {

const Eigen::AlignedBox3d kBox(Eigen::Vector3d(-1, -0.5, -2), Eigen::Vector3d(1, 0.75, 2));

double wave(const Eigen::Vector3d& p) {
  return std::sin(3 * p.x()) * std::cos(4 * p.y()) + 0.25 * p.z();
}

Image draw(const Scene& scene, Projector projector, Layout layout = Layout::indexed) {
  Request request;
  request.projector = projector;
  if (projector == Projector::gl) request.gl.layout = layout;
  const Plan how = plan(scene, request);
  Stats stats;
  return render(scene, how, stats);
}

class ClipTest : public testing::Test {
 protected:
  ClipTest() : mesh_(tests::box(kBox.min(), kBox.max(), 4, 3, 5, wave)) {}

  Scene scene(Mode mode, bool parallel, int size = 64) const {
    const preint::TransferFunction tf(
        {{-1.5, {0.1, 0.2, 0.9}, 0.0}, {0.2, {0.2, 1.0, 0.3}, 1.0}, {1.5, {1.0, 0.9, 0.2}, 2.0}});
    Scene scene = tests::make_scene(mesh_, mode, tf, size);
    scene.camera.parallel = parallel;
    if (mode == Mode::iso) {
      scene.isosurfaces = {{0.1, {1, 0, 0}, 1}, {-0.4, {0, 1, 0}, 1}};
      scene.shading = Shading::smooth;
    }
    return scene;
  }

  mesh::TetMesh mesh_;
};

// Planes along the axes leave a box, whose chords are known.
TEST_F(ClipTest, ThicknessIsTheChordOfWhatIsLeft) {
  Eigen::AlignedBox3d left = kBox;
  left.max().x() = 0.3;
  left.min().z() = -0.7;
  for (const bool parallel : {true, false}) {
    for (const bool inside : {false, true}) {
      Scene wanted = scene(Mode::thickness, parallel);
      wanted.clip = {{{2, 0, 0}, 0.6}, {{0, 0, -1}, 0.7}};
      if (inside) wanted.camera.eye = {0.6, 0.1, -1};
      const Frame frame(wanted.camera, wanted.width, wanted.height);
      for (const Projector projector : {Projector::reference, Projector::gl, Projector::cpu}) {
        const Image image = draw(wanted, projector);
        for (int y = 0; y < wanted.height; ++y) {
          for (int x = 0; x < wanted.width; ++x) {
            ASSERT_NEAR(image.pixel(x, y)[0], tests::chord(left, frame, x, y), 1e-5)
                << to_string(projector) << ' ' << x << ' ' << y << " parallel " << parallel
                << " inside " << inside;
          }
        }
      }
    }
  }
}

TEST_F(ClipTest, CutsCellsAsTheReferenceDoes) {
  for (const bool parallel : {true, false}) {
    for (const Mode mode :
         {Mode::full, Mode::emission, Mode::absorption, Mode::mip, Mode::iso, Mode::thickness}) {
      Scene wanted = scene(mode, parallel);
      wanted.clip = {{{1, 0.7, 0.4}, 0.05}, {{-0.3, 0.2, 1}, 1.1}};
      if (mode == Mode::full) {
        // One color for all values: the order of cells, which centroids get wrong, does not matter.
        wanted.transfer_function =
            preint::TransferFunction({{-1.5, {0.9, 0.5, 0.2}, 0.0}, {1.5, {0.9, 0.5, 0.2}, 2.0}});
      }
      const Image expected = draw(wanted, Projector::reference);
      EXPECT_LT(compare(draw(wanted, Projector::gl), expected).max, 2e-4)
          << to_string(mode) << " parallel " << parallel;
      EXPECT_LT(compare(draw(wanted, Projector::cpu), expected).max, 1e-5)
          << to_string(mode) << " parallel " << parallel;
    }
  }
}

TEST_F(ClipTest, WorksWithInterpolatedParameters) {
  Scene wanted = scene(Mode::thickness, true);
  wanted.clip = {{{1, 0.7, 0.4}, 0.05}};
  const Image expected = draw(wanted, Projector::gl);
  const Image image = draw(wanted, Projector::gl, Layout::faces12);
  int bad = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    bad += std::abs(image.rgba[i] - expected.rgba[i]) > 1e-2F ? 1 : 0;
  }
  EXPECT_LE(bad, 4) << "of 4096; silhouettes are rounded by the rasterizer";
}

// The eye's cell is cut where its values have grown beyond measure.
TEST_F(ClipTest, CutsTheCellOfTheEye) {
  for (const Mode mode : {Mode::full, Mode::emission, Mode::mip, Mode::thickness}) {
    Scene wanted = scene(mode, false);
    wanted.camera.eye = {0.61, 0.13, -1.05};
    wanted.camera.target = {-0.2, 0.2, 0.4};
    for (const double offset : {-1.0, -0.6, 0.1}) {
      wanted.clip = {{{1, 0.2, -0.4}, offset}};
      EXPECT_LT(compare(draw(wanted, Projector::cpu), draw(wanted, Projector::reference)).max, 1e-5)
          << to_string(mode) << " offset " << offset;
    }
  }
}

// A half space and its complement hold all of it.
TEST_F(ClipTest, TwoHalvesAreTheWhole) {
  Scene wanted = scene(Mode::emission, false);
  const Image whole = draw(wanted, Projector::reference);
  wanted.clip = {{{0.3, -1, 0.2}, 0.1}};
  const Image first = draw(wanted, Projector::reference);
  wanted.clip = {{{-0.3, 1, -0.2}, -0.1}};
  const Image second = draw(wanted, Projector::reference);
  double most = 0;
  for (std::size_t i = 0; i < whole.rgba.size(); ++i) {
    ASSERT_NEAR(first.rgba[i] + second.rgba[i], whole.rgba[i], 1e-5);
    most = std::max<double>(most, first.rgba[i]);
  }
  EXPECT_GT(most, 0.1);
}

TEST_F(ClipTest, MayKeepAllOrNothing) {
  Scene wanted = scene(Mode::thickness, false);
  const Image whole = draw(wanted, Projector::gl);
  wanted.clip = {{{1e-30, 0, 0}, 1e30}};
  const Image all = draw(wanted, Projector::gl);
  for (std::size_t i = 0; i < all.rgba.size(); ++i) {
    ASSERT_NEAR(all.rgba[i], whole.rgba[i], 2e-6);  // of up to 4.6, a few roundings apart
  }
  wanted.clip = {{{1, 0, 0}, -1e300}};
  for (const Projector projector : {Projector::gl, Projector::cpu, Projector::reference}) {
    const Image nothing = draw(wanted, projector);
    EXPECT_EQ(*std::max_element(nothing.rgba.begin(), nothing.rgba.end()), 0);
  }
}

}  // namespace
}  // namespace tetraglass::project
