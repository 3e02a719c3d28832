// Light of slabs by tables, against light at every point of the rays (grid-reference).
#include "project/slices/slab_tables.h"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/errors.h"
#include "tests/support/grids.h"

namespace tetraglass::project::slices {
namespace {

using namespace tests;

/// Two translucent shells in clear space, each a 30th of the field's range wide.
preint::TransferFunction shells(const preint::Material& inner = {},
                                const preint::Material& outer = {}) {
  return preint::TransferFunction({{-0.35, {0.9, 0.5, 0.15}, 0, inner},
                                   {-0.3, {0.9, 0.5, 0.15}, 20, inner},
                                   {-0.25, {0.9, 0.5, 0.15}, 0, inner},
                                   {0.35, {0.15, 0.6, 0.9}, 0, outer},
                                   {0.4, {0.15, 0.6, 0.9}, 20, outer},
                                   {0.45, {0.15, 0.6, 0.9}, 0, outer}});
}

Scene lit_scene(const mesh::TetMesh& mesh, const preint::TransferFunction& tf) {
  Scene scene = grid_scene(mesh, Mode::full, tf, 48);
  Lights lights;
  lights.ambient = {0.6, 0.8, 1};
  lights.lights.emplace_back(DirectionalLight{{-1, -0.5, -0.4}, {0.9, 0.8, 0.7}});
  lights.lights.emplace_back(PointLight{{0.2, 0.3, 0.6}, {0.8, 0.2, 0.2}});
  scene.lights = lights;
  scene.camera = down_z(3);
  return scene;
}

Image lit_reference(Scene scene) {
  scene.shading = Shading::single;
  return expected_grid(scene);
}

Image draw(const Scene& scene, int slices, int table_n = 0, Stack stack = Stack::planes) {
  Request request;
  request.projector = Projector::slices;
  request.slices.slices = slices;
  request.slices.stack = stack;
  request.table_n = table_n;
  if (table_n > 0) request.integrator = Integrator::table2d;
  Stats stats;
  return render_slices(scene, plan(scene, request), stats);
}

double rms(Scene scene, Shading shading, int slices, const Image& reference, int table_n = 0,
           Stack stack = Stack::planes) {
  scene.shading = shading;
  return difference(draw(scene, slices, table_n, stack), reference).rms;
}

/// Linear along z, so that slabs seen along it are integrated exactly but for their light; the
/// normals turn along z.
double twisted(const Eigen::Vector3d& p) {
  return 0.2 * p.x() + 0.4 * p.z() + 0.5 * p.x() * p.z() + 0.4 * p.y() * p.z();
}

// meissner2002: most of the light of a shell comes from one place of a slab, however long it is.
TEST(SlabTables, TheWeightFindsTheNormalsOfShells) {
  const mesh::TetMesh mesh = grid_mesh(twisted);
  Scene scene = lit_scene(mesh, shells());
  for (const Stack stack : {Stack::planes, Stack::textures}) {
    const Image reference = lit_reference(scene);
    for (const int slices : {5, 10, 20}) {
      const double single = rms(scene, Shading::single, slices, reference, 0, stack);
      const double weighted = rms(scene, Shading::weighted, slices, reference, 0, stack);
      fmt::print("{} {:>2} slices: RMS {:.1e} single, {:.1e} weighted\n", to_string(stack), slices,
                 single, weighted);
      EXPECT_LT(weighted, single / 6) << to_string(stack) << slices;
      EXPECT_LT(weighted, 1.5e-3) << to_string(stack) << slices;
    }
  }
}

// Of one shell the value of the largest extinction tells the place as well.
TEST(SlabTables, OneSurfaceIsLitAtItsValue) {
  const mesh::TetMesh mesh = grid_mesh(twisted);
  const preint::TransferFunction shell(
      {{-0.35, {0.9, 0.5, 0.15}, 0}, {-0.3, {0.9, 0.5, 0.15}, 20}, {-0.25, {0.9, 0.5, 0.15}, 0}});
  const Scene scene = lit_scene(mesh, shell);
  const Image reference = lit_reference(scene);
  const double single = rms(scene, Shading::single, 10, reference);
  const double surface = rms(scene, Shading::surface, 10, reference);
  fmt::print("RMS {:.1e} single, {:.1e} surface\n", single, surface);
  EXPECT_LT(surface, single / 2);
}

// lum2004: light at both sides of a slab instead of once. What is left is that of the table.
TEST(SlabTables, LightAtBothSidesOfASlabIsBetterThanOnce) {
  const mesh::TetMesh mesh = grid_mesh(twisted);
  Scene scene = lit_scene(mesh, shells());
  const Image reference = lit_reference(scene);
  for (const int slices : {10, 20}) {
    EXPECT_LT(rms(scene, Shading::interpolated, slices, reference),
              0.75 * rms(scene, Shading::single, slices, reference))
        << slices;
  }
  const double coarse = rms(scene, Shading::interpolated, 160, reference, 256);
  const double fine = rms(scene, Shading::interpolated, 160, reference, 1024);
  EXPECT_LT(fine, coarse / 8);
  EXPECT_LT(fine, 5e-4);
}

/// The largest change of the error from a pixel to one beside it: what the eye sees as the edge of
/// a band.
double largest_step(const Image& image, const Image& reference) {
  double largest = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x + 1 < image.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const auto error = [&](int at) {
          return double{image.pixel(at, y)[c]} - reference.pixel(at, y)[c];
        };
        largest = std::max(largest, std::abs(error(x + 1) - error(x)));
      }
    }
  }
  return largest;
}

