// Lit pictures of the projectors against the reference, which lights every point of a ray.
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/errors.h"
#include "project/compare.h"
#include "project/light/phong.h"
#include "project/render.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace tetraglass::project {
namespace {

using Eigen::Vector3d;
using preint::Color;
using preint::TransferFunction;

constexpr int kSize = 48;

Image draw(const Scene& scene, Projector projector) {
  Request request;
  request.projector = projector;
  Stats stats;
  return render(scene, plan(scene, request), stats);
}

double largest_error(const Scene& scene) {
  return compare(draw(scene, Projector::cpu), draw(scene, Projector::reference)).max;
}
double rms_error(const Scene& scene) {
  return compare(draw(scene, Projector::cpu), draw(scene, Projector::reference)).rms;
}

const Vector3d kSlope(0.5, -0.3, 0.8);

/// A cube of side 2 with a linear field from about -2 to 2: the normal is the same everywhere.
mesh::TetMesh linear_cube() {
  return tests::box(Vector3d::Constant(-1), Vector3d::Constant(1), 3, 3, 3,
                    [](const Vector3d& p) { return kSlope.dot(p); });
}

/// The distance from a point beside the cube: normals turn everywhere.
mesh::TetMesh round_cube(int n) {
  return tests::box(Vector3d::Constant(-1), Vector3d::Constant(1), n, n, n,
                    [](const Vector3d& p) { return (p - Vector3d(-1.3, -1.1, -0.9)).norm(); });
}

/// Two semi-transparent shells in a haze, of different materials.
TransferFunction shells(double low, double high) {
  const auto at = [&](double t) { return low + t * (high - low); };
  const preint::Material dull{0.2, 0.8, 0, 8};
  const preint::Material shiny{0.1, 0.5, 0.4, 30};
  return TransferFunction({{at(0.0), Color(0.2, 0.2, 0.6), 0.1, dull},
                           {at(0.30), Color(0.9, 0.3, 0.1), 0.1, dull},
                           {at(0.35), Color(0.9, 0.5, 0.1), 4, dull},
                           {at(0.40), Color(0.9, 0.3, 0.1), 0, dull},
                           {at(0.60), Color(0.1, 0.7, 0.3), 0, shiny},
                           {at(0.70), Color(0.1, 0.9, 0.3), 3, shiny},
                           {at(0.80), Color(0.1, 0.7, 0.3), 0.2, shiny},
                           {at(1.0), Color(0.5, 0.5, 0.5), 0.2, shiny}});
}

Lights far_lights() {
  Lights lights;
  lights.ambient = Color(0.8, 0.9, 1);
  lights.lights.emplace_back(DirectionalLight{Vector3d(-1, -0.5, -0.4), Color(0.9, 0.8, 0.7)});
  lights.lights.emplace_back(DirectionalLight{Vector3d(0.3, -1, 0.5), Color(0.1, 0.3, 0.6)});
  return lights;
}

Lights near_lights() {
  Lights lights = far_lights();
  lights.lights.emplace_back(PointLight{Vector3d(0.2, 0.3, 0.6), Color(0.8, 0.2, 0.2)});
  lights.lights.emplace_back(
      RectangleLight{{2, -1, 0}, {Vector3d(0, 1, 0), Vector3d(0, 0, 1)}, Color(0.3, 0.5, 0.3)});
  return lights;
}

std::vector<Camera> cameras(const mesh::TetMesh& mesh) {
  const Camera outside =
      frame_camera(mesh::bounds(mesh), Vector3d(1, 0.8, 0.6), Vector3d::UnitZ(), 30, 1);
  Camera parallel = outside;
  parallel.parallel = true;
  Camera inside = outside;
  inside.eye = Vector3d(0.31, 0.23, 0.12);
  inside.fov_degrees = 90;
  return {outside, parallel, inside};
}

int differing_pixels(const Image& a, const Image& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
    double worst = 0;
    for (std::size_t c = 0; c < 4; ++c)
      worst = std::max<double>(worst, std::abs(a.rgba[i + c] - b.rgba[i + c]));
    if (worst > 1e-3) ++count;
  }
  return count;
}

