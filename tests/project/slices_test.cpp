#include <cmath>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "project/reference/grid_reference.h"
#include "project/slices/slices_projector.h"
#include "tests/support/chord.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace tetraglass::project {
namespace {

using tests::chord;
using tests::constant_medium;
using tests::down_z;

const Eigen::AlignedBox3d kBox(Eigen::Vector3d(-1, -0.5, -2), Eigen::Vector3d(1, 0.75, 2));

// Floats hold a place in the grid to 2^-24 of its size; a ray adds up some 100 slabs.
constexpr double kFloat = 2e-5;

double bent(const Eigen::Vector3d& p) {
  return std::sin(2 * p.x() + 0.3) * std::cos(3 * p.y()) + 0.5 * p.z() - 0.2 * p.z() * p.z();
}

mesh::TetMesh box_mesh(const tests::FieldFunction& f, bool even = true) {
  mesh::TetMesh mesh =
      tests::box(kBox.min(), kBox.max(), 7, 5, 11, [](const auto&) { return 0.0; });
  for (Eigen::Vector3d& p : mesh.points) {
    // Keeps the ends at -2 and 2.
    if (!even) p.z() = p.z() * (0.5 + p.z() * p.z() / 8);
  }
  mesh.fields.clear();
  tests::add_point_field(mesh, "s", f);
  return mesh;
}

Scene grid_scene(const mesh::TetMesh& mesh, Mode mode, const preint::TransferFunction& tf,
                 int size = 32) {
  Scene scene = tests::make_scene(mesh, mode, tf, size);
  scene.grid = mesh::rectilinear_grid(mesh);
  return scene;
}

Image draw(const Scene& scene, const SlicesRequest& slices = {}, Stats* stats = nullptr,
           Integrator integrator = Integrator::exact) {
  Request request;
  request.projector = Projector::slices;
  request.slices = slices;
  if (integrator != Integrator::exact) request.integrator = integrator;
  Stats own;
  return render_slices(scene, plan(scene, request), stats != nullptr ? *stats : own);
}

Image expected(const Scene& scene) {
  Stats stats;
  return render_grid_reference(scene, stats);
}

struct Error {
  double largest = 0;
  double rms = 0;
};

Error difference(const Image& a, const Image& b) {
  Error error;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) {
    const double d = std::abs(static_cast<double>(a.rgba[i]) - b.rgba[i]);
    error.largest = std::max(error.largest, d);
    error.rms += d * d / static_cast<double>(a.rgba.size());
  }
  error.rms = std::sqrt(error.rms);
  return error;
}

struct View {
  const char* name;
  Camera camera;
};

std::vector<View> views() {
  const Camera outside = frame_camera(kBox, {1, 0.8, 0.6}, Eigen::Vector3d::UnitZ(), 30, 1);
  Camera inside = outside;
  inside.eye = {0.1, 0.2, 0.3};
  inside.fov_degrees = 120;
  Camera parallel = outside;
  parallel.parallel = true;
  Camera far = outside;
  far.eye *= 1000;
  far.fov_degrees /= 1000;
  Camera close = outside;  // beside a face, which the eye's plane cuts
  close.eye = {1.05, 0, 0.5};
  close.target = {0, 0, -1};
  close.fov_degrees = 80;
  return {{"outside", outside}, {"eye inside", inside},       {"parallel", parallel},
          {"far away", far},    {"along an axis", down_z(5)}, {"close", close}};
}

const std::vector<Stack> kStacks = {Stack::planes, Stack::shells, Stack::textures};

preint::TransferFunction smooth_medium() {
  return preint::TransferFunction(
      {{-2, {1, 0.2, 0}, 0}, {-0.3, {0, 1, 0.5}, 1}, {0.6, {0.2, 0, 1}, 0.3}, {2, {1, 1, 1}, 3}});
}

// No slab is longer than its part of the ray in the grid, and none is missing.
TEST(Slices, AConstantFieldHasTheOpacityOfTheChord) {
  const double kappa = 0.7;
  for (const bool even : {true, false}) {
    const mesh::TetMesh mesh = box_mesh([](const auto&) { return 0.5; }, even);
    Scene scene = grid_scene(mesh, Mode::full, constant_medium({0.2, 0.5, 1}, kappa));
    for (const View& view : views()) {
      scene.camera = view.camera;
      const Frame frame = make_frame(scene);
      for (const Stack stack : kStacks) {
        for (const Classify classify : {Classify::integrated, Classify::post, Classify::pre}) {
          SlicesRequest request;
          request.stack = stack;
          request.classify = classify;
          const Image image = draw(scene, request);
          for (int y = 0; y < scene.height; ++y) {
            for (int x = 0; x < scene.width; ++x) {
              const double alpha = -std::expm1(-kappa * chord(kBox, frame, x, y));
              ASSERT_NEAR(image.pixel(x, y)[3], alpha, kFloat)
                  << view.name << ' ' << to_string(stack) << ' ' << to_string(classify) << ' ' << x
                  << ' ' << y;
              ASSERT_NEAR(image.pixel(x, y)[1], 0.5 * alpha, kFloat);
            }
          }
        }
      }
    }
  }
}

