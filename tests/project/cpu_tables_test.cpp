// The native projector with the tables of preint, and with no more than the ends of segments.
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "mesh/samples.h"
#include "project/compare.h"
#include "project/cpu/cpu_projector.h"
#include "project/gl/gl_projector.h"
#include "project/reference/reference.h"
#include "tests/support/scenes.h"

namespace tetraglass::project {
namespace {

using tests::make_scene;

struct Case {
  std::string name;
  Mode mode;
  Integrator integrator;
  int coarse = 16;
  double gain = 6;  ///< with four times the samples: of second order a sixteenth is left
};

void PrintTo(const Case& c, std::ostream* out) {  // NOLINT(readability-identifier-naming)
  *out << c.name;
}

std::string name_of(const testing::TestParamInfo<Case>& info) {
  return info.param.name;
}

Image draw(const Scene& scene, Integrator integrator, int n, int m = 0,
           Projector projector = Projector::cpu) {
  Request request;
  request.projector = projector;
  request.integrator = integrator;
  request.table_n = n;
  request.table_m = m;
  Stats stats;
  const Plan planned = plan(scene, request);
  Image image = projector == Projector::cpu ? render_cpu(scene, planned, stats)
                                            : render_gl(scene, planned, stats);
  const bool tabled = planned.table_n > 0;
  EXPECT_EQ(stats.work.count(Effect::table), tabled ? 1U : 0U);
  EXPECT_TRUE(!tabled || stats.tables_ms > 0);
  return image;
}

/// Smooth: the error of linear interpolation falls with the square of the step.
preint::TransferFunction waves(const mesh::ScalarField& field, double diagonal) {
  std::vector<preint::ControlPoint> points;
  for (int i = 0; i <= 64; ++i) {
    const double t = i / 64.0;
    const preint::Color color(0.5 + 0.5 * std::sin(6 * t), t, 1 - t * t);
    points.push_back(
        {field.min + t * (field.max - field.min), color, (2 + 1.5 * std::sin(11 * t)) / diagonal});
  }
  return preint::TransferFunction(points);
}

class CpuTables : public testing::TestWithParam<Case> {
 protected:
  CpuTables() {
    scene_ = make_scene(mesh_, GetParam().mode,
                        waves(field_, mesh::bounds(mesh_).diagonal().norm()), 72);
    scene_.mip_of = MipOf::transfer;
  }

  const mesh::TetMesh mesh_ = mesh::make_sample("orbital", 20000);
  const mesh::ScalarField field_ = mesh::select_scalar(mesh_, "");
  Scene scene_;
};

TEST_P(CpuTables, ConvergeToTheReference) {
  Stats stats;
  const Image reference = render_reference(scene_, stats);
  const bool has_lengths = GetParam().integrator == Integrator::table3d;
  const auto error = [&](int n) {
    return compare(draw(scene_, GetParam().integrator, n, has_lengths ? n : 0), reference).rms;
  };
  const double coarse = error(GetParam().coarse);
  const double fine = error(4 * GetParam().coarse);
  EXPECT_LT(fine, coarse / GetParam().gain);
  EXPECT_LT(fine, 5e-3);
  EXPECT_GT(coarse, 1e-5);
}

TEST_P(CpuTables, AgreeWithThoseOfGl) {
  for (const bool parallel : {false, true}) {
    scene_.camera.parallel = parallel;
    const int m = GetParam().integrator == Integrator::table3d ? 16 : 0;
    const Image image = draw(scene_, GetParam().integrator, 24, m);
    const Image other = draw(scene_, GetParam().integrator, 24, m, Projector::gl);
    EXPECT_LE(compare(image, other).rms, 1e-4) << parallel;
    EXPECT_LE(compare(image, other).max, 2e-3) << parallel;
  }
}

INSTANTIATE_TEST_SUITE_P(All, CpuTables,
                         testing::Values(Case{"full3d", Mode::full, Integrator::table3d},
                                         Case{"psi", Mode::full, Integrator::psi, 4},
                                         Case{"emission", Mode::emission, Integrator::table2d},
                                         Case{"absorption", Mode::absorption, Integrator::table2d},
                                         // A largest value has kinks.
                                         Case{"mip", Mode::mip, Integrator::table2d, 16, 3}),
                         name_of);

/// With one color and an extinction that is linear in the field, the ends say all.
TEST(CpuLinear, IsExactWhereTheMediumIsLinear) {
  const mesh::TetMesh mesh = mesh::make_sample("orbital", 20000);
  const mesh::ScalarField field = mesh::select_scalar(mesh, "");
  const preint::TransferFunction ramp(
      {{field.min, {1, 0.5, 0.25}, 0.1}, {field.max, {1, 0.5, 0.25}, 3}});
  for (const Mode mode : {Mode::full, Mode::emission, Mode::absorption}) {
    const Scene scene = make_scene(mesh, mode, ramp, 72);
    Stats stats;
    const Image reference = render_reference(scene, stats);
    EXPECT_LE(compare(draw(scene, Integrator::linear, 0), reference).max, 2e-5) << to_string(mode);
  }
}

/// ... and else they do not.
TEST(CpuLinear, MissesWhatLiesBetween) {
  const mesh::TetMesh mesh = mesh::make_sample("orbital", 20000);
  const mesh::ScalarField field = mesh::select_scalar(mesh, "");
  for (const Mode mode : {Mode::full, Mode::emission, Mode::absorption}) {
    const Scene scene =
        make_scene(mesh, mode, waves(field, mesh::bounds(mesh).diagonal().norm()), 72);
    const Image image = draw(scene, Integrator::linear, 0);
    EXPECT_LE(compare(image, draw(scene, Integrator::linear, 0, 0, Projector::gl)).max, 1e-4);
    Stats stats;
    EXPECT_GT(compare(image, render_reference(scene, stats)).rms, 1e-5);
  }
}

TEST(CpuTable, IsRefusedWhereThereIsNone) {
  const mesh::TetMesh mesh = mesh::make_sample("orbital", 500);
  Scene scene = make_scene(mesh, Mode::iso, preint::preset("viridis", 0, 1, 3));
  Request request;
  request.projector = Projector::cpu;
  request.integrator = Integrator::table2d;
  EXPECT_THROW((void)plan(scene, request), base::UsageError);
  scene.mode = Mode::full;
  request.integrator = Integrator::table3d;
  EXPECT_NO_THROW((void)plan(scene, request));
  scene.modulation = 1;
  EXPECT_THROW((void)plan(scene, request), base::UsageError);
  scene.modulation.reset();
  scene.shading = Shading::smooth;
  EXPECT_THROW((void)plan(scene, request), base::UsageError);
}

}  // namespace
}  // namespace tetraglass::project
