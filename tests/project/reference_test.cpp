#include "project/reference/reference.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/chord.h"
#include "tests/support/covered_once.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace tetraglass::project {
namespace {

using preint::Color;
using tests::box;
using tests::chord;
using tests::constant_medium;
using tests::down_z;
using tests::make_scene;

const Eigen::AlignedBox3d kBox(Eigen::Vector3d(-1, -0.5, -2), Eigen::Vector3d(1, 0.75, 2));

mesh::TetMesh box_mesh(const tests::FieldFunction& f, int n = 3) {
  return box(kBox.min(), kBox.max(), n, n, n, f);
}

Image draw(const Scene& scene) {
  Stats stats;
  return render_reference(scene, stats);
}

/// Cameras from which the box looks different: outside, inside, parallel.
std::vector<Camera> cameras() {
  const Camera outside = frame_camera(kBox, {1, 0.8, 0.6}, Eigen::Vector3d::UnitZ(), 30, 1);
  Camera inside = outside;
  inside.eye = {0.1, 0.2, 0.3};
  inside.fov_degrees = 120;
  Camera parallel = outside;
  parallel.parallel = true;
  return {outside, inside, parallel};
}

// 1 - 2^-24 is the largest relative rounding of the float that the image holds.
constexpr double kFloat = 1e-7;

TEST(Reference, ThicknessIsTheChord) {
  const mesh::TetMesh mesh = box_mesh([](const auto&) { return 0.0; });
  Scene scene = make_scene(mesh, Mode::thickness, constant_medium({1, 1, 1}, 1));
  for (const Camera& camera : cameras()) {
    scene.camera = camera;
    const Frame frame(camera, scene.width, scene.height);
    const Image image = draw(scene);
    for (int y = 0; y < scene.height; ++y) {
      for (int x = 0; x < scene.width; ++x) {
        const double expected = chord(kBox, frame, x, y);
        ASSERT_NEAR(image.pixel(x, y)[0], expected, kFloat * 5 + 1e-12) << x << ' ' << y;
        ASSERT_EQ(image.pixel(x, y)[3], expected > 1e-12 ? 1.0F : image.pixel(x, y)[3]);
      }
    }
  }
}

TEST(Reference, RaysThroughEdgesMeetEachCellOnce) {
  tests::expect_edges_covered_once([](const Scene& scene) { return draw(scene); });
}

TEST(Reference, ConstantMediumFollowsTheExponential) {
  const mesh::TetMesh mesh = box_mesh([](const auto&) { return 0.5; });
  const double kappa = 0.7;
  Scene scene = make_scene(mesh, Mode::full, constant_medium({0.2, 0.5, 1}, kappa));
  for (const Camera& camera : cameras()) {
    scene.camera = camera;
    const Frame frame(camera, scene.width, scene.height);
    const Image image = draw(scene);
    for (int y = 0; y < scene.height; y += 3) {
      for (int x = 0; x < scene.width; x += 3) {
        const double alpha = 1 - std::exp(-kappa * chord(kBox, frame, x, y));
        EXPECT_NEAR(image.pixel(x, y)[3], alpha, kFloat);
        EXPECT_NEAR(image.pixel(x, y)[1], 0.5 * alpha, kFloat);
      }
    }
  }
}

// s = z on [-2, 2], extinction a s + b: optical depth of a ray along z is 4 b, emission of channel
// c is the integral.
TEST(Reference, LinearExtinctionHasItsClosedForm) {
  const mesh::TetMesh mesh = box_mesh([](const Eigen::Vector3d& p) { return p.z(); });
  const preint::TransferFunction tf({{-2, {1, 0, 0.5}, 0.1}, {2, {0, 1, 0.5}, 0.9}});
  Scene scene = make_scene(mesh, Mode::full, tf, 16);
  scene.camera = down_z(1);
  const Image full = draw(scene);
  scene.mode = Mode::absorption;
  const Image absorption = draw(scene);
  scene.mode = Mode::emission;
  const Image emission = draw(scene);
  const double alpha = 1 - std::exp(-0.5 * 4);
  for (int i = 0; i < 16; ++i) {
    EXPECT_NEAR(full.pixel(i, i)[3], alpha, kFloat);
    EXPECT_NEAR(absorption.pixel(i, i)[3], alpha, kFloat);
    EXPECT_NEAR(full.pixel(i, i)[2], 0.5 * alpha, kFloat);
    EXPECT_EQ(absorption.pixel(i, i)[0], 0);
    // int over t in [0,1] of 4 (0.1 + 0.8 t) (1 - t) and of 4 (0.1 + 0.8 t) t, t rising with z.
    EXPECT_NEAR(emission.pixel(i, i)[0], 4 * (0.1 / 2 + 0.8 / 6), kFloat);
    EXPECT_NEAR(emission.pixel(i, i)[1], 4 * (0.1 / 2 + 0.8 / 3), kFloat);
    EXPECT_EQ(emission.pixel(i, i)[3], 0);
  }
}

// Two slabs with different media: the nearer one comes first.
TEST(Reference, SlabsAreComposedInOrderFromBothSides) {
  mesh::TetMesh mesh = box({0, 0, 0}, {1, 1, 2}, 1, 1, 2, [](const auto&) { return 0.0; });
  mesh::Field slab{"slab", mesh::Location::cell, 1, {}};
  for (const mesh::Cell& cell : mesh.cells) {
    double z = 0;
    for (const std::uint32_t i : cell) z += mesh.points[i].z() / 4;
    slab.values.push_back(z < 1 ? 0 : 1);
  }
  mesh.fields = {slab};
  const double low = 0.8;
  const double high = 2.5;
  const preint::TransferFunction tf({{0, {1, 0, 0}, low}, {1, {0, 1, 0}, high}});
  Scene scene = make_scene(mesh, Mode::full, tf, 8);
  scene.camera = down_z(0.5);
  scene.camera.eye = {0.5, 0.5, 5};
  scene.camera.target = {0.5, 0.5, 0};
  const Image from_above = draw(scene);
  scene.camera.eye = {0.5, 0.5, -5};
  const Image from_below = draw(scene);
  const double a = 1 - std::exp(-low);
  const double b = 1 - std::exp(-high);
  EXPECT_NEAR(from_above.pixel(3, 4)[1], b, kFloat);
  EXPECT_NEAR(from_above.pixel(3, 4)[0], (1 - b) * a, kFloat);
  EXPECT_NEAR(from_below.pixel(3, 4)[0], a, kFloat);
  EXPECT_NEAR(from_below.pixel(3, 4)[1], (1 - a) * b, kFloat);
}

TEST(Reference, MaximumIsThatOfTheRay) {
  const mesh::TetMesh mesh = box_mesh([](const Eigen::Vector3d& p) { return p.z(); });
  const preint::TransferFunction tf(
      {{-2, {0, 1, 0}, 1}, {0, {0, 0.25, 0}, 1}, {2, {1, 0.5, 0}, 1}});
  Scene scene = make_scene(mesh, Mode::mip, tf, 9);
  scene.camera = down_z(4);
  Image image = draw(scene);
  EXPECT_NEAR(image.pixel(4, 4)[0], 1, kFloat);
  EXPECT_NEAR(image.pixel(4, 4)[1], 0.5, kFloat);
  EXPECT_EQ(image.pixel(4, 4)[3], 1);
  EXPECT_EQ(image.pixel(4, 0)[3], 0);  // beside the mesh
  scene.mip_of = MipOf::transfer;
  image = draw(scene);
  EXPECT_NEAR(image.pixel(4, 4)[0], 1, kFloat);
  EXPECT_NEAR(image.pixel(4, 4)[1], 1, kFloat);
}

TEST(Reference, IsosurfacesCoverEveryRayOnceNearestFirst) {
  const mesh::TetMesh mesh = box_mesh([](const Eigen::Vector3d& p) { return p.z(); }, 4);
  Scene scene = make_scene(mesh, Mode::iso, constant_medium({1, 1, 1}, 1), 32);
  scene.camera = down_z(1);
  // 0 is also the value of a whole layer of vertices: the surface runs along faces.
  scene.isosurfaces = {{-1.5, {1, 0, 0}, 0.5}, {0, {0, 1, 0}, 0.5}};
  Image image = draw(scene);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      ASSERT_NEAR(image.pixel(x, y)[1], 0.5, kFloat);
      ASSERT_NEAR(image.pixel(x, y)[0], 0.25, kFloat);
      ASSERT_NEAR(image.pixel(x, y)[3], 0.75, kFloat);
    }
  }
  // A headlight straight onto the surface: ambient + diffuse + specular.
  scene.isosurfaces = {{0, {0, 0.5, 0}, 1}};
  for (const Shading shading : {Shading::flat, Shading::smooth}) {
    scene.shading = shading;
    image = draw(scene);
    EXPECT_NEAR(image.pixel(7, 9)[1], 0.5 * (0.1 + 0.7) + 0.2, 1e-6);
    EXPECT_NEAR(image.pixel(7, 9)[0], 0.2, 1e-6);
  }
}