TEST(Slices, ThicknessIsTheChord) {
  const mesh::TetMesh mesh = box_mesh(bent);
  Scene scene = grid_scene(mesh, Mode::thickness, smooth_medium());
  for (const View& view : views()) {
    scene.camera = view.camera;
    const Frame frame = make_frame(scene);
    for (const Stack stack : kStacks) {
      SlicesRequest request;
      request.stack = stack;
      const Image image = draw(scene, request);
      for (int y = 0; y < scene.height; ++y) {
        for (int x = 0; x < scene.width; ++x) {
          ASSERT_NEAR(image.pixel(x, y)[0], chord(kBox, frame, x, y), 5 * kFloat)
              << view.name << ' ' << to_string(stack) << ' ' << x << ' ' << y;
        }
      }
    }
  }
}

// What is linear along rays is integrated exactly, however few slices there are.
TEST(Slices, LinearFieldsNeedNoMoreSlices) {
  const preint::TransferFunction tf(
      {{-1, {1, 0, 0}, 0}, {0, {0, 1, 0}, 2}, {0, {0, 0, 1}, 0.1}, {1, {1, 1, 1}, 1}});
  for (const bool even : {true, false}) {
    const mesh::TetMesh mesh = box_mesh(
        [](const Eigen::Vector3d& p) { return 0.3 * p.x() - 0.2 * p.y() + 0.5 * p.z(); }, even);
    for (const Mode mode : {Mode::full, Mode::emission, Mode::absorption, Mode::mip}) {
      Scene scene = grid_scene(mesh, mode, tf);
      for (const View& view : views()) {
        scene.camera = view.camera;
        const Image reference = expected(scene);
        for (const Stack stack : kStacks) {
          SlicesRequest request;
          request.stack = stack;
          request.slices = 5;
          EXPECT_LT(difference(draw(scene, request), reference).largest, 5 * kFloat)
              << view.name << ' ' << to_string(mode) << ' ' << to_string(stack) << ' ' << even;
        }
      }
    }
  }
}

/// The order at which the RMS error falls as slices are doubled twice.
double measured_order(const Scene& scene, SlicesRequest request, int slices) {
  const Image reference = expected(scene);
  request.slices = slices;
  const double coarse = difference(draw(scene, request), reference).rms;
  request.slices = 4 * slices;
  const double fine = difference(draw(scene, request), reference).rms;
  return std::log2(coarse / fine) / 2;
}

// The rule of the middle and the integral of the linear field are both of second order for media
// without jumps; of media with jumps the middle misses a part of a slab, the integral does not.
TEST(Slices, ConvergeAtTheOrderOfTheory) {
  const mesh::TetMesh mesh = box_mesh(bent);
  const preint::TransferFunction jumps({{0, {1, 0, 0}, 0},
                                        {0.2, {1, 0, 0}, 0},
                                        {0.2, {1, 0, 0}, 4},
                                        {0.4, {1, 1, 0}, 4},
                                        {0.4, {0, 0, 1}, 0.5},
                                        {1, {0, 0, 1}, 0.5}});
  for (const Stack stack : kStacks) {
    for (const bool parallel : {false, true}) {
      Scene scene = grid_scene(mesh, Mode::full, smooth_medium());
      scene.camera.parallel = parallel;
      SlicesRequest request;
      request.stack = stack;
      request.classify = Classify::post;
      EXPECT_GT(measured_order(scene, request, 32), 1.7) << to_string(stack);
      request.classify = Classify::integrated;
      EXPECT_GT(measured_order(scene, request, 32), 1.7) << to_string(stack);
      scene.transfer_function = jumps;
      EXPECT_GT(measured_order(scene, request, 32), 1.5) << to_string(stack);
      request.classify = Classify::post;
      const double order = measured_order(scene, request, 32);
      EXPECT_GT(order, 0.7) << to_string(stack);
      EXPECT_LT(order, 1.5) << to_string(stack);
    }
  }
}

TEST(Slices, ATableOfSlabsIsTheIntegral) {
  const mesh::TetMesh mesh = box_mesh(bent);
  Scene scene = grid_scene(mesh, Mode::full, smooth_medium());
  for (const View& view : views()) {
    scene.camera = view.camera;
    SlicesRequest request;
    request.slices = 200;
    const Image exact = draw(scene, request);
    const Image table = draw(scene, request, nullptr, Integrator::table2d);
    // Slabs at the grid's faces, and oblique ones, are as long as no entry of the table.
    EXPECT_LT(difference(exact, table).largest, 2e-4) << view.name;
  }
}

