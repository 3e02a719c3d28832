// The ladder of plans for an error, and pictures that keep within it.
#include "project/error_budget.h"

#include <string>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "mesh/samples.h"
#include "project/compare.h"
#include "project/render.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace tetraglass::project {
namespace {

using tests::make_scene;

mesh::TetMesh ball() {
  return tests::box({-1, -1, -1}, {1, 1, 1}, 6, 6, 6, [](const auto& p) { return p.norm(); });
}

preint::TransferFunction medium(double extinction) {
  return preint::TransferFunction({{0, {1, 0.2, 0}, 0},
                                   {0.6, {1, 1, 0.3}, extinction},
                                   {0.9, {0, 0.5, 1}, 0.2 * extinction},
                                   {1.8, {0, 0, 1}, extinction}});
}

void expect_a_ladder(const std::vector<Rung>& ladder) {
  ASSERT_FALSE(ladder.empty());
  for (std::size_t i = 0; i < ladder.size(); ++i) {
    EXPECT_FALSE(ladder[i].reason.empty());
    if (i > 0) {
      EXPECT_LE(ladder[i].predicted_error, ladder[i - 1].predicted_error) << i;
    }
  }
}

TEST(ErrorBudget, LadderClimbsFromTheCheapestToTheMostAccurate) {
  const mesh::TetMesh mesh = ball();
  for (const Mode mode :
       {Mode::full, Mode::emission, Mode::absorption, Mode::mip, Mode::thickness, Mode::iso}) {
    Scene scene = make_scene(mesh, mode, medium(3));
    scene.isosurfaces = {{0.5, {1, 1, 1}, 0.5}};
    for (const double error : {0.1, 1e-2, 1e-3, 1e-5, 1e-9}) {
      const std::vector<Rung> ladder = error_ladder(scene, {}, error);
      expect_a_ladder(ladder);
      EXPECT_EQ(ladder.front().request.projector, Projector::cpu) << to_string(mode);
      EXPECT_EQ(ladder.back().request.projector, Projector::reference) << to_string(mode);
      for (const Rung& rung : ladder) EXPECT_NO_THROW((void)plan(scene, rung.request));
    }
  }
}

TEST(ErrorBudget, RaysEndWhereTheErrorAllows) {
  const mesh::TetMesh mesh = ball();
  const Scene scene = make_scene(mesh, Mode::full, medium(3));
  const double loose = error_ladder(scene, {}, 0.1).front().request.opaque_at.value();
  const double strict = error_ladder(scene, {}, 0.01).front().request.opaque_at.value();
  EXPECT_LT(loose, strict);
  EXPECT_GE(loose, 0.9);  // what lies behind adds up to 1 - opacity
  EXPECT_LT(strict, 0.99998);
  EXPECT_FALSE(error_ladder(scene, {}, 1e-5).front().request.opaque_at.has_value());
}

TEST(ErrorBudget, WhatIsForcedStays) {
  const mesh::TetMesh mesh = ball();
  const Scene scene = make_scene(mesh, Mode::full, medium(3));
  Request request;
  request.opaque_at = 0.7;
  for (const Rung& rung : error_ladder(scene, request, 0.01)) {
    if (rung.request.projector != Projector::cpu) continue;
    EXPECT_EQ(rung.request.opaque_at.value_or(0.7), 0.7);
  }
  request = {};
  request.projector = Projector::gl;
  request.sort = SortMethod::centroid;
  request.integrator = Integrator::psi;
  const std::vector<Rung> ladder = error_ladder(scene, request, 0.01);
  ASSERT_EQ(ladder.size(), 1U);
  EXPECT_EQ(ladder[0].request.sort, SortMethod::centroid);
  EXPECT_EQ(ladder[0].request.integrator, Integrator::psi);
}

TEST(ErrorBudget, TablesGrowUntilTheyAreExactIntegrals) {
  const mesh::TetMesh mesh = ball();
  const Scene scene = make_scene(mesh, Mode::full, medium(3));
  Request request;
  request.projector = Projector::gl;
  int last = 0;
  for (const double error : {0.3, 0.1, 0.03, 0.01}) {
    const std::vector<Rung> ladder = error_ladder(scene, request, error);
    expect_a_ladder(ladder);
    const Request& first = ladder.front().request;
    const int n = first.integrator == Integrator::table3d ? first.table_n : 1000;
    EXPECT_GE(n, last) << error;
    last = n;
    EXPECT_EQ(ladder.back().request.sort, SortMethod::fragments);
  }
  EXPECT_FALSE(error_ladder(scene, request, 1e-6).front().request.integrator.has_value());
}

TEST(ErrorBudget, PicturesKeepWithinIt) {
  const mesh::TetMesh mesh = ball();
  for (const double extinction : {3.0, 30.0}) {
    const Scene scene = make_scene(mesh, Mode::full, medium(extinction), 40);
    Request exact;
    exact.projector = Projector::reference;
    Stats stats;
    const Image reference = render(scene, plan(scene, exact), stats);
    for (const Projector projector : {Projector::cpu, Projector::gl}) {
      for (const double error : {0.05, 2e-3}) {
        Request request;
        request.projector = projector;
        const VerifiedImage result = render_within(scene, request, error, 1000);
        EXPECT_TRUE(result.met);
        EXPECT_EQ(result.verification.pixels, 1000U);
        EXPECT_LE(result.verification.max_error, error);
        // 1000 pixels of 1600 leave few unseen.
        EXPECT_LE(compare(result.image, reference).max, 2 * error);
        EXPECT_NE(result.plan.reasons.back().find("error: "), std::string::npos);
      }
    }
  }
}

// An order that is wrong cannot be mended where it is forced: told, not hidden; and left alone
// where the reference can be taken.
TEST(ErrorBudget, StepsUpAndTellsWhatIsNotMet) {
  const mesh::TetMesh mesh = ball();
  const Scene scene = make_scene(mesh, Mode::full, medium(30), 40);
  Request request;
  request.projector = Projector::gl;
  request.integrator = Integrator::linear;
  const VerifiedImage told = render_within(scene, request, 1e-4, 300);
  EXPECT_FALSE(told.met);
  EXPECT_GT(told.verification.max_error, 1e-4);
  EXPECT_NE(told.plan.reasons.back().find("not met"), std::string::npos);

  const VerifiedImage exact = render_within(scene, {}, 5e-8, 300);
  EXPECT_EQ(exact.plan.projector, Projector::reference);
}

TEST(ErrorBudget, RefusesWhatIsNoError) {
  const mesh::TetMesh mesh = ball();
  const Scene scene = make_scene(mesh, Mode::full, medium(3));
  EXPECT_THROW((void)error_ladder(scene, {}, 0), base::UsageError);
  EXPECT_THROW((void)error_ladder(scene, {}, -1), base::UsageError);
}

}  // namespace
}  // namespace tetraglass::project
