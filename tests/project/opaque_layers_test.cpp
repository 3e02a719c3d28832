#include "project/opaque_layers.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "project/compare.h"
#include "project/plan.h"
#include "project/render.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace tetraglass::project {
namespace {

const Eigen::AlignedBox3d kBox(Eigen::Vector3d(-1, -0.5, -2), Eigen::Vector3d(1, 0.75, 2));
constexpr auto kCellProjectors = {Projector::reference, Projector::gl, Projector::cpu};

double wave(const Eigen::Vector3d& p) {
  return std::sin(3 * p.x()) * std::cos(4 * p.y()) + 0.25 * p.z();
}

Image draw(const Scene& scene, Projector projector) {
  Request request;
  request.projector = projector;
  Stats stats;
  return render(scene, plan(scene, request), stats);
}

/// The square of this side around a point of the z axis, across it.
OpaqueSurface square(double side, double z, const preint::Color& color) {
  const double h = side / 2;
  return shaded_surface({{-h, -h, z}, {h, -h, z}, {h, h, z}, {-h, h, z}}, {{0, 1, 2}, {0, 2, 3}},
                        color);
}

OpaqueSurface octahedron(double radius) {
  std::vector<Eigen::Vector3d> points;
  for (int axis = 0; axis < 3; ++axis) {
    points.emplace_back(radius * Eigen::Vector3d::Unit(axis));
    points.emplace_back(-radius * Eigen::Vector3d::Unit(axis));
  }
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const std::uint32_t x : {0U, 1U}) {
    for (const std::uint32_t y : {2U, 3U}) {
      for (const std::uint32_t z : {4U, 5U}) triangles.push_back({x, y, z});
    }
  }
  return shaded_surface(points, triangles, {0.8, 0.3, 0.2});
}

/// What a headlight makes of a color seen at a right angle: ambient, diffuse and specular light.
preint::Color seen_straight(const preint::Color& color) {
  return 0.8 * color + 0.2;
}

class OpaqueTest : public testing::Test {
 protected:
  OpaqueTest() : mesh_(tests::box(kBox.min(), kBox.max(), 4, 3, 5, wave)) {}

  Scene scene(Mode mode, bool parallel) const {
    const preint::TransferFunction tf(
        {{-1.5, {0.1, 0.2, 0.9}, 0.0}, {0.2, {0.2, 1.0, 0.3}, 1.0}, {1.5, {1.0, 0.9, 0.2}, 2.0}});
    Scene scene = tests::make_scene(mesh_, mode, tf, 64);
    scene.camera.parallel = parallel;
    if (mode == Mode::iso) {
      scene.isosurfaces = {{0.1, {1, 0, 0}, 1}, {-0.4, {0, 1, 0}, 1}};
      scene.shading = Shading::smooth;
    }
    return scene;
  }

  mesh::TetMesh mesh_;
};

// A medium of one color c and extinction k before a plane of color p: c (1 - e) + p e, with
// e = exp(-k l) of the length l in front of the plane.
TEST_F(OpaqueTest, APlaneInAUniformMediumHasTheColorOfTheClosedForm) {
  const preint::Color medium(0.2, 0.5, 0.9);
  const preint::Color plane(0.9, 0.4, 0.1);
  constexpr double kExtinction = 0.7;
  for (const double z : {-1.3, 0.0, 1.9, 5.0, -3.0}) {
    Scene wanted =
        tests::make_scene(mesh_, Mode::full, tests::constant_medium(medium, kExtinction), 32);
    wanted.camera = tests::down_z(1);
    wanted.camera.up = Eigen::Vector3d::UnitY();
    wanted.opaque.surfaces = {square(8, z, plane)};
    const double front = std::clamp(kBox.max().z() - z, 0.0, kBox.sizes().z());
    const double through = std::exp(-kExtinction * front);
    const preint::Color expected = (1 - through) * medium + through * seen_straight(plane);
    for (const Projector projector : kCellProjectors) {
      const Image image = draw(wanted, projector);
      for (std::size_t pixel = 0; pixel < image.rgba.size(); pixel += 4) {
        for (int c = 0; c < 3; ++c) {
          ASSERT_NEAR(image.rgba[pixel + static_cast<std::size_t>(c)], expected[c], 2e-6)
              << to_string(projector) << " plane at " << z << " pixel " << pixel / 4;
        }
        ASSERT_NEAR(image.rgba[pixel + 3], 1, 2e-6);
      }
    }
  }
}