TEST(Slices, IsosurfacesAreThoseOfTheReference) {
  for (const bool even : {true, false}) {
    const mesh::TetMesh mesh = box_mesh(bent, even);
    Scene scene = grid_scene(mesh, Mode::iso, smooth_medium(), 48);
    scene.isosurfaces = {{-0.31, {1, 0, 0}, 0.5}, {0.47, {0, 1, 0}, 0.7}};
    for (const Shading shading : {Shading::none, Shading::smooth}) {
      scene.shading = shading;
      for (const View& view : views()) {
        scene.camera = view.camera;
        const Image reference = expected(scene);
        for (const Stack stack : kStacks) {
          // Rays along the textures' planes meet few of them.
          if (stack == Stack::textures && view.camera.fov_degrees > 60) continue;
          SlicesRequest request;
          request.stack = stack;
          request.slices = 400;
          const Image image = draw(scene, request);
          int wrong = 0;  // rays that touch a surface
          for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
            double largest = 0;
            for (std::size_t c = 0; c < 4; ++c) {
              largest =
                  std::max(largest, std::abs(double(image.rgba[i + c]) - reference.rgba[i + c]));
            }
            if (largest > 2e-3) ++wrong;
          }
          EXPECT_LE(wrong, 48 * 48 / 250) << view.name << ' ' << to_string(stack) << ' ' << even;
        }
      }
    }
  }
}

// kappa = s: the optical depth is off by no more than half a step of the texels times the ray.
TEST(Slices, TexelsRoundValuesToTheirBits) {
  const mesh::TetMesh mesh =
      box_mesh([](const Eigen::Vector3d& p) { return (p.x() + 1) / 2 * (p.z() + 2) / 4; });
  Scene scene = grid_scene(mesh, Mode::absorption,
                           preint::TransferFunction({{0, {1, 1, 1}, 0}, {1, {1, 1, 1}, 1}}));
  SlicesRequest request;
  request.slices = 600;
  const Image exact = draw(scene, request);
  const auto largest_depth_error = [&](TexelBits texels) {
    request.texels = texels;
    const Image image = draw(scene, request);
    double largest = 0;
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) {
      largest = std::max(largest, std::abs(std::log1p(-double(image.rgba[i])) -
                                           std::log1p(-double(exact.rgba[i]))));
    }
    return largest;
  };
  const double diagonal = kBox.diagonal().norm();
  const double bits8 = largest_depth_error(TexelBits::bits8);
  const double bits12 = largest_depth_error(TexelBits::bits12);
  // Renderers may filter 8-bit texels in 8 bits: half a step more.
  EXPECT_LT(bits8, diagonal / 255);
  EXPECT_GT(bits8, 1e-5);
  EXPECT_LT(bits12, diagonal / 2 / 4095 + kFloat);
  EXPECT_LT(bits12, bits8 / 4);
  EXPECT_LT(largest_depth_error(TexelBits::bits16), diagonal / 2 / 65535 + kFloat);
}

// wilson1994: what a slab adds is rounded to nothing where it is less than half a step.
TEST(Slices, ThinSlabsVanishIn8BitsOfColor) {
  const mesh::TetMesh mesh = box_mesh([](const auto&) { return 0.5; });
  Scene scene = grid_scene(mesh, Mode::full, constant_medium({1, 1, 1}, 0.2));
  scene.camera = down_z(2);
  SlicesRequest request;
  request.classify = Classify::pre;
  request.texels = TexelBits::bits8;
  request.distance = 0.0095;  // alpha = 0.0019, less than 1 / 510
  EXPECT_EQ(draw(scene, request).pixel(16, 16)[3], 0);
  request.distance = 0.0101;  // more
  EXPECT_GT(draw(scene, request).pixel(16, 16)[3], 0.7);
  request.texels = TexelBits::bits12;
  request.distance = 0.0095;
  EXPECT_NEAR(draw(scene, request).pixel(16, 16)[3], -std::expm1(-0.8), 0.05);
}

TEST(Slices, TheNearestPointIsAFilterToo) {
  const mesh::TetMesh mesh =
      tests::box({0, 0, 0}, {1, 1, 1}, 1, 1, 1, [](const auto& p) { return p.x() + 2 * p.z(); });
  Scene scene = grid_scene(mesh, Mode::absorption,
                           preint::TransferFunction({{0, {1, 1, 1}, 0}, {4, {1, 1, 1}, 4}}), 8);
  scene.camera = down_z(1, {0.5, 0.5});
  for (const Stack stack : kStacks) {
    SlicesRequest request;
    request.stack = stack;
    request.filter = Filter::nearest;
    request.classify = Classify::post;
    const Image image = draw(scene, request);
    // Half of each ray at z = 0, half at z = 1.
    EXPECT_NEAR(image.pixel(1, 3)[3], -std::expm1(-1.0), kFloat) << to_string(stack);
    EXPECT_NEAR(image.pixel(6, 3)[3], -std::expm1(-2.0), kFloat) << to_string(stack);
  }
}