// lum2004: the normal in the middle of a slab jumps where a shell passes from one slab to the next,
// and the picture has bands like wood; light from both sides, or by the weight, does not jump.
TEST(SlabTables, TablesHaveFewerBandsThanLightOnce) {
  const mesh::TetMesh mesh = grid_mesh(twisted);
  Scene scene = lit_scene(mesh, shells());
  const Image reference = lit_reference(scene);
  for (const int slices : {10, 20}) {
    const auto step = [&](Shading shading) {
      scene.shading = shading;
      return largest_step(draw(scene, slices), reference);
    };
    const double single = step(Shading::single);
    const double weighted = step(Shading::weighted);
    const double interpolated = step(Shading::interpolated);
    fmt::print("{:>2} slices: bands of {:.1e} single, {:.1e} weighted, {:.1e} interpolated\n",
               slices, single, weighted, interpolated);
    EXPECT_LT(weighted, single / 3) << slices;
    EXPECT_LT(interpolated, single / 2) << slices;
  }
}

// Shorter slabs have straighter normals, in every stack.
TEST(SlabTables, ErrorsFallWithTheNumberOfSlices) {
  const mesh::TetMesh mesh = grid_mesh(twisted);
  Scene scene = lit_scene(mesh, smooth_medium());
  const Image reference = lit_reference(scene);
  for (const Stack stack : {Stack::planes, Stack::textures}) {
    for (const Shading shading : {Shading::single, Shading::weighted, Shading::interpolated}) {
      const double coarse = rms(scene, shading, 10, reference, 0, stack);
      const double fine = rms(scene, shading, 40, reference, 0, stack);
      fmt::print("{} {:<13} RMS {:.1e} of 10 slices, {:.1e} of 40\n", to_string(stack),
                 to_string(shading), coarse, fine);
      EXPECT_LT(fine, coarse / 12) << to_string(stack) << to_string(shading);
      EXPECT_LT(fine, 1e-4) << to_string(stack) << to_string(shading);
    }
  }
}

// In perspective, with the eye inside, along uneven axes: of a field that bends, so that slabs are
// not integrated exactly either.
TEST(SlabTables, LightMediaFromAnyView) {
  for (const bool even : {true, false}) {
    const mesh::TetMesh mesh = grid_mesh(bent, even);
    Scene scene = lit_scene(mesh, smooth_medium());
    const View view = grid_views()[even ? 1 : 0];
    scene.camera = view.camera;
    const Image reference = lit_reference(scene);
    for (const Stack stack : {Stack::planes, Stack::shells}) {
      for (const Shading shading : {Shading::weighted, Shading::interpolated}) {
        const double coarse = rms(scene, shading, 80, reference, 0, stack);
        const double fine = rms(scene, shading, 320, reference, 0, stack);
        EXPECT_LT(fine, coarse / 2.5) << view.name << to_string(stack) << to_string(shading);
        EXPECT_LT(fine, 6e-4) << view.name << to_string(stack) << to_string(shading);
      }
    }
  }
}

