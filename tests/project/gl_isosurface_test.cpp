// The isosurfaces of the sphere sample (148,955 cells): spheres of known radius.
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "mesh/samples.h"
#include "project/gl/gl_projector.h"
#include "project/plan.h"
#include "project/reference/reference.h"
#include "tests/support/scenes.h"

namespace tetraglass::project {
namespace {

constexpr int kSize = 256;
constexpr double kRadius = 0.7;

class GlIsosurface : public testing::TestWithParam<bool> {
 protected:
  GlIsosurface() : mesh_(mesh::make_sample("sphere")) {}

  Scene scene() const {
    Scene scene = tests::make_scene(mesh_, Mode::iso, tests::constant_medium({1, 1, 1}, 1), kSize);
    scene.camera.parallel = GetParam();
    return scene;
  }

  static Image draw(const Scene& scene) {
    Request request;
    request.projector = Projector::gl;
    Stats stats;
    return render_gl(scene, plan(scene, request), stats);
  }

  /// How far the ray of the pixel passes the origin, in world units.
  static double distance(const Frame& frame, int x, int y) {
    const Eigen::Vector2d plane = frame.image_plane(x, y);
    const Eigen::Vector3d origin = frame.eye() + frame.axes().transpose() * frame.ray_origin(plane);
    const Eigen::Vector3d ray =
        (frame.axes().transpose() * frame.ray_direction(plane)).normalized();
    return (origin - origin.dot(ray) * ray).norm();
  }

  /// The side of a pixel at the distance of the origin.
  static double pixel_size(const Frame& frame) {
    return frame.parallel() ? frame.pitch() : frame.pitch() * frame.eye().norm();
  }

  /// The pixels that a disc has whose radius is `radius` pixels.
  static double disc(double radius) { return 3.14159265 * radius * radius; }

  mesh::TetMesh mesh_;
};

INSTANTIATE_TEST_SUITE_P(Gl, GlIsosurface, testing::Values(true, false), [](const auto& shown) {
  return shown.param ? "parallel" : "perspective";
});

// The field is that of the distance interpolated along edges, which lies above the distance by at
// most edge^2 / (8 radius): far less than a pixel.
TEST_P(GlIsosurface, SphereHasNoHolesAndNothingOutside) {
  Scene wanted = scene();
  wanted.isosurfaces = {{kRadius, {1, 1, 1}, 1}};
  const Image image = draw(wanted);
  const Frame frame(wanted.camera, kSize, kSize);
  const double pixel = pixel_size(frame);
  int inside = 0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const double passes = distance(frame, x, y);
      if (passes < kRadius - pixel) {
        ++inside;
        ASSERT_EQ(image.pixel(x, y)[3], 1) << x << ' ' << y;
      }
      if (passes > kRadius) {
        ASSERT_EQ(image.pixel(x, y)[3], 0) << x << ' ' << y;
      }
    }
  }
  EXPECT_GT(inside, 0.95 * disc(kRadius / pixel - 1));
}

// A ray through a sphere meets its surface twice: walls drawn twice, or once, would show in the
// opacity. Near the rim the facets make their own silhouettes: there the reference tells.
TEST_P(GlIsosurface, SphereHasNoDoubleWalls) {
  Scene wanted = scene();
  wanted.isosurfaces = {{kRadius, {1, 1, 1}, 0.5}};
  const Image image = draw(wanted);
  Stats stats;
  const Image expected = render_reference(wanted, stats);
  const Frame frame(wanted.camera, kSize, kSize);
  int inside = 0;
  int different = 0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      if (distance(frame, x, y) < 0.95 * kRadius) {
        ++inside;
        ASSERT_NEAR(image.pixel(x, y)[3], 0.75, 1e-6) << x << ' ' << y;
      }
      different += std::abs(image.pixel(x, y)[3] - expected.pixel(x, y)[3]) > 1e-6 ? 1 : 0;
    }
  }
  EXPECT_GT(inside, 0.95 * disc(0.95 * kRadius / pixel_size(frame)));
  EXPECT_LE(different, 4) << "rays that graze a facet";
}

// Spheres in each other, cut open so that each is the nearest one somewhere.
TEST_P(GlIsosurface, NearestSurfaceWinsAtEveryPixel) {
  Scene wanted = scene();
  wanted.isosurfaces = {{0.3, {0, 0, 1}, 1}, {0.9, {1, 0, 0}, 1}, {0.6, {0, 1, 0}, 1}};
  wanted.clip = {{wanted.camera.eye.normalized(), 0.2}};
  const Image image = draw(wanted);
  Stats stats;
  const Image expected = render_reference(wanted, stats);
  std::array<int, 3> seen{};
  int different = 0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      bool same = true;
      for (int c = 0; c < 4; ++c) {
        same = same && std::abs(image.pixel(x, y)[c] - expected.pixel(x, y)[c]) < 1e-6;
      }
      different += same ? 0 : 1;
      for (std::size_t c = 0; c < 3; ++c) seen[c] += image.pixel(x, y)[c] > 0.5F ? 1 : 0;
    }
  }
  EXPECT_LE(different, 4) << "rays that graze a facet or a cut";
  for (const int pixels : seen) EXPECT_GT(pixels, 500);
}

}  // namespace
}  // namespace tetraglass::project
