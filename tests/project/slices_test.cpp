#include <cmath>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "project/reference/grid_reference.h"
#include "project/slices/slices_projector.h"
#include "tests/support/chord.h"
#include "tests/support/grids.h"

namespace tetraglass::project {
namespace {

using namespace tests;

// No slab is longer than its part of the ray in the grid, and none is missing.
TEST(Slices, AConstantFieldHasTheOpacityOfTheChord) {
  const double kappa = 0.7;
  for (const bool even : {true, false}) {
    const mesh::TetMesh mesh = grid_mesh([](const auto&) { return 0.5; }, even);
    Scene scene = grid_scene(mesh, Mode::full, constant_medium({0.2, 0.5, 1}, kappa));
    for (const View& view : grid_views()) {
      scene.camera = view.camera;
      const Frame frame = make_frame(scene);
      for (const Stack stack : kStacks) {
        for (const Classify classify : {Classify::integrated, Classify::post, Classify::pre}) {
          SlicesRequest request;
          request.stack = stack;
          request.classify = classify;
          const Image image = draw_slices(scene, request);
          for (int y = 0; y < scene.height; ++y) {
            for (int x = 0; x < scene.width; ++x) {
              const double alpha = -std::expm1(-kappa * chord(kGridBox, frame, x, y));
              ASSERT_NEAR(image.pixel(x, y)[3], alpha, kSliceRounding)
                  << view.name << ' ' << to_string(stack) << ' ' << to_string(classify) << ' ' << x
                  << ' ' << y;
              ASSERT_NEAR(image.pixel(x, y)[1], 0.5 * alpha, kSliceRounding);
            }
          }
        }
      }
    }
  }
}

TEST(Slices, ThicknessIsTheChord) {
  const mesh::TetMesh mesh = grid_mesh(bent);
  Scene scene = grid_scene(mesh, Mode::thickness, smooth_medium());
  for (const View& view : grid_views()) {
    scene.camera = view.camera;
    const Frame frame = make_frame(scene);
    for (const Stack stack : kStacks) {
      SlicesRequest request;
      request.stack = stack;
      const Image image = draw_slices(scene, request);
      for (int y = 0; y < scene.height; ++y) {
        for (int x = 0; x < scene.width; ++x) {
          ASSERT_NEAR(image.pixel(x, y)[0], chord(kGridBox, frame, x, y), 5 * kSliceRounding)
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
    const mesh::TetMesh mesh = grid_mesh(
        [](const Eigen::Vector3d& p) { return 0.3 * p.x() - 0.2 * p.y() + 0.5 * p.z(); }, even);
    for (const Mode mode : {Mode::full, Mode::emission, Mode::absorption, Mode::mip}) {
      Scene scene = grid_scene(mesh, mode, tf);
      for (const View& view : grid_views()) {
        scene.camera = view.camera;
        const Image reference = expected_grid(scene);
        for (const Stack stack : kStacks) {
          SlicesRequest request;
          request.stack = stack;
          request.slices = 5;
          EXPECT_LT(difference(draw_slices(scene, request), reference).largest, 5 * kSliceRounding)
              << view.name << ' ' << to_string(mode) << ' ' << to_string(stack) << ' ' << even;
        }
      }
    }
  }
}

/// The order at which the RMS error falls as slices are doubled twice.
double measured_order(const Scene& scene, SlicesRequest request, int slices) {
  const Image reference = expected_grid(scene);
  request.slices = slices;
  const double coarse = difference(draw_slices(scene, request), reference).rms;
  request.slices = 4 * slices;
  const double fine = difference(draw_slices(scene, request), reference).rms;
  return std::log2(coarse / fine) / 2;
}

// The rule of the middle and the integral of the linear field are both of second order for media
// without jumps; of media with jumps the middle misses a part of a slab, the integral does not.
TEST(Slices, ConvergeAtTheOrderOfTheory) {
  const mesh::TetMesh mesh = grid_mesh(bent);
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
  const mesh::TetMesh mesh = grid_mesh(bent);
  Scene scene = grid_scene(mesh, Mode::full, smooth_medium());
  for (const View& view : grid_views()) {
    scene.camera = view.camera;
    SlicesRequest request;
    request.slices = 200;
    const Image exact = draw_slices(scene, request);
    const Image table = draw_slices(scene, request, nullptr, Integrator::table2d);
    // Slabs at the grid's faces, and oblique ones, are as long as no entry of the table.
    EXPECT_LT(difference(exact, table).largest, 2e-4) << view.name;
  }
}

TEST(Slices, IsosurfacesAreThoseOfTheReference) {
  for (const bool even : {true, false}) {
    const mesh::TetMesh mesh = grid_mesh(bent, even);
    Scene scene = grid_scene(mesh, Mode::iso, smooth_medium(), 48);
    scene.isosurfaces = {{-0.31, {1, 0, 0}, 0.5}, {0.47, {0, 1, 0}, 0.7}};
    for (const Shading shading : {Shading::none, Shading::smooth}) {
      scene.shading = shading;
      for (const View& view : grid_views()) {
        scene.camera = view.camera;
        const Image reference = expected_grid(scene);
        for (const Stack stack : kStacks) {
          // Rays along the textures' planes meet few of them.
          if (stack == Stack::textures && view.camera.fov_degrees > 60) continue;
          SlicesRequest request;
          request.stack = stack;
          request.slices = 400;
          const Image image = draw_slices(scene, request);
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

Lights colored_lights() {
  Lights lights;
  lights.ambient = {0.6, 0.8, 1};
  lights.lights.emplace_back(DirectionalLight{{-1, -0.5, -0.4}, {0.9, 0.8, 0.7}});
  lights.lights.emplace_back(PointLight{{0.2, 0.3, 0.6}, {0.8, 0.2, 0.2}});
  return lights;
}

// One normal a slab: of the first order where normals turn, and better where slabs are short.
TEST(Slices, LitMediaComeNearToLightAtEveryPoint) {
  for (const bool even : {true, false}) {
    const mesh::TetMesh mesh = grid_mesh(bent, even);
    for (const GradientOf gradient : {GradientOf::central, GradientOf::sobel}) {
      for (const bool headlight : {true, false}) {
        Scene scene = grid_scene(mesh, Mode::full, smooth_medium());
        scene.shading = Shading::single;
        scene.gradient = gradient;
        if (!headlight) scene.lights = colored_lights();
        const Image reference = expected_grid(scene);
        Scene unlit = scene;
        unlit.shading = Shading::none;
        unlit.lights.reset();
        EXPECT_GT(difference(expected_grid(unlit), reference).rms, 0.02);
        for (const Stack stack : {Stack::planes, Stack::shells}) {
          SlicesRequest request;
          request.stack = stack;
          request.slices = 100;
          const double coarse = difference(draw_slices(scene, request), reference).rms;
          request.slices = 400;
          const double fine = difference(draw_slices(scene, request), reference).rms;
          EXPECT_LT(fine, 5e-4) << to_string(stack) << even << headlight;
          EXPECT_LT(fine, coarse / 3) << to_string(stack) << even << headlight;
        }
      }
    }
  }
}

// A gradient of half the modulation halves the extinction; one above it leaves it.
TEST(Slices, ModulationScalesTheExtinction) {
  const Eigen::Vector3d slope(0.3, -0.2, 0.5);
  const preint::TransferFunction tf({{-1, {1, 0, 0}, 0.5}, {0, {0, 1, 0}, 2}, {1, {1, 1, 1}, 1}});
  std::vector<preint::ControlPoint> points = tf.points();
  for (preint::ControlPoint& point : points) point.extinction *= 0.5;
  for (const bool even : {true, false}) {
    const mesh::TetMesh mesh =
        grid_mesh([&](const Eigen::Vector3d& p) { return slope.dot(p); }, even);
    for (const Mode mode : {Mode::full, Mode::emission, Mode::absorption}) {
      const Scene half = grid_scene(mesh, mode, preint::TransferFunction(points));
      Scene scene = grid_scene(mesh, mode, tf);
      const Image plain = expected_grid(scene);
      scene.modulation = 0.9 * slope.norm();
      EXPECT_LT(difference(expected_grid(scene), plain).largest, 1e-7);
      scene.modulation = 2 * slope.norm();
      const Image expected = expected_grid(half);
      EXPECT_LT(difference(expected_grid(scene), expected).largest, 1e-7) << to_string(mode);
      // Each is a shader of its own, and long to compile.
      for (const Stack stack : kStacks) {
        if (stack != Stack::planes && !(even && mode == Mode::full)) continue;
        SlicesRequest request;
        request.stack = stack;
        request.slices = 40;
        EXPECT_LT(difference(draw_slices(scene, request), expected).largest, 2e-5)
            << to_string(mode) << ' ' << to_string(stack) << ' ' << even;
      }
    }
  }
}

TEST(Slices, ModulatedBricksHaveNoSeams) {
  const mesh::TetMesh mesh = grid_mesh(bent);
  Scene scene = grid_scene(mesh, Mode::emission, smooth_medium());
  scene.modulation = 1.5;
  SlicesRequest request;
  request.slices = 40;
  const Image whole = draw_slices(scene, request);
  request.brick_bytes = 1000;
  EXPECT_LT(difference(draw_slices(scene, request), whole).largest, 5 * kSliceRounding);
}

// A brick costs its lookups, not a shader: as many sizes of bricks as there are have one texture.
TEST(Slices, LitModulatedBricksOfAnySizeHaveNoSeams) {
  const mesh::TetMesh mesh = grid_mesh(bent, false);
  Scene scene = grid_scene(mesh, Mode::full, smooth_medium());
  scene.modulation = 1.5;
  scene.gradient = GradientOf::sobel;
  scene.shading = Shading::weighted;
  SlicesRequest request;
  request.slices = 40;
  const Image whole = draw_slices(scene, request);
  for (const std::size_t bytes : {1000U, 2500U}) {
    request.brick_bytes = bytes;
    EXPECT_LT(difference(draw_slices(scene, request), whole).largest, 5 * kSliceRounding) << bytes;
  }
}

// One density a slab: better where slabs are short.
TEST(Slices, ModulatedMediaComeNearToTheModulationOfEveryPoint) {
  const mesh::TetMesh mesh = grid_mesh(bent);
  Scene scene = grid_scene(mesh, Mode::full, smooth_medium());
  const Image plain = expected_grid(scene);
  scene.modulation = 1.5;
  const Image reference = expected_grid(scene);
  EXPECT_GT(difference(plain, reference).rms, 0.02);
  SlicesRequest request;
  request.slices = 50;
  const double coarse = difference(draw_slices(scene, request), reference).rms;
  request.slices = 200;
  const double fine = difference(draw_slices(scene, request), reference).rms;
  EXPECT_LT(fine, 1e-3);
  EXPECT_LT(fine, coarse / 3);
}

TEST(Slices, SurfacesHaveLightsAndMaterials) {
  const mesh::TetMesh mesh = grid_mesh(bent);
  const preint::Material dull{0.2, 0.8, 0, 8};
  const preint::Material shiny{0.1, 0.5, 0.4, 30};
  Scene scene = grid_scene(
      mesh, Mode::iso,
      preint::TransferFunction({{-2, {1, 0, 0}, 1, dull}, {2, {0, 1, 0}, 1, shiny}}), 48);
  scene.isosurfaces = {{-0.31, {1, 0, 0}, 0.5}, {0.47, {0, 1, 0}, 0.7}};
  scene.shading = Shading::smooth;
  scene.lights = colored_lights();
  for (const GradientOf gradient : {GradientOf::central, GradientOf::sobel}) {
    scene.gradient = gradient;
    SlicesRequest request;
    request.slices = 400;
    const Error error = difference(draw_slices(scene, request), expected_grid(scene));
    EXPECT_LT(error.rms, 2e-3);
  }
}

// Of a linear field every difference is the same.
TEST(Slices, SobelSmoothsAndDoesNotBend) {
  const mesh::TetMesh linear = grid_mesh(
      [](const Eigen::Vector3d& p) { return 0.3 * p.x() - 0.2 * p.y() + 0.5 * p.z(); }, false);
  Scene scene = grid_scene(linear, Mode::full, smooth_medium());
  for (const GradientOf gradient : {GradientOf::central, GradientOf::sobel}) {
    scene.gradient = gradient;
    const Eigen::Vector3d at = grid_gradient(scene, {2.3, 1.7, 4.1});
    EXPECT_LT((at - Eigen::Vector3d(0.3, -0.2, 0.5)).norm(), 1e-12);
  }
  // Of a single peak: central differences see it at the point beside, Sobel's weights half of it
  // from a point beside that.
  mesh::TetMesh peak = grid_mesh([](const auto&) { return 0.0; });
  const auto point = [](std::size_t i, std::size_t j, std::size_t k) {
    return (k * 6 + j) * 8 + i;
  };
  peak.fields[0].values[point(3, 2, 5)] = 1;
  Scene peaked = grid_scene(peak, Mode::full, smooth_medium());
  const double step = 2.0 / 7;
  peaked.gradient = GradientOf::central;
  EXPECT_NEAR(grid_gradient(peaked, {2, 2, 5}).x(), 1 / (2 * step), 1e-12);
  EXPECT_NEAR(grid_gradient(peaked, {2, 3, 5}).x(), 0, 1e-12);
  peaked.gradient = GradientOf::sobel;
  EXPECT_NEAR(grid_gradient(peaked, {2, 2, 5}).x(), 0.25 / (2 * step), 1e-12);
  EXPECT_NEAR(grid_gradient(peaked, {2, 3, 5}).x(), 0.125 / (2 * step), 1e-12);
  EXPECT_NEAR(grid_gradient(peaked, {2, 3, 6}).x(), 0.0625 / (2 * step), 1e-12);
}

// kappa = s: the optical depth is off by no more than half a step of the texels times the ray.
TEST(Slices, TexelsRoundValuesToTheirBits) {
  const mesh::TetMesh mesh =
      grid_mesh([](const Eigen::Vector3d& p) { return (p.x() + 1) / 2 * (p.z() + 2) / 4; });
  Scene scene = grid_scene(mesh, Mode::absorption,
                           preint::TransferFunction({{0, {1, 1, 1}, 0}, {1, {1, 1, 1}, 1}}));
  SlicesRequest request;
  request.slices = 600;
  const Image exact = draw_slices(scene, request);
  const auto largest_depth_error = [&](TexelBits texels) {
    request.texels = texels;
    const Image image = draw_slices(scene, request);
    double largest = 0;
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) {
      largest = std::max(largest, std::abs(std::log1p(-double(image.rgba[i])) -
                                           std::log1p(-double(exact.rgba[i]))));
    }
    return largest;
  };
  const double diagonal = kGridBox.diagonal().norm();
  const double bits8 = largest_depth_error(TexelBits::bits8);
  const double bits12 = largest_depth_error(TexelBits::bits12);
  // Renderers may filter 8-bit texels in 8 bits: half a step more.
  EXPECT_LT(bits8, diagonal / 255);
  EXPECT_GT(bits8, 1e-5);
  EXPECT_LT(bits12, diagonal / 2 / 4095 + kSliceRounding);
  EXPECT_LT(bits12, bits8 / 4);
  EXPECT_LT(largest_depth_error(TexelBits::bits16), diagonal / 2 / 65535 + kSliceRounding);
}

// wilson1994: what a slab adds is rounded to nothing where it is less than half a step.
TEST(Slices, ThinSlabsVanishIn8BitsOfColor) {
  const mesh::TetMesh mesh = grid_mesh([](const auto&) { return 0.5; });
  Scene scene = grid_scene(mesh, Mode::full, constant_medium({1, 1, 1}, 0.2));
  scene.camera = down_z(2);
  SlicesRequest request;
  request.classify = Classify::pre;
  request.texels = TexelBits::bits8;
  request.distance = 0.0095;  // alpha = 0.0019, less than 1 / 510
  EXPECT_EQ(draw_slices(scene, request).pixel(16, 16)[3], 0);
  request.distance = 0.0101;  // more
  EXPECT_GT(draw_slices(scene, request).pixel(16, 16)[3], 0.7);
  request.texels = TexelBits::bits12;
  request.distance = 0.0095;
  EXPECT_NEAR(draw_slices(scene, request).pixel(16, 16)[3], -std::expm1(-0.8), 0.05);
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
    const Image image = draw_slices(scene, request);
    // Half of each ray at z = 0, half at z = 1.
    EXPECT_NEAR(image.pixel(1, 3)[3], -std::expm1(-1.0), kSliceRounding) << to_string(stack);
    EXPECT_NEAR(image.pixel(6, 3)[3], -std::expm1(-2.0), kSliceRounding) << to_string(stack);
  }
}

TEST(Slices, EmptyBlocksArePassedOverAndNothingElse) {
  const mesh::TetMesh mesh =
      tests::box(kGridBox.min(), kGridBox.max(), 40, 25, 66,
                 [](const auto& p) { return 1.5 - (p - Eigen::Vector3d(0.4, 0.3, -0.8)).norm(); });
  for (const Mode mode : {Mode::full, Mode::iso}) {
    Scene scene = grid_scene(
        mesh, mode,
        preint::TransferFunction({{-9, {1, 0, 0}, 0}, {0.9, {1, 0, 0}, 0}, {1.2, {1, 1, 0}, 9}}));
    scene.isosurfaces = {{0.95, {1, 0, 0}, 0.5}};
    for (const View& view : grid_views()) {
      scene.camera = view.camera;
      for (const Stack stack : kStacks) {
        SlicesRequest request;
        request.stack = stack;
        request.slices = 100;
        request.skip_empty = false;
        Stats whole;
        const Image all = draw_slices(scene, request, &whole);
        request.skip_empty = true;
        Stats skipped;
        EXPECT_EQ(difference(draw_slices(scene, request, &skipped), all).largest, 0)
            << view.name << ' ' << to_string(stack);
        // Of surfaces only what is met counts as a fragment; wide views need more around a block.
        if (stack == Stack::textures || mode == Mode::iso || view.camera.fov_degrees > 60) continue;
        EXPECT_LT(skipped.fragments, 0.7 * static_cast<double>(whole.fragments)) << view.name;
      }
    }
  }
}

TEST(Slices, ClipPlanesRegionsAndTilesCutTheSamePicture) {
  const mesh::TetMesh mesh = grid_mesh(bent);
  Scene scene = grid_scene(mesh, Mode::full, smooth_medium());
  scene.clip = {{{1, 0.3, 0.2}, 0.4}, {{0, 0, -1}, 1}};
  SlicesRequest request;
  request.slices = 400;
  for (const View& view : grid_views()) {
    scene.camera = view.camera;
    scene.region.reset();
    const Image whole = draw_slices(scene, request);
    EXPECT_LT(difference(whole, expected_grid(scene)).largest, 2e-3) << view.name;
    scene.region = Region{5, 9, 20, 12};
    const Image part = draw_slices(scene, request);
    for (int y = 0; y < 12; ++y) {
      for (int x = 0; x < 20; ++x) {
        for (int c = 0; c < 4; ++c) {
          ASSERT_NEAR(part.pixel(x, y)[c], whole.pixel(x + 5, y + 9)[c], kSliceRounding)
              << view.name;
        }
      }
    }
  }
}

TEST(Slices, PlanRefusesWhatSlicesLack) {
  const mesh::TetMesh mesh = grid_mesh(bent);
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
  EXPECT_NEAR(plan(scene, request).slices.distance, kGridBox.diagonal().norm() / 10, 1e-12);
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
  request.slices.compress = true;
  scene.mode = Mode::full;
  refused(scene, request);  // 3D textures
  request.slices.stack = Stack::textures;
  EXPECT_EQ(plan(scene, request).slices.texels, TexelBits::bits8);
  request.slices.texels = TexelBits::floats;
  refused(scene, request);
  request.slices = {};
  request.slices.stack = Stack::textures;
  request.slices.brick_bytes = 1000;
  refused(scene, request);
  scene.mode = Mode::mip;
  request = slices;
  request.integrator = Integrator::table2d;
  refused(scene, request);
  request.integrator.reset();
  scene.mode = Mode::full;
  scene.shading = Shading::smooth;
  refused(scene, slices);  // lit once a slab, or at both of its sides
  scene.shading = Shading::single;
  EXPECT_TRUE(plan(scene, slices).gradients);
  request = slices;
  request.slices.classify = Classify::pre;
  refused(scene, request);
  scene.shading = Shading::none;
  scene.mode = Mode::mip;
  request = slices;
  scene.depth_cue = DepthCue{1, 2};
  refused(scene, request);
  scene.depth_cue.reset();
  request.sort = SortMethod::mpvo;
  refused(scene, request);
  scene.mode = Mode::iso;
  scene.isosurfaces = {{0.4, {1, 1, 1}, 1}};
  scene.shading = Shading::smooth;
  EXPECT_NO_THROW(static_cast<void>(plan(scene, slices)));
  preint::ControlPoint dull;
  preint::ControlPoint shiny;
  shiny.value = 1;
  shiny.material.shininess = 5;
  scene.transfer_function = preint::TransferFunction({dull, shiny});
  EXPECT_NO_THROW(static_cast<void>(plan(scene, slices))) << "surfaces have one each";
  scene.mode = Mode::full;
  scene.shading = Shading::single;
  refused(scene, slices);
  scene.shading = Shading::none;
  scene.grid.reset();
  refused(scene, slices);
  request = {};
  request.slices.slices = 10;
  refused(scene, request);
}

}  // namespace
}  // namespace tetraglass::project