TEST_F(OpaqueTest, EveryModeAgreesWithTheReference) {
  for (const bool parallel : {true, false}) {
    for (const bool inside : {false, true}) {
      for (const Mode mode : {Mode::full, Mode::emission, Mode::absorption, Mode::mip, Mode::iso}) {
        Scene wanted = scene(mode, parallel);
        wanted.opaque.lines = box_outline(kBox, {0.7, 0.6, 0.5}, 2.5);
        wanted.opaque.surfaces = {octahedron(0.6)};
        if (inside) {
          wanted.camera.eye = {0.61, 0.13, -1.05};
          wanted.camera.target = {-0.2, 0.2, 0.4};
        }
        const Image expected = draw(wanted, Projector::reference);
        const Image cpu = draw(wanted, Projector::cpu);
        const Image gl = draw(wanted, Projector::gl);
        const std::string what =
            to_string(mode) + (parallel ? " parallel" : " perspective") + (inside ? " inside" : "");
        EXPECT_LT(compare(cpu, expected).max, 2e-5) << what;
        EXPECT_LT(compare(gl, expected).max, 5e-4) << what;
        Scene bare = wanted;
        bare.opaque = {};
        EXPECT_GT(compare(draw(bare, Projector::cpu), cpu).max, 0.1) << what << ": nothing drawn";
      }
    }
  }
}

TEST_F(OpaqueTest, WhatIsOutOfSightChangesNoBit) {
  for (const bool parallel : {true, false}) {
    const Scene bare = scene(Mode::full, parallel);
    Scene wanted = bare;
    const Eigen::Vector3d away = (bare.camera.eye - bare.camera.target).cross(bare.camera.up);
    wanted.opaque.lines = {{50 * away, 51 * away, {1, 1, 1}, 3}};
    for (const Projector projector : kCellProjectors) {
      EXPECT_EQ(draw(bare, projector).rgba, draw(wanted, projector).rgba) << to_string(projector);
    }
  }
}

TEST_F(OpaqueTest, ALineShowsInFrontOfTheVolumeAndNotBehindAnOpaqueOne) {
  for (const double z : {3.0, -3.0}) {
    Scene wanted = tests::make_scene(mesh_, Mode::full, tests::constant_medium({0, 0, 1}, 100), 32);
    wanted.camera = tests::down_z(1);
    wanted.opaque.lines = {{{0, -1, z}, {0, 1, z}, {1, 0, 0}, 4}};
    for (const Projector projector : kCellProjectors) {
      const Image image = draw(wanted, projector);
      const float* middle = image.pixel(16, 16);
      EXPECT_NEAR(middle[0], z > 0 ? 1 : 0, 1e-6) << to_string(projector);
      EXPECT_NEAR(middle[2], z > 0 ? 0 : 1, 1e-6) << to_string(projector);
      EXPECT_NEAR(image.pixel(4, 16)[2], 1, 1e-6) << to_string(projector);
    }
  }
}

// Two lines of half coverage, one behind the other: each takes its share of what the one before
// lets through, with its own part of the volume in front.
TEST_F(OpaqueTest, LinesBehindEachOtherAddUp) {
  Scene wanted = tests::make_scene(mesh_, Mode::full, tests::constant_medium({0, 0, 1}, 0.5), 32);
  wanted.camera = tests::down_z(1);
  wanted.opaque.lines = {{{0, -1, 1}, {0, 1, 1}, {1, 0, 0}, 1},
                         {{0, -1, -1}, {0, 1, -1}, {0, 1, 0}, 1}};
  const double e1 = std::exp(-0.5);
  const double e3 = std::exp(-1.5);
  const double e4 = std::exp(-2.0);
  for (const Projector projector : kCellProjectors) {
    const Image image = draw(wanted, projector);
    for (const int x : {15, 16}) {  // the line lies between these
      const float* rgba = image.pixel(x, 16);
      EXPECT_NEAR(rgba[0], 0.5 * e1, 2e-6) << to_string(projector);
      EXPECT_NEAR(rgba[1], 0.25 * e3, 2e-6) << to_string(projector);
      EXPECT_NEAR(rgba[2], 0.5 * (1 - e1) + 0.25 * (1 - e3) + 0.25 * (1 - e4), 2e-6);
      EXPECT_NEAR(rgba[3], 0.75 + 0.25 * (1 - e4), 2e-6);
    }
  }
}

double total_coverage(const OpaqueLayers& layers, int y, int width) {
  double sum = 0;
  for (int x = 0; x < width; ++x) {
    for (const OpaqueFragment& fragment : layers.fragments(x, y)) sum += fragment.coverage;
  }
  return sum;
}