TEST(Reference, FinerMeshGivesTheSamePicture) {
  const auto field = [](const Eigen::Vector3d& p) {
    return 0.3 * p.x() - 0.2 * p.y() + 0.5 * p.z();
  };
  const preint::TransferFunction tf(
      {{-1, {1, 0, 0}, 0}, {0, {0, 1, 0}, 2}, {0, {0, 0, 1}, 0.1}, {1, {1, 1, 1}, 1}});
  const mesh::TetMesh coarse = box_mesh(field, 1);
  const mesh::TetMesh fine = box_mesh(field, 5);
  for (const Mode mode :
       {Mode::full, Mode::emission, Mode::absorption, Mode::mip, Mode::thickness}) {
    for (const Camera& camera : cameras()) {
      Scene a = make_scene(coarse, mode, tf, 24);
      Scene b = make_scene(fine, mode, tf, 24);
      a.camera = b.camera = camera;
      const Image x = draw(a);
      const Image y = draw(b);
      for (std::size_t i = 0; i < x.rgba.size(); ++i) {
        // mip at a silhouette may see a sliver of another cell's rounding
        ASSERT_NEAR(x.rgba[i], y.rgba[i], 1e-6) << to_string(mode) << " value " << i;
      }
    }
  }
}

TEST(Reference, SinglePixelsAreThoseOfThePicture) {
  const mesh::TetMesh mesh = box_mesh([](const Eigen::Vector3d& p) { return p.norm(); });
  const Scene scene = make_scene(
      mesh, Mode::full, preint::TransferFunction({{0, {1, 0, 0}, 0}, {2, {0, 0, 1}, 3}}), 20);
  const Image image = draw(scene);
  const std::vector<Eigen::Vector2i> pixels = {{0, 0}, {10, 10}, {3, 17}, {19, 5}};
  const std::vector<Eigen::Array4d> single = reference_pixels(scene, pixels);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    for (int c = 0; c < 4; ++c) {
      EXPECT_EQ(image.pixel(pixels[i].x(), pixels[i].y())[c], static_cast<float>(single[i][c]));
    }
  }
}

}  // namespace
}  // namespace tetraglass::project