// meissner2002's special case: of one translucent isosurface in all of the mesh, the one normal
// that counts is that at its value. A second one makes it worse than the middle of the segment.
TEST(Lighting, TheNormalAtTheSurfaceIsRightForOneSurfaceOnly) {
  const mesh::TetMesh mesh = round_cube(5);
  const preint::Material shiny{0.1, 0.5, 0.4, 30};
  const Color color(0.9, 0.5, 0.1);
  const auto error = [&](bool two, Shading shading, Projector projector) {
    std::vector<preint::ControlPoint> points = {
        {1.55, color, 0, shiny}, {1.6, color, 15, shiny}, {1.65, color, 0, shiny}};
    if (two) {
      points.push_back({1.85, color, 0, shiny});
      points.push_back({1.9, color, 14.9, shiny});
      points.push_back({1.95, color, 0, shiny});
    }
    Scene scene = tests::make_scene(mesh, Mode::full, TransferFunction(points), kSize);
    scene.shading = shading;
    scene.lights = far_lights();
    return compare(draw(scene, projector), draw(scene, Projector::reference)).rms;
  };
  for (const Projector projector : {Projector::cpu, Projector::gl}) {
    const double single = error(false, Shading::single, projector);
    const double surface = error(false, Shading::surface, projector);
    fmt::print("{}: RMS {:.1e} single, {:.1e} surface; two surfaces {:.1e}, {:.1e}\n",
               to_string(projector), single, surface, error(true, Shading::single, projector),
               error(true, Shading::surface, projector));
    EXPECT_LT(surface, single / 3) << to_string(projector);
    EXPECT_GT(error(true, Shading::surface, projector), 5 * surface) << to_string(projector);
  }
}

// In floats only the arithmetic differs. Cells of the round cube are flat nowhere, so that no ray
// misses a surface in one picture and meets it in the other but at the cube's edges.
TEST(Lighting, IsosurfacesUnderAnyLights) {
  const mesh::TetMesh mesh = round_cube(5);
  for (const Camera& camera : cameras(mesh)) {
    for (const Shading shading : {Shading::flat, Shading::smooth}) {
      Scene scene = tests::make_scene(mesh, Mode::iso, shells(0, 3), kSize);
      scene.camera = camera;
      scene.shading = shading;
      scene.lights = near_lights();
      scene.isosurfaces = {{1.2, Color(0.9, 0.5, 0.1), 0.5}, {2.1, Color(0.1, 0.9, 0.3), 0.5}};
      const Image reference = draw(scene, Projector::reference);
      for (const Projector projector : {Projector::cpu, Projector::gl}) {
        EXPECT_LE(differing_pixels(draw(scene, projector), reference), 2)
            << to_string(projector) << ", " << to_string(shading);
      }
    }
  }
}

// OpenGL lights each segment once, as the cpu projector does with `single`.
TEST(Lighting, MediaLitOnceASegmentAreTheSameOnOpenGl) {
  const mesh::TetMesh mesh = round_cube(5);
  const preint::Material shiny{0.1, 0.5, 0.4, 30};
  for (const Camera& camera : cameras(mesh)) {
    Scene scene = tests::make_scene(mesh, Mode::full,
                                    TransferFunction({{0.0, Color(0.9, 0.2, 0), 0, shiny},
                                                      {1.5, Color(0.1, 0.9, 0.3), 2, shiny},
                                                      {3, Color(0.2, 0.1, 0.9), 0.5, shiny}}),
                                    kSize);
    scene.camera = camera;
    scene.shading = Shading::surface;
    EXPECT_LE(compare(draw(scene, Projector::gl), draw(scene, Projector::cpu)).max, 1e-4);
    scene.shading = Shading::single;
    for (const GradientOf gradient : {GradientOf::vertex, GradientOf::cell}) {
      scene.gradient = gradient;
      for (const bool headlight : {true, false}) {
        scene.lights.reset();
        if (!headlight) {
          scene.lights = far_lights();
          scene.lights->lights.emplace_back(PointLight{{0.2, 0.3, 0.6}, Color(0.8, 0.2, 0.2)});
        }
        const Image expected = draw(scene, Projector::cpu);
        EXPECT_LE(compare(draw(scene, Projector::gl), expected).max, 1e-4)
            << headlight << int(gradient);
        Request lists;
        lists.projector = Projector::gl;
        lists.sort = SortMethod::fragments;
        Stats stats;
        EXPECT_LE(compare(render(scene, plan(scene, lists), stats), expected).max, 1e-4);
        // The twelve vertices have one gradient a cell, and show no cell around the eye.
        const bool inside = mesh::bounds(mesh).contains(camera.eye);
        if (gradient == GradientOf::vertex || inside) continue;
        lists.sort.reset();
        lists.gl.layout = Layout::faces12;
        EXPECT_LE(compare(render(scene, plan(scene, lists), stats), expected).max, 1e-3);
      }
    }
  }
}

