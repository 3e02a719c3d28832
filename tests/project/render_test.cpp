#include "project/render.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "project/compare.h"
#include "project/reference/reference.h"
#include "tests/support/chord.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace tetraglass::project {
namespace {

const Eigen::AlignedBox3d kBox(Eigen::Vector3d(-1, -0.5, -2), Eigen::Vector3d(1, 0.75, 2));

double wave(const Eigen::Vector3d& p) {
  return std::sin(3 * p.x()) * std::cos(4 * p.y()) + 0.25 * p.z();
}

class RenderTest : public testing::TestWithParam<Projector> {
 protected:
  RenderTest() : mesh_(tests::box(kBox.min(), kBox.max(), 4, 3, 5, wave)) {}

  Scene scene(Mode mode) const {
    return tests::make_scene(
        mesh_, mode,
        preint::TransferFunction({{-1.5, {0.1, 0.2, 0.9}, 0.0}, {1.5, {1.0, 0.9, 0.2}, 2.0}}), 50);
  }

  static Image draw(const Scene& scene) {
    Request request;
    request.projector = GetParam();
    Stats stats;
    return render(scene, plan(scene, request), stats);
  }

  mesh::TetMesh mesh_;
};

// Parts of a picture are the picture, whatever its cuts do to tiles and blocks of pixels.
TEST_P(RenderTest, RegionsAreThePicture) {
  for (const bool parallel : {true, false}) {
    Scene wanted = scene(Mode::full);
    wanted.camera.parallel = parallel;
    wanted.height = 37;
    const Image whole = draw(wanted);
    for (const Region& region : {Region{0, 0, 23, 37}, Region{23, 0, 27, 37}, Region{11, 30, 5, 1},
                                 Region{49, 36, 1, 1}}) {
      wanted.region = region;
      const Image part = draw(wanted);
      ASSERT_EQ(part.width, region.width);
      ASSERT_EQ(part.height, region.height);
      for (int y = 0; y < region.height; ++y) {
        for (int x = 0; x < region.width; ++x) {
          for (int c = 0; c < 4; ++c) {
            ASSERT_NEAR(part.pixel(x, y)[c], whole.pixel(region.x + x, region.y + y)[c], 2e-6)
                << x << ' ' << y << " parallel " << parallel;
          }
        }
      }
    }
  }
}

TEST_P(RenderTest, RegionsOutsideThePictureAreRefused) {
  Scene wanted = scene(Mode::thickness);
  for (const Region& region : {Region{-1, 0, 5, 5}, Region{0, 0, 0, 5}, Region{46, 0, 5, 5}}) {
    wanted.region = region;
    EXPECT_THROW(draw(wanted), base::UsageError);
  }
}

// Chords of the rays that share a pixel, computed on their own.
TEST_P(RenderTest, SamplesShareAPixelEvenly) {
  Scene wanted = scene(Mode::thickness);
  wanted.samples = 3;
  wanted.region = Region{4, 9, 40, 20};
  const Image image = draw(wanted);
  ASSERT_EQ(image.width, 40);
  ASSERT_EQ(image.height, 20);
  const Frame fine(wanted.camera, 150, 150);
  int edges = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      double sum = 0;
      int met = 0;
      for (int i = 0; i < 9; ++i) {
        const double chord = tests::chord(kBox, fine, 3 * (x + 4) + i % 3, 3 * (y + 9) + i / 3);
        sum += chord;
        met += chord > 0 ? 1 : 0;
      }
      ASSERT_NEAR(image.pixel(x, y)[0], sum / 9, 1e-5) << x << ' ' << y;
      ASSERT_NEAR(image.pixel(x, y)[3], met / 9.0, 1e-6) << x << ' ' << y;
      edges += met > 0 && met < 9 ? 1 : 0;
    }
  }
  EXPECT_GT(edges, 10);
}

INSTANTIATE_TEST_SUITE_P(All, RenderTest,
                         testing::Values(Projector::cpu, Projector::gl, Projector::reference),
                         [](const auto& of) { return to_string(of.param); });

// What pictures are verified by takes the same samples.
TEST(Render, SinglePixelsOfTheReferenceHaveTheSamplesOfThePicture) {
  const mesh::TetMesh mesh = tests::box(kBox.min(), kBox.max(), 2, 3, 2, wave);
  Scene scene = tests::make_scene(mesh, Mode::full, tests::constant_medium({0.5, 1, 0.25}, 1), 24);
  scene.samples = 2;
  scene.region = Region{5, 3, 17, 18};
  Request request;
  request.projector = Projector::reference;
  Stats stats;
  const Image image = render(scene, plan(scene, request), stats);
  std::vector<Eigen::Vector2i> pixels;
  for (int i = 0; i < 17; ++i) pixels.emplace_back(i, i);
  const std::vector<Eigen::Array4d> single = reference_pixels(scene, pixels);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    for (Eigen::Index c = 0; c < 4; ++c) {
      EXPECT_NEAR(image.pixel(pixels[i].x(), pixels[i].y())[c], single[i][c], 1e-6);
    }
  }
}

}  // namespace
}  // namespace tetraglass::project