TEST(Slices, EmptyBlocksArePassedOverAndNothingElse) {
  const mesh::TetMesh mesh = tests::box(kBox.min(), kBox.max(), 40, 25, 66, [](const auto& p) {
    return 1.5 - (p - Eigen::Vector3d(0.4, 0.3, -0.8)).norm();
  });
  for (const Mode mode : {Mode::full, Mode::iso}) {
    Scene scene = grid_scene(
        mesh, mode,
        preint::TransferFunction({{-9, {1, 0, 0}, 0}, {0.9, {1, 0, 0}, 0}, {1.2, {1, 1, 0}, 9}}));
    scene.isosurfaces = {{0.95, {1, 0, 0}, 0.5}};
    for (const View& view : views()) {
      scene.camera = view.camera;
      for (const Stack stack : kStacks) {
        SlicesRequest request;
        request.stack = stack;
        request.slices = 100;
        request.skip_empty = false;
        Stats whole;
        const Image all = draw(scene, request, &whole);
        request.skip_empty = true;
        Stats skipped;
        EXPECT_EQ(difference(draw(scene, request, &skipped), all).largest, 0)
            << view.name << ' ' << to_string(stack);
        // Of surfaces only what is met counts as a fragment; wide views need more around a block.
        if (stack == Stack::textures || mode == Mode::iso || view.camera.fov_degrees > 60) continue;
        EXPECT_LT(skipped.fragments, 0.7 * static_cast<double>(whole.fragments)) << view.name;
      }
    }
  }
}

TEST(Slices, ClipPlanesRegionsAndTilesCutTheSamePicture) {
  const mesh::TetMesh mesh = box_mesh(bent);
  Scene scene = grid_scene(mesh, Mode::full, smooth_medium());
  scene.clip = {{{1, 0.3, 0.2}, 0.4}, {{0, 0, -1}, 1}};
  SlicesRequest request;
  request.slices = 400;
  for (const View& view : views()) {
    scene.camera = view.camera;
    scene.region.reset();
    const Image whole = draw(scene, request);
    EXPECT_LT(difference(whole, expected(scene)).largest, 2e-3) << view.name;
    scene.region = Region{5, 9, 20, 12};
    const Image part = draw(scene, request);
    for (int y = 0; y < 12; ++y) {
      for (int x = 0; x < 20; ++x) {
        for (int c = 0; c < 4; ++c) {
          ASSERT_NEAR(part.pixel(x, y)[c], whole.pixel(x + 5, y + 9)[c], kFloat) << view.name;
        }
      }
    }
  }
}

TEST(Slices, PlanRefusesWhatSlicesLack) {
  const mesh::TetMesh mesh = box_mesh(bent);
  const auto refused = [](const Scene& scene, const Request& request) {
    EXPECT_THROW(static_cast<void>(plan(scene, request)), base::UsageError);
  };
  Scene scene = grid_scene(mesh, Mode::full, smooth_medium());
  Request slices;
  slices.projector = Projector::slices;
  const Plan chosen = plan(scene, slices);
  EXPECT_EQ(chosen.context, ContextKind::osmesa);
  EXPECT_GT(chosen.slices.distance, 0);
  Request request = slices;
  request.slices.slices = 0;
  refused(scene, request);
  request.slices.slices = 10;
  EXPECT_NEAR(plan(scene, request).slices.distance, kBox.diagonal().norm() / 10, 1e-12);
  request.slices.distance = 0.1;
  refused(scene, request);
  request = slices;
  request.slices.distance = 1e-9;
  refused(scene, request);
  request = slices;
  request.slices.classify = Classify::pre;
  scene.mode = Mode::mip;
  refused(scene, request);
  request.slices.classify = Classify::post;
  scene.mode = Mode::iso;
  refused(scene, request);
  request = slices;
  request.integrator = Integrator::table2d;
  refused(scene, request);
  request.integrator.reset();
  scene.depth_cue = DepthCue{1, 2};
  refused(scene, request);
  scene.depth_cue.reset();
  request.sort = SortMethod::mpvo;
  refused(scene, request);
  scene.grid.reset();
  refused(scene, slices);
  request = {};
  request.slices.slices = 10;
  refused(scene, request);
}

}  // namespace
}  // namespace tetraglass::project