Image draw_by_tables(const Scene& scene, int n, int m, Layout layout = Layout::indexed) {
  Request request;
  request.projector = Projector::gl;
  request.integrator = Integrator::table3d;
  request.table_n = n;
  request.table_m = m;
  request.gl.layout = layout;
  Stats stats;
  return render(scene, plan(scene, request), stats);
}

// What the cpu projector integrates, OpenGL looks up (meissner2002, lum2004): the finer the tables,
// the smaller the difference.
TEST(Lighting, TablesOfLightComeToWhatTheCpuIntegrates) {
  const mesh::TetMesh mesh = round_cube(5);
  const preint::Material shiny{0.1, 0.5, 0.4, 30};
  for (const Camera& camera : cameras(mesh)) {
    Scene scene = tests::make_scene(mesh, Mode::full,
                                    TransferFunction({{0.0, Color(0.9, 0.2, 0), 0, shiny},
                                                      {1.5, Color(0.1, 0.9, 0.3), 2, shiny},
                                                      {3, Color(0.2, 0.1, 0.9), 0.5, shiny}}),
                                    kSize);
    scene.camera = camera;
    scene.lights = far_lights();
    scene.lights->lights.emplace_back(PointLight{{0.2, 0.3, 0.6}, Color(0.8, 0.2, 0.2)});
    for (const Shading shading : {Shading::weighted, Shading::interpolated}) {
      scene.shading = shading;
      const Image expected = draw(scene, Projector::cpu);
      const double coarse = compare(draw_by_tables(scene, 24, 12), expected).rms;
      const double fine = compare(draw_by_tables(scene, 192, 48), expected).rms;
      fmt::print("{}: RMS {:.1e} with 24 x 24 x 12, {:.1e} with 192 x 192 x 48\n",
                 to_string(shading), coarse, fine);
      EXPECT_LT(fine, coarse / 3) << to_string(shading);
      EXPECT_LE(compare(draw_by_tables(scene, 192, 48), expected).max, 1e-3) << to_string(shading);
    }
    // Without a table for colors there is one for the weight.
    scene.shading = Shading::weighted;
    EXPECT_LE(compare(draw(scene, Projector::gl), draw(scene, Projector::cpu)).max, 1e-3);
  }
}

// Means of a material times the light of one color are the light of all its parts.
TEST(Lighting, TablesAverageMaterials) {
  const mesh::TetMesh mesh = round_cube(5);
  Scene scene =
      tests::make_scene(mesh, Mode::full,
                        TransferFunction({{0.0, Color(0.9, 0.6, 0.2), 0.5, {0.4, 0.1, 0.1, 20}},
                                          {1.5, Color(0.9, 0.6, 0.2), 2, {0, 0.9, 0, 20}},
                                          {3, Color(0.9, 0.6, 0.2), 0.5, {0.1, 0.3, 0.6, 20}}}),
                        kSize);
  scene.lights = far_lights();
  for (const Shading shading : {Shading::single, Shading::weighted}) {
    scene.shading = shading;
    EXPECT_LE(compare(draw(scene, Projector::gl), draw(scene, Projector::cpu)).max, 1e-3)
        << to_string(shading);
  }
  scene.shading = Shading::interpolated;
  EXPECT_LE(compare(draw(scene, Projector::gl), draw(scene, Projector::cpu)).max, 1e-2);
}

// The layouts of twelve vertices have one normal a cell, which lights all of a segment.
TEST(Lighting, TablesOfLightServeAllLayouts) {
  const mesh::TetMesh mesh = round_cube(5);
  Scene scene = tests::make_scene(mesh, Mode::full, shells(0, 3), kSize);
  std::vector<preint::ControlPoint> points = scene.transfer_function.points();
  for (preint::ControlPoint& point : points) point.material = {};
  scene.transfer_function = TransferFunction(points);
  scene.gradient = GradientOf::cell;
  scene.lights = far_lights();
  for (const Shading shading : {Shading::weighted, Shading::interpolated}) {
    scene.shading = shading;
    const Image expected = draw_by_tables(scene, 128, 32);
    EXPECT_EQ(compare(draw_by_tables(scene, 128, 32, Layout::strip), expected).max, 0);
    EXPECT_LE(compare(draw_by_tables(scene, 128, 32, Layout::faces12), expected).rms, 1e-4);
  }
}