// One normal, far-away lights: both sides and all between are lit alike.
TEST(SlabTables, AllWaysAgreeOnAConstantNormal) {
  const mesh::TetMesh mesh =
      grid_mesh([](const Eigen::Vector3d& p) { return 0.3 * p.x() - 0.2 * p.y() + 0.5 * p.z(); });
  Scene scene = lit_scene(mesh, smooth_medium());
  scene.lights->lights.pop_back();
  const Image reference = lit_reference(scene);
  for (const Shading shading :
       {Shading::single, Shading::weighted, Shading::surface, Shading::interpolated}) {
    EXPECT_LT(rms(scene, shading, 10, reference), 5e-5) << to_string(shading);
  }
}

// Means of coefficients times the mean color: right where one shell has one material.
TEST(SlabTables, AverageMaterials) {
  const mesh::TetMesh mesh = grid_mesh(twisted);
  Scene scene = lit_scene(mesh, shells({0.2, 0.8, 0, 20}, {0.1, 0.5, 0.6, 20}));
  const Image reference = lit_reference(scene);
  Scene plain = lit_scene(mesh, shells());
  EXPECT_GT(difference(lit_reference(plain), reference).rms, 0.02);
  for (const Shading shading : {Shading::single, Shading::weighted, Shading::interpolated}) {
    EXPECT_LT(rms(scene, shading, 160, reference, 1024), 5e-4) << to_string(shading);
  }
  scene.shading = Shading::single;
  SlicesRequest post;
  post.slices = 1600;
  post.classify = Classify::post;
  EXPECT_LT(difference(draw_slices(scene, post), reference).rms, 5e-4);
}

TEST(SlabTables, TakeNothingWhereNothingAsksForThem) {
  const mesh::TetMesh mesh = grid_mesh(bent);
  const auto context = gl::Context::create(ContextKind::osmesa);
  const auto bytes = [&](Shading shading, std::optional<Integrator> integrator, int n = 0) {
    Scene scene = lit_scene(mesh, shells());
    scene.shading = shading;
    if (shading == Shading::none) scene.lights.reset();
    Request request;
    request.projector = Projector::slices;
    request.integrator = integrator;
    request.table_n = n;
    const Plan chosen = plan(scene, request);
    const gl::Normalization normalization(scene);
    SlabTables tables(*context, scene, chosen, normalization);
    Stats stats;
    tables.make(0.1, stats);
    tables.make(0.1, stats);
    return tables.bytes();
  };
  constexpr std::size_t kTexel = 16;
  EXPECT_EQ(bytes(Shading::none, {}), 0U);
  EXPECT_EQ(bytes(Shading::single, {}), 0U);
  EXPECT_EQ(bytes(Shading::none, Integrator::table2d, 64), 64 * 64 * kTexel);
  EXPECT_EQ(bytes(Shading::weighted, {}), 256 * 256 * kTexel);
  EXPECT_EQ(bytes(Shading::weighted, Integrator::table2d, 64), 2 * 64 * 64 * kTexel);
  EXPECT_EQ(bytes(Shading::interpolated, {}, 64), 2 * 64 * 64 * kTexel);
}

TEST(SlabTables, PlanTellsWhatSlicesLack) {
  const mesh::TetMesh mesh = grid_mesh(bent);
  Scene scene = lit_scene(mesh, shells());
  const auto planned = [&](Shading shading, Classify classify,
                           std::optional<Integrator> integrator = {}) {
    scene.shading = shading;
    Request request;
    request.projector = Projector::slices;
    request.slices.classify = classify;
    request.integrator = integrator;
    return plan(scene, request).integrator;
  };
  EXPECT_EQ(planned(Shading::interpolated, Classify::integrated), Integrator::table2d);
  EXPECT_EQ(planned(Shading::weighted, Classify::integrated), Integrator::exact);
  EXPECT_THROW(planned(Shading::interpolated, Classify::integrated, Integrator::exact),
               base::UsageError);
  for (const Shading shading : {Shading::weighted, Shading::interpolated}) {
    EXPECT_THROW(planned(shading, Classify::post), base::UsageError);
    EXPECT_THROW(planned(shading, Classify::pre), base::UsageError);
  }
  EXPECT_NO_THROW(planned(Shading::surface, Classify::integrated));
  EXPECT_THROW(planned(Shading::smooth, Classify::integrated), base::UsageError);
  scene.transfer_function = shells({0.1, 0.7, 0.2, 8}, {0.1, 0.7, 0.2, 30});
  EXPECT_THROW(planned(Shading::single, Classify::integrated), base::UsageError);
}

}  // namespace
}  // namespace tetraglass::project::slices
