// Media and fields that are hard to integrate: clear and opaque ones, steps and peaks, isovalues
// that vertices and whole cells have, constant fields, numbers at the ends of what doubles hold.
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/stability/drawing.h"
#include "tests/stability/hard_meshes.h"
#include "tests/support/scenes.h"

namespace tetraglass::tests {
namespace {

using preint::ControlPoint;
using preint::TransferFunction;
using project::Mode;
using project::Scene;

const std::string kOrigin =
    "closed form of a linear field in a convex body, moved by the roundings";

/// All modes that look at the medium, by every contender, against the closed form.
void expect_medium(Record& record, const HardMesh& hard, const TransferFunction& tf,
                   double value_rounding = 0) {
  for (const View& view : outside_views(mesh::bounds(hard.mesh))) {
    double most = -1;
    for (const Effect& effect : effects()) {
      if (effect.mode == Mode::thickness || effect.mode == Mode::iso) continue;
      Scene scene = effect_scene(hard.mesh, effect, view);
      scene.transfer_function = tf;
      if (most < 0) most = deepest(scene);
      for (const Contender& contender : exact_contenders(scene)) {
        Roundings roundings = tests::roundings(scene, contender.projector);
        roundings.value += value_rounding;
        const Bounded exact = closed_form(hard.body, scene, roundings, most);
        const std::string detail =
            fmt::format("{}, {}, {}", view.name, effect.name, contender.name);
        const project::Image image = draw(scene, contender.request);
        if (effect.mode != Mode::emission) expect_sound(image, detail);
        record.expect_near(contender.way, detail, image, exact.image, exact.bound);
      }
    }
  }
}

class Extinction : public testing::TestWithParam<double> {};

TEST_P(Extinction, OfEveryStrength) {
  Record record("media", fmt::format("extinction {:.0e}", GetParam()), kOrigin);
  expect_medium(record, plain_box(), constant_medium({0.2, 0.5, 1}, GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Stability, Extinction, testing::Values(0.0, 1e-30, 1e6));

// Values of the field run from -0.9 to 1.1, of vertices in steps of a thirtieth.
TEST(StabilityOfMedia, StepsAndPeaks) {
  {
    Record record("media", "jumps at values of vertices", kOrigin);
    const double vertex = plain_box().mesh.fields[0].values[21];
    expect_medium(record, plain_box(),
                  TransferFunction({{-0.5, {1, 0, 0}, 0},
                                    {-0.5, {0, 1, 0}, 2},
                                    {vertex, {0, 0, 1}, 0.5},
                                    {vertex, {1, 1, 0}, 0},
                                    {0.7, {1, 0, 1}, 1},
                                    {0.7, {0, 1, 1}, 0.1}}));
  }
  {
    Record record("media", "step from 0 to 1e6", kOrigin);
    expect_medium(record, plain_box(),
                  TransferFunction({{0.137, {1, 0.2, 0}, 0}, {0.137, {0, 1, 0.4}, 1e6}}));
  }
  {
    Record record("media", "peak of 3e4 over 1e-4 of the range", kOrigin);
    expect_medium(record, plain_box(),
                  TransferFunction(
                      {{0.2371, {1, 0, 0}, 0}, {0.2372, {1, 1, 0}, 3e4}, {0.2373, {0, 0, 1}, 0}}));
  }
}

// What is constant has no gradient, no range, and is everywhere equal to an isovalue.
TEST(StabilityOfMedia, ConstantFields) {
  Record record("media", "constant field", kOrigin);
  HardMesh hard = plain_box();
  hard.body.gradient.setZero();
  hard.body.at_origin = 0.25;
  for (double& value : hard.mesh.fields[0].values) value = 0.25;
  expect_medium(record, hard, TransferFunction({{0, {1, 0, 0.2}, 0}, {1, {0, 1, 0.8}, 2}}));
  for (const double isovalue : {0.25, 0.0, 1.0}) {
    Scene scene = make_scene(hard.mesh, Mode::iso, constant_medium({1, 1, 1}, 1), kPixels);
    scene.isosurfaces = {{isovalue, {1, 1, 1}, 1}};
    for (const Contender& contender : exact_contenders(scene)) {
      record.expect_near(contender.way, fmt::format("isovalue {}", isovalue),
                         draw(scene, contender.request), project::Image(kPixels, kPixels), 0);
    }
  }
}

TEST(StabilityOfMedia, NearlyConstantFields) {
  Record record("media", "field of 1 +- 1e-12", kOrigin + ", its values rounded to doubles");
  HardMesh hard = plain_box();
  hard.body.gradient = 1e-12 * kRise;
  hard.body.at_origin = 1;
  for (std::size_t i = 0; i < hard.mesh.points.size(); ++i) {
    hard.mesh.fields[0].values[i] = hard.body.value(hard.mesh.points[i]);
  }
  const double low = 1 - 1e-12;
  const double high = 1 + 1e-12;
  // At the vertices, on the ray, and in the closed form.
  expect_medium(record, hard, five_colors(low, high, 3), 3 * 0x1p-53);
}

class Magnitude : public testing::TestWithParam<double> {};

TEST_P(Magnitude, OfValues) {
  const double size = GetParam();
  Record record("media", fmt::format("values of {:.0e}", size), kOrigin);
  HardMesh hard = plain_box();
  hard.body.gradient = size * kRise;
  hard.body.at_origin = 0.1 * size;
  for (std::size_t i = 0; i < hard.mesh.points.size(); ++i) {
    hard.mesh.fields[0].values[i] = hard.body.value(hard.mesh.points[i]);
  }
  // Denormal numbers are multiples of 2^-1074.
  expect_medium(record, hard, five_colors(-0.9 * size, 1.1 * size, 3.5), 0x1p-1074);
}

INSTANTIATE_TEST_SUITE_P(Stability, Magnitude, testing::Values(1e30, 1e300, 1e-310));

/// Of a box whose field is z in steps: the isovalue is that of a layer of vertices, or of a whole
/// layer of cells.
TEST(StabilityOfMedia, IsovaluesOfVerticesAndCells) {
  Record record("media", "isovalue of vertices, of whole cells",
                "one opaque or translucent surface that every ray meets");
  for (const bool plateau : {false, true}) {
    mesh::TetMesh mesh = box({-1, -1, -1}, {1, 1, 1}, 4, 4, 4, [&](const auto& p) {
      return plateau ? std::max(0.0, -p.z()) : p.z();
    });
    for (const bool is_parallel : {true, false}) {
      for (const double turn : {0.0, 0.3}) {
        project::Camera camera = down_z(0.9);
        camera.eye += turn * Eigen::Vector3d(10, 5, 0);
        camera.parallel = is_parallel;
        camera.fov_degrees = 4;
        for (const double opacity : {1.0, 0.5}) {
          Scene scene = make_scene(mesh, Mode::iso, constant_medium({1, 1, 1}, 1), 33);
          scene.camera = camera;
          scene.isosurfaces = {{0, {0.3, 0.6, 0.9}, opacity}};
          for (const Contender& contender : exact_contenders(scene)) {
            const project::Image image = draw(scene, contender.request);
            project::Image expected(33, 33);
            // Values equal to the isovalue count as above it: on a plateau nothing is below.
            for (std::size_t i = 0; i < expected.rgba.size() && !plateau; i += 4) {
              expected.rgba[i] = static_cast<float>(0.3 * opacity);
              expected.rgba[i + 1] = static_cast<float>(0.6 * opacity);
              expected.rgba[i + 2] = static_cast<float>(0.9 * opacity);
              expected.rgba[i + 3] = static_cast<float>(opacity);
            }
            record.expect_near(
                contender.way,
                fmt::format("{}, {}, turned {}, opacity {}", plateau ? "cells" : "vertices",
                            is_parallel ? "parallel" : "perspective", turn, opacity),
                image, expected, 1e-6);
          }
        }
      }
    }
  }
}

// Cells that touch what is not finite are not drawn: the picture is that without them.
TEST(StabilityOfMedia, NotFinite) {
  Record record("media", "NaN and Inf in the field and in points", "the picture without them");
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const HardMesh hard = plain_box();
  mesh::TetMesh damaged = hard.mesh;
  std::vector<double>& values = damaged.fields[0].values;
  const auto add = [&](const Eigen::Vector3d& point, double value) {
    damaged.points.push_back(point);
    values.push_back(value);
    const auto last = static_cast<std::uint32_t>(damaged.points.size() - 1);
    damaged.cells.push_back({0, 1, 5, last});
  };
  add({0.3, 0.2, 0.1}, kNan);
  add({0.3, 0.2, 0.1}, kInfinity);
  add({0.3, 0.2, 0.1}, -kInfinity);
  add({kNan, 0.2, 0.1}, 0.5);
  add({0.3, kInfinity, 0.1}, 0.5);
  add({0.3, 0.2, -kInfinity}, kNan);
  for (const View& view : outside_views(mesh::bounds(hard.mesh))) {
    for (const Effect& effect : effects()) {
      const Scene whole = effect_scene(hard.mesh, effect, view);
      const Scene scene = effect_scene(damaged, effect, view);
      EXPECT_EQ(scene.drawable.nan, 6U);
      for (const Contender& contender : exact_contenders(scene)) {
        const std::string detail =
            fmt::format("{}, {}, {}", view.name, effect.name, contender.name);
        record.expect_near(contender.way, detail, draw(scene, contender.request),
                           draw(whole, contender.request), 0);
      }
    }
  }
}

}  // namespace
}  // namespace tetraglass::tests