TEST(Lighting, OpenGlTellsWhatItLacks) {
  const mesh::TetMesh mesh = linear_cube();
  Scene scene = tests::make_scene(mesh, Mode::full, shells(-1.6, 1.6), kSize);
  scene.shading = Shading::weighted;
  Request request;
  request.projector = Projector::gl;
  EXPECT_THROW((void)plan(scene, request), base::UsageError);  // several shininesses
  std::vector<preint::ControlPoint> points = scene.transfer_function.points();
  for (preint::ControlPoint& point : points) point.material.shininess = 9;
  scene.transfer_function = TransferFunction(points);
  EXPECT_NO_THROW((void)plan(scene, request));
  scene.shading = Shading::surface;
  EXPECT_NO_THROW((void)plan(scene, request));
  for (const Shading shading : {Shading::flat, Shading::smooth}) {
    scene.shading = shading;
    EXPECT_THROW((void)plan(scene, request), base::UsageError) << to_string(shading);
  }
  scene.shading = Shading::interpolated;
  EXPECT_EQ(plan(scene, request).integrator, Integrator::table3d);
  request.integrator = Integrator::exact;
  EXPECT_THROW((void)plan(scene, request), base::UsageError);
}

// One normal, light from far away, parallel rays: the light is the same along every ray, and every
// way to light is exact.
TEST(Lighting, AllWaysAgreeOnAConstantNormal) {
  const mesh::TetMesh mesh = linear_cube();
  for (const Shading shading : {Shading::flat, Shading::smooth, Shading::single, Shading::weighted,
                                Shading::interpolated, Shading::surface}) {
    for (const bool lit_by_lights : {false, true}) {
      Scene scene = tests::make_scene(mesh, Mode::full, shells(-1.6, 1.6), kSize);
      scene.camera.parallel = true;
      scene.shading = shading;
      if (lit_by_lights) scene.lights = far_lights();
      const double error = largest_error(scene);
      // Products of a linear material and a linear color are taken as linear in each linear part:
      // that is all they may differ by. Shells have one material, the haze between them two.
      EXPECT_LT(error, 1e-3) << to_string(shading) << (lit_by_lights ? ", lights" : ", headlight");
    }
  }
}

TEST(Lighting, OneMaterialAndOneNormalAreExact) {
  const mesh::TetMesh mesh = linear_cube();
  std::vector<preint::ControlPoint> points = shells(-1.6, 1.6).points();
  for (preint::ControlPoint& point : points) point.material = {0.1, 0.5, 0.4, 30};
  for (const Shading shading : {Shading::flat, Shading::smooth, Shading::single, Shading::weighted,
                                Shading::interpolated, Shading::surface}) {
    Scene scene = tests::make_scene(mesh, Mode::full, TransferFunction(points), kSize);
    scene.camera.parallel = true;
    scene.shading = shading;
    scene.lights = far_lights();
    EXPECT_LT(largest_error(scene), 2e-5) << to_string(shading);
  }
}

// What each way costs in accuracy where normals turn, for a coarse and a finer mesh.
TEST(Lighting, ErrorsFallWithTheSizeOfTheCells) {
  fmt::print("{:<13} {:>12} {:>12}\n", "shading", "RMS, n = 4", "RMS, n = 8");
  const std::array<mesh::TetMesh, 2> meshes = {round_cube(4), round_cube(8)};
  const auto errors = [&](Shading shading) {
    std::array<double, 2> result{};
    for (std::size_t i = 0; i < 2; ++i) {
      Scene scene = tests::make_scene(meshes[i], Mode::full, shells(0, 3.6), kSize);
      scene.shading = shading;
      scene.lights = far_lights();
      result[i] = rms_error(scene);
    }
    fmt::print("{:<13} {:>12.2e} {:>12.2e}\n", to_string(shading), result[0], result[1]);
    return result;
  };
  const auto single = errors(Shading::single);
  const auto weighted = errors(Shading::weighted);
  const auto interpolated = errors(Shading::interpolated);
  const auto smooth = errors(Shading::smooth);
  errors(Shading::surface);
  // meissner2002: the weight finds the right normal; lum2004: two normals do better than one.
  EXPECT_LT(weighted[0], single[0]);
  EXPECT_LT(smooth[0], interpolated[0]);
  // Normals turn half as much in cells half as large: the error of what is linear falls by four.
  // Half of that is left to shells that are as thin as the cells.
  EXPECT_LT(interpolated[1], interpolated[0] / 2);
  EXPECT_LT(smooth[1], smooth[0] / 2);
  EXPECT_LT(smooth[1], 1e-3);
}