TEST(OpaqueLayersTest, LinesCoverTheirWidthWhereverTheyLie) {
  for (const double width : {0.4, 1.0, 1.5, 3.0}) {
    for (const double x : {0.0, 0.013, 0.02, 0.031}) {
      const Camera camera = tests::down_z(1);
      const OpaqueGeometry geometry{{{{x, -1, 0}, {x, 1, 0}, {1, 1, 1}, width}}, {}};
      const Frame frame(camera, 32, 32);
      const OpaqueLayers layers(geometry, {}, frame, 1);
      EXPECT_NEAR(total_coverage(layers, 7, 32), width, 1e-6) << width << " at " << x;
      const OpaqueLayers finer(geometry, {}, Frame(camera, 96, 96), 3);
      EXPECT_NEAR(total_coverage(finer, 20, 96), 3 * width, 1e-6) << "3 samples a pixel";
    }
  }
}

// At the corner of an outline three lines meet: one piece, no darker than each of them.
TEST(OpaqueLayersTest, CornersAreOfOnePiece) {
  const OpaqueGeometry geometry{box_outline(kBox, {1, 1, 1}, 1.5), {}};
  Camera camera = frame_camera(kBox, {1, 0.8, 0.6}, Eigen::Vector3d::UnitZ(), 30, 1);
  for (const bool parallel : {true, false}) {
    camera.parallel = parallel;
    const Frame frame(camera, 200, 200);
    const OpaqueLayers layers(geometry, {}, frame, 1);
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d p =
          frame.to_camera(kBox.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
      const Eigen::Vector2d plane = parallel ? p.head<2>() : Eigen::Vector2d(p.head<2>() / p.z());
      const Eigen::Vector2i pixel = frame.pixel(plane).array().round().cast<int>();
      int near_corner = 0;
      for (const OpaqueFragment& fragment : layers.fragments(pixel.x(), pixel.y())) {
        near_corner += std::abs(fragment.depth - p.z()) < 0.2 ? 1 : 0;
      }
      EXPECT_EQ(near_corner, 1) << "corner " << corner << " parallel " << parallel;
    }
  }
}

TEST(OpaqueLayersTest, SurfacesHaveNoGapsAndTheNearestWins) {
  // A fan whose edges run through pixel centres.
  std::vector<Eigen::Vector3d> points = {{0.5 / 32, 0.5 / 32, 0}};
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (int i = 0; i < 24; ++i) {
    const double angle = i * M_PI / 12;
    points.emplace_back(points[0] + 3 * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0));
    triangles.push_back(
        {0, static_cast<std::uint32_t>(i + 1), static_cast<std::uint32_t>((i + 1) % 24 + 1)});
  }
  const OpaqueGeometry geometry{
      {}, {square(8, -1, {0, 0, 0}), shaded_surface(points, triangles, {1, 1, 1})}};
  for (const bool parallel : {true, false}) {
    Camera camera = tests::down_z(1);
    camera.parallel = parallel;
    camera.fov_degrees = 5;
    const Frame frame(camera, 32, 32);
    const OpaqueLayers layers(geometry, {}, frame, 1);
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 32; ++x) {
        const auto fragments = layers.fragments(x, y);
        ASSERT_EQ(fragments.size(), 1U);
        ASSERT_EQ(fragments[0].coverage, 1);
        ASSERT_NEAR(fragments[0].depth, 10, 1e-12)
            << x << ' ' << y << ": a gap shows what is behind";
      }
    }
  }
}

// From inside a cube in perspective: triangles reach behind the eye, and lines through it.
TEST(OpaqueLayersTest, TheEyeMayBeAmongIt) {
  const Eigen::AlignedBox3d box(Eigen::Vector3d(-1, -1, -1), Eigen::Vector3d(1, 1, 1));
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 8; ++i)
    points.push_back(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)));
  const OpaqueGeometry geometry{
      {{{0, 0, -3}, {0, 0, 3}, {1, 1, 1}, 2}, {{0.1, 0, -3}, {0.1, 0.05, 3}, {1, 1, 1}, 2}},
      {shaded_surface(points,
                      {{0, 1, 3},
                       {0, 3, 2},
                       {4, 5, 7},
                       {4, 7, 6},
                       {0, 1, 5},
                       {0, 5, 4},
                       {2, 3, 7},
                       {2, 7, 6},
                       {0, 2, 6},
                       {0, 6, 4},
                       {1, 3, 7},
                       {1, 7, 5}},
                      {1, 1, 1})}};
  Camera camera;
  camera.eye = {0, 0, 0};
  camera.target = {0, 0, -1};
  camera.fov_degrees = 100;
  const Frame frame(camera, 40, 40);
  const OpaqueLayers layers(geometry, {}, frame, 1);
  const OpaqueLayers walls({{}, geometry.surfaces}, {}, frame, 1);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      ASSERT_EQ(walls.fragments(x, y).size(), 1U) << x << ' ' << y;
      const Eigen::Vector2d plane = frame.image_plane(x, y);
      const double expected = 1 / std::max({1.0, std::abs(plane.x()), std::abs(plane.y())});
      EXPECT_NEAR(walls.fragments(x, y)[0].depth, expected, 1e-12) << x << ' ' << y;
      for (const OpaqueFragment& fragment : layers.fragments(x, y)) {
        EXPECT_TRUE(fragment.depth > 0 && fragment.depth <= expected + 1e-12) << x << ' ' << y;
      }
    }
  }
}

