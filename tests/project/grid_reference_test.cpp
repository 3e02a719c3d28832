#include "project/reference/grid_reference.h"

#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "base/errors.h"
#include "preint/segment_integral.h"
#include "project/plan.h"
#include "project/reference/reference.h"
#include "tests/support/chord.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace tetraglass::project {
namespace {

using tests::chord;
using tests::constant_medium;
using tests::down_z;

const Eigen::AlignedBox3d kBox(Eigen::Vector3d(-1, -0.5, -2), Eigen::Vector3d(1, 0.75, 2));

// 1 - 2^-24 is the largest relative rounding of the float that the image holds.
constexpr double kFloat = 1e-7;

mesh::TetMesh box_mesh(const tests::FieldFunction& f, bool even = true) {
  mesh::TetMesh mesh = tests::box(kBox.min(), kBox.max(), 3, 4, 5, [](const auto&) { return 0.0; });
  for (Eigen::Vector3d& p : mesh.points) {
    // Keeps the ends at -2 and 2.
    if (!even) p.z() = p.z() * (0.5 + p.z() * p.z() / 8);
  }
  mesh.fields.clear();
  tests::add_point_field(mesh, "s", f);
  return mesh;
}

Scene grid_scene(const mesh::TetMesh& mesh, Mode mode, const preint::TransferFunction& tf,
                 int size = 24) {
  Scene scene = tests::make_scene(mesh, mode, tf, size);
  scene.grid = mesh::rectilinear_grid(mesh);
  return scene;
}

Image draw(const Scene& scene) {
  Stats stats;
  return render_grid_reference(scene, stats);
}

std::vector<Camera> cameras() {
  const Camera outside = frame_camera(kBox, {1, 0.8, 0.6}, Eigen::Vector3d::UnitZ(), 30, 1);
  Camera inside = outside;
  inside.eye = {0.1, 0.2, 0.3};
  inside.fov_degrees = 120;
  Camera parallel = outside;
  parallel.parallel = true;
  return {outside, inside, parallel, down_z(4.1)};
}

TEST(GridReference, ThicknessIsTheChordAndOpacityTheExponential) {
  const double kappa = 0.7;
  const mesh::TetMesh mesh = box_mesh([](const auto&) { return 0.5; }, false);
  Scene scene = grid_scene(mesh, Mode::thickness, constant_medium({0.2, 0.5, 1}, kappa));
  for (const Camera& camera : cameras()) {
    scene.camera = camera;
    const Frame frame(camera, scene.width, scene.height);
    scene.mode = Mode::thickness;
    const Image lengths = draw(scene);
    scene.mode = Mode::full;
    const Image full = draw(scene);
    for (int y = 0; y < scene.height; ++y) {
      for (int x = 0; x < scene.width; ++x) {
        const double expected = chord(kBox, frame, x, y);
        const double alpha = -std::expm1(-kappa * expected);
        ASSERT_NEAR(lengths.pixel(x, y)[0], expected, 5 * kFloat) << x << ' ' << y;
        ASSERT_NEAR(full.pixel(x, y)[3], alpha, kFloat) << x << ' ' << y;
        ASSERT_NEAR(full.pixel(x, y)[1], 0.5 * alpha, kFloat) << x << ' ' << y;
      }
    }
  }
}

// A linear field is the same in voxels and in tetrahedra: every mode is that of the cells'
// reference, rays that run in a face of the box (the last camera's) included.
TEST(GridReference, LinearFieldsAreThoseOfTheCells) {
  const preint::TransferFunction tf(
      {{-1, {1, 0, 0}, 0}, {0, {0, 1, 0}, 2}, {0, {0, 0, 1}, 0.1}, {1, {1, 1, 1}, 1}});
  std::vector<Camera> views = cameras();
  views.push_back(down_z(4));
  for (const bool even : {true, false}) {
    const mesh::TetMesh mesh = box_mesh(
        [](const Eigen::Vector3d& p) { return 0.3 * p.x() - 0.2 * p.y() + 0.5 * p.z(); }, even);
    for (const Mode mode : {Mode::full, Mode::emission, Mode::absorption, Mode::mip, Mode::iso}) {
      for (const Camera& camera : views) {
        Scene scene = grid_scene(mesh, mode, tf);
        scene.camera = camera;
        scene.isosurfaces = {{-0.31, {1, 0, 0}, 0.5}, {0.17, {0, 1, 0}, 0.5}};
        scene.shading = mode == Mode::iso ? Shading::smooth : Shading::none;
        const Image grid = draw(scene);
        Stats stats;
        const Image cells = render_reference(scene, stats);
        for (std::size_t i = 0; i < grid.rgba.size(); ++i) {
          ASSERT_NEAR(grid.rgba[i], cells.rgba[i], 1e-6) << to_string(mode) << " value " << i;
        }
      }
    }
  }
}

TEST(GridReference, LightsFallOnSurfacesAsOnThoseOfTheCells) {
  const mesh::TetMesh mesh =
      box_mesh([](const Eigen::Vector3d& p) { return 0.3 * p.x() - 0.2 * p.y() + 0.5 * p.z(); });
  Scene scene = grid_scene(mesh, Mode::iso, constant_medium({1, 1, 1}, 1));
  scene.isosurfaces = {{0.17, {0.2, 0.9, 0.5}, 1}};
  scene.shading = Shading::smooth;
  scene.lights = Lights{
      {0.5, 0.5, 0.5},
      {PointLight{{0.9, 0.6, 1.5}, {1, 0.8, 0.2}}, DirectionalLight{{-1, 0, -1}, {0, 0.5, 1}}}};
  const Image grid = draw(scene);
  Stats stats;
  const Image cells = render_reference(scene, stats);
  for (std::size_t i = 0; i < grid.rgba.size(); ++i) {
    ASSERT_NEAR(grid.rgba[i], cells.rgba[i], 1e-6) << "value " << i;
  }
}

// s = x y z on a ray along the diagonal of a cube is t^3: the light of a jump at 1/8 is that of the
// half behind it, that of a ramp has its closed form, and the largest value is at the end.
TEST(GridReference, TrilinearFieldIsACubicAlongRays) {
  const mesh::TetMesh mesh = tests::box({0, 0, 0}, {1, 1, 1}, 1, 1, 1,
                                        [](const auto& p) { return p.x() * p.y() * p.z(); });
  Scene scene = grid_scene(
      mesh, Mode::absorption,
      preint::TransferFunction(
          {{0, {0, 0, 0}, 0}, {0.125, {0, 0, 0}, 0}, {0.125, {1, 1, 1}, 2}, {1, {1, 1, 1}, 2}}),
      1);
  scene.camera.eye = {-2, -2, -2};
  scene.camera.target = {0, 0, 0};
  const double diagonal = std::sqrt(3.0);
  EXPECT_NEAR(draw(scene).pixel(0, 0)[3], -std::expm1(-diagonal), kFloat);
  scene.mode = Mode::full;
  EXPECT_NEAR(draw(scene).pixel(0, 0)[0], -std::expm1(-diagonal), kFloat);
  // kappa = 8 t^3: optical depth 2 sqrt(3); emission of the color t^3: 8 sqrt(3) / 7.
  scene.transfer_function = preint::TransferFunction({{0, {0, 1, 0.5}, 0}, {1, {1, 1, 0.5}, 8}});
  const Image full = draw(scene);
  EXPECT_NEAR(full.pixel(0, 0)[3], -std::expm1(-2 * diagonal), kFloat);
  EXPECT_NEAR(full.pixel(0, 0)[1], -std::expm1(-2 * diagonal), kFloat);
  scene.mode = Mode::emission;
  EXPECT_NEAR(draw(scene).pixel(0, 0)[0], 8 * diagonal / 7, 1e-6);
  EXPECT_NEAR(draw(scene).pixel(0, 0)[1], 2 * diagonal, 1e-6);
  scene.mode = Mode::mip;
  EXPECT_NEAR(draw(scene).pixel(0, 0)[0], 1, kFloat);
}

// Dense media and steep fields: the same ray by very many samples of the field.
TEST(GridReference, LightIsThatOfVeryManySamples) {
  const mesh::TetMesh mesh = box_mesh(
      [](const Eigen::Vector3d& p) { return std::sin(3 * p.x()) * std::cos(4 * p.y()) + p.z(); });
  const preint::TransferFunction tf({{-2, {1, 0, 0.5}, 0.1},
                                     {-0.2, {0, 1, 0.5}, 3},
                                     {0.3, {0.2, 0.4, 0.6}, 0.5},
                                     {0.4, {1, 1, 1}, 60},
                                     {0.5, {0, 0, 1}, 0.2}});
  Scene scene = grid_scene(mesh, Mode::full, tf, 5);
  const Image image = draw(scene);
  const Frame frame = make_frame(scene);
  for (const int x : {1, 2, 3}) {
    const Eigen::Vector2d plane = frame.image_plane(x, 2);
    const Eigen::Vector3d direction = frame.axes().transpose() * frame.ray_direction(plane);
    // From where the ray enters the box, to where it leaves it.
    const Eigen::Array3d to_low = (kBox.min() - frame.eye()).array() / direction.array();
    const Eigen::Array3d to_high = (kBox.max() - frame.eye()).array() / direction.array();
    const double entry = to_low.min(to_high).maxCoeff();
    const double exit = to_low.max(to_high).minCoeff();
    ASSERT_LT(entry, exit);
    constexpr int kSamples = 1 << 17;
    const double step = (exit - entry) / kSamples;
    const auto value = [&](int i) {
      const Eigen::Vector3d at = frame.eye() + (entry + i * step) * direction;
      return interpolate(
          *scene.grid, scene.field.values,
          scene.grid->index_at(scene.grid->axes.inverse() * (at - scene.grid->origin)));
    };
    preint::Color color = preint::Color::Zero();
    double transmittance = 1;
    double front = value(0);
    for (int i = 0; i < kSamples; ++i) {
      const double back = value(i + 1);
      const preint::Radiance light =
          preint::integrate_full(tf, {front, back, step * direction.norm()});
      color += transmittance * light.color;
      transmittance *= light.transmittance;
      front = back;
    }
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(image.pixel(x, 2)[c], color[c], 2 * kFloat) << x << ' ' << c;
    EXPECT_NEAR(image.pixel(x, 2)[3], 1 - transmittance, 2 * kFloat) << x;
  }
}

// Units do not matter, be they as large or small as numbers are.
TEST(GridReference, PicturesDoNotDependOnTheUnitsOfValues) {
  const auto wave = [](const Eigen::Vector3d& p) {
    return std::sin(9 * p.x()) * std::cos(8 * p.y()) * std::sin(3 * p.z());
  };
  const auto picture = [&](double unit, Mode mode) {
    const mesh::TetMesh mesh = box_mesh([&](const Eigen::Vector3d& p) { return unit * wave(p); });
    Scene scene =
        grid_scene(mesh, mode,
                   preint::TransferFunction(
                       {{-unit, {1, 0, 0}, 0}, {-0.1 * unit, {0, 1, 0}, 2}, {unit, {1, 1, 1}, 1}}));
    scene.isosurfaces = {{0.2 * unit, {1, 0.5, 0.2}, 0.5}};
    return draw(scene);
  };
  for (const Mode mode : {Mode::full, Mode::mip, Mode::iso}) {
    const Image expected = picture(1, mode);
    for (const double unit : {0x1p900, 0x1p-900}) {
      const Image image = picture(unit, mode);
      for (std::size_t i = 0; i < image.rgba.size(); ++i) {
        ASSERT_NEAR(image.rgba[i], expected.rgba[i], 1e-6) << unit << " value " << i;
      }
    }
  }
}

TEST(GridReference, WhatIsConstantCrossesNoSurface) {
  const mesh::TetMesh mesh = box_mesh([](const auto&) { return 0.3; });
  Scene scene = grid_scene(mesh, Mode::iso, constant_medium({1, 1, 1}, 1));
  scene.isosurfaces = {{0.3, {1, 1, 1}, 1}};
  const Image image = draw(scene);
  for (const float value : image.rgba) ASSERT_EQ(value, 0);
}

// Rays through points whose value is the isovalue: one crossing, however the voxels round.
TEST(GridReference, RaysThroughPointsOfTheSurfaceCrossItOnce) {
  const mesh::TetMesh mesh = tests::box({-1, -1, -1}, {1, 1, 1}, 6, 6, 6,
                                        [](const auto& p) { return 0.1 * p.x() + 0.7 * p.z(); });
  Scene scene = grid_scene(mesh, Mode::iso, constant_medium({1, 1, 1}, 1), 6);
  scene.camera = down_z(2, {1.0 / 6, 1.0 / 6});  // pixels look along the edges of voxels
  scene.isosurfaces = {{0, {1, 1, 1}, 0.5}};
  const Image image = draw(scene);
  int seen = 0;
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) {
    if (image.rgba[i] == 0) continue;  // in the outer faces
    ++seen;
    EXPECT_EQ(image.rgba[i], 0.5F);
  }
  EXPECT_GE(seen, 25);
}