TEST(Lighting, CellsHaveOneNormal) {
  const mesh::TetMesh mesh = round_cube(4);
  Scene scene = tests::make_scene(mesh, Mode::full, shells(0, 3.6), kSize);
  scene.camera.parallel = true;
  scene.shading = Shading::flat;
  scene.lights = far_lights();
  EXPECT_LT(largest_error(scene), 1e-3);
}

TEST(Lighting, CellFieldsHaveNoNormal) {
  mesh::TetMesh mesh = linear_cube();
  mesh::Field field{"c", mesh::Location::cell, 1, {}};
  for (std::size_t i = 0; i < mesh.cells.size(); ++i)
    field.values.push_back(static_cast<double>(i % 7));
  mesh.fields.push_back(field);
  Scene scene = tests::make_scene(mesh, Mode::full, shells(0, 7), kSize, "c");
  const Image unlit = draw(scene, Projector::cpu);
  for (const Shading shading : {Shading::smooth, Shading::weighted}) {
    scene.shading = shading;
    scene.lights = near_lights();
    EXPECT_LT(compare(draw(scene, Projector::cpu), unlit).max, 1e-5);
    EXPECT_LT(compare(draw(scene, Projector::reference), unlit).max, 1e-5);
  }
}

// A gradient of half the modulation halves the extinction; one above it leaves it.
TEST(Modulation, ScalesTheExtinction) {
  const mesh::TetMesh mesh = linear_cube();
  TransferFunction tf = shells(-1.6, 1.6);
  std::vector<preint::ControlPoint> halved = tf.points();
  for (preint::ControlPoint& point : halved) point.extinction *= 0.5;
  for (const Mode mode : {Mode::full, Mode::emission, Mode::absorption}) {
    for (const Projector projector : {Projector::cpu, Projector::reference, Projector::gl}) {
      Scene scene = tests::make_scene(mesh, mode, tf, kSize);
      const Image plain = draw(scene, projector);
      scene.modulation = 0.9 * kSlope.norm();
      EXPECT_LT(compare(draw(scene, projector), plain).max, 1e-6);
      scene.modulation = 2 * kSlope.norm();
      Scene half = tests::make_scene(mesh, mode, TransferFunction(halved), kSize);
      EXPECT_LT(compare(draw(scene, projector), draw(half, projector)).max, 1e-5)
          << to_string(mode);
    }
  }
}

// Gradients that differ from cell to cell, some above the modulation, some below.
TEST(Modulation, IsTheSameOnOpenGl) {
  const mesh::TetMesh mesh =
      tests::box(Vector3d::Constant(-1), Vector3d::Constant(1), 5, 5, 5,
                 [](const Vector3d& p) { return 1.5 + p.x() * p.x() * p.y() + 0.2 * p.z(); });
  const auto draw_gl = [](const Scene& scene, Layout layout, std::optional<Integrator> integrator,
                          std::optional<std::size_t> memory = {}) {
    Request request;
    request.projector = Projector::gl;
    request.gl.layout = layout;
    request.gl.memory = memory;
    request.integrator = integrator;
    Stats stats;
    const Image image = render(scene, plan(scene, request), stats);
    EXPECT_EQ(stats.work.count(Effect::modulation), has_faces12(layout) ? 0U : 1U);
    return image;
  };
  for (const Mode mode : {Mode::full, Mode::emission, Mode::absorption}) {
    Scene scene = tests::make_scene(mesh, mode, shells(0.4, 2.6), kSize);
    scene.modulation = 0.8;
    const Image expected = draw(scene, Projector::reference);
    EXPECT_LE(compare(draw(scene, Projector::cpu), expected).max, 1e-5);
    EXPECT_LE(compare(draw_gl(scene, Layout::indexed, {}), expected).max, 2e-5) << to_string(mode);
    EXPECT_LE(compare(draw_gl(scene, Layout::indexed, {}, 3000), expected).max, 2e-5);
    EXPECT_LE(compare(draw_gl(scene, Layout::faces12, {}), expected).rms, 1e-4) << to_string(mode);
    EXPECT_LE(compare(draw_gl(scene, Layout::faces12_short, {}), expected).rms, 1e-3);
    const Integrator table = mode == Mode::full ? Integrator::table3d : Integrator::table2d;
    EXPECT_LE(compare(draw_gl(scene, Layout::indexed, table), expected).rms, 3e-3);
    // It does something.
    scene.modulation.reset();
    EXPECT_GE(compare(draw(scene, Projector::cpu), expected).rms, 1e-2);
  }
}

}  // namespace
}  // namespace tetraglass::project