TEST(OpaqueGeometryTest, CreasesStaySharpAndRoundingsSmooth) {
  const OpaqueSurface sharp = octahedron(1);
  for (std::size_t t = 0; t < sharp.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_GT(
          std::abs(sharp.normals[3 * t + i].normalized().dot(sharp.normals[3 * t].normalized())),
          1 - 1e-12);
    }
  }
  // A roof of 20 degrees: at its ridge the normals are the mean of both sides.
  const double slope = std::tan(10 * M_PI / 180);
  const OpaqueSurface roof = shaded_surface({{0, 0, 0}, {0, 1, 0}, {1, 0, -slope}, {-1, 0, -slope}},
                                            {{0, 2, 1}, {0, 1, 3}}, {1, 1, 1});
  EXPECT_NEAR(roof.normals[0].normalized().z(), 1, 1e-12);
  EXPECT_LT(roof.normals[1].normalized().z(), 1 - 1e-3);
}

TEST_F(OpaqueTest, ThicknessAndGridsRefuseIt) {
  Scene wanted = scene(Mode::thickness, true);
  wanted.opaque.lines = box_outline(kBox, {1, 1, 1}, 1);
  EXPECT_THROW((void)plan(wanted, {}), base::UsageError);
  wanted.mode = Mode::full;
  wanted.grid = mesh::rectilinear_grid(mesh_);
  for (const Projector projector : {Projector::slices, Projector::grid_reference}) {
    Request request;
    request.projector = projector;
    EXPECT_THROW((void)plan(wanted, request), base::UsageError) << to_string(projector);
    wanted.opaque = {};
    EXPECT_NO_THROW((void)plan(wanted, request)) << to_string(projector);
    wanted.opaque.lines = box_outline(kBox, {1, 1, 1}, 1);
  }
}

TEST_F(OpaqueTest, APartOfThePictureIsThatOfTheWhole) {
  Scene wanted = scene(Mode::full, false);
  wanted.opaque.lines = box_outline(kBox, {0.7, 0.6, 0.5}, 2.5);
  wanted.opaque.surfaces = {octahedron(0.6)};
  for (const Projector projector : kCellProjectors) {
    const Image whole = draw(wanted, projector);
    Scene part = wanted;
    part.region = Region{13, 20, 30, 17};
    const Image image = draw(part, projector);
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        for (int c = 0; c < 4; ++c) {
          ASSERT_NEAR(image.pixel(x, y)[c], whole.pixel(x + 13, y + 20)[c], 1e-5)
              << to_string(projector) << ' ' << x << ' ' << y;
        }
      }
    }
  }
}

// Views one after the other: nothing of one is left in the next.
TEST_F(OpaqueTest, OneProjectorDrawsManyViews) {
  for (const Projector projector : {Projector::cpu, Projector::gl}) {
    Scene seen = scene(Mode::full, false);
    seen.opaque.surfaces = {octahedron(0.6)};
    seen.opaque.lines = box_outline(kBox, {1, 1, 1}, 1);
    Request request;
    request.projector = projector;
    const Plan how = plan(seen, request);
    Stats stats;
    SceneProjector projecting(seen, how, stats);
    for (int view = 0; view < 3; ++view) {
      seen.camera.eye += Eigen::Vector3d(0.3, -0.5, 0.2);
      seen.width -= 8;
      const Image image = projecting.draw(stats);
      EXPECT_EQ(image.rgba, render(seen, how, stats).rgba) << to_string(projector) << view;
    }
  }
}

}  // namespace
}  // namespace tetraglass::project