TEST(GridReference, SinglePixelsAreThoseOfThePicture) {
  const mesh::TetMesh mesh = box_mesh([](const Eigen::Vector3d& p) { return p.norm(); });
  const Scene scene = grid_scene(mesh, Mode::full,
                                 preint::TransferFunction({{0, {1, 0, 0}, 0}, {2, {0, 0, 1}, 3}}));
  const Image image = draw(scene);
  const std::vector<Eigen::Vector2i> pixels = {{0, 0}, {10, 10}, {3, 17}};
  const std::vector<Eigen::Array4d> single = grid_reference_pixels(scene, pixels);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    for (int c = 0; c < 4; ++c) {
      EXPECT_EQ(image.pixel(pixels[i].x(), pixels[i].y())[c], static_cast<float>(single[i][c]));
    }
  }
}

TEST(GridReference, PlanRefusesWhatIsNoGridOfPointValues) {
  const mesh::TetMesh mesh = box_mesh([](const auto& p) { return p.x(); });
  Scene scene = grid_scene(mesh, Mode::full, constant_medium({1, 1, 1}, 1));
  Request request;
  request.projector = Projector::grid_reference;
  EXPECT_EQ(plan(scene, request).projector, Projector::grid_reference);
  scene.drawable.nan = 1;
  EXPECT_THROW(static_cast<void>(plan(scene, request)), base::UsageError);
  scene.drawable.nan = 0;
  scene.grid.reset();
  EXPECT_THROW(static_cast<void>(plan(scene, request)), base::UsageError);
  scene.grid = mesh::rectilinear_grid(mesh);
  request.sort = SortMethod::mpvo;
  EXPECT_THROW(static_cast<void>(plan(scene, request)), base::UsageError);
}

}  // namespace
}  // namespace tetraglass::project
