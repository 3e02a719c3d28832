#include "project/plan.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace tetraglass::project {
namespace {

class PlanTest : public testing::Test {
 protected:
  Scene scene(Mode mode) const {
    return tests::make_scene(mesh_, mode,
                             preint::TransferFunction({{0, {1, 1, 1}, 1}, {1, {1, 0, 0}, 1}}));
  }
  mesh::TetMesh mesh_ = tests::unit_tetrahedron([](const auto& p) { return p.x(); });
};

TEST_F(PlanTest, OnlyModesThatBlendAreSorted) {
  EXPECT_EQ(plan(scene(Mode::full), {}).sort, SortMethod::fragments);
  Request gl;
  gl.projector = Projector::gl;
  EXPECT_EQ(plan(scene(Mode::full), gl).sort, SortMethod::mpvo);
  for (const Mode mode :
       {Mode::emission, Mode::absorption, Mode::mip, Mode::thickness, Mode::iso}) {
    EXPECT_EQ(plan(scene(mode), gl).sort, SortMethod::none) << to_string(mode);
    if (mode != Mode::iso) {
      EXPECT_EQ(plan(scene(mode), {}).sort, SortMethod::none) << to_string(mode);
    }
  }
  Scene translucent = scene(Mode::iso);
  translucent.isosurfaces = {{0.5, {1, 1, 1}, 0.5}};
  EXPECT_EQ(plan(translucent, gl).sort, SortMethod::mpvo);
}

TEST_F(PlanTest, TheCpuDrawsWhatItCan) {
  for (const Mode mode :
       {Mode::full, Mode::emission, Mode::absorption, Mode::mip, Mode::thickness, Mode::iso}) {
    EXPECT_EQ(plan(scene(mode), {}).projector, Projector::cpu) << to_string(mode);
  }
  Request request;
  request.context = ContextKind::osmesa;
  EXPECT_EQ(plan(scene(Mode::full), request).projector, Projector::gl);
  request = {};
  request.sort = SortMethod::centroid;
  EXPECT_EQ(plan(scene(Mode::full), request).projector, Projector::cpu);
  EXPECT_EQ(plan(scene(Mode::full), request).sort, SortMethod::centroid);
  request = {};
  request.integrator = Integrator::table3d;
  EXPECT_EQ(plan(scene(Mode::full), request).projector, Projector::cpu);
  request.integrator = Integrator::table2d;
  EXPECT_EQ(plan(scene(Mode::iso), request).projector, Projector::gl);
}

TEST_F(PlanTest, RaysOfTheCpuEndWhereTheyAreOpaque) {
  Request request;
  request.opaque_at = 0.5;
  EXPECT_EQ(plan(scene(Mode::full), request).opaque_at, 0.5);
  for (const double wrong : {0.0, -1.0, 1.5}) {
    request.opaque_at = wrong;
    EXPECT_THROW((void)plan(scene(Mode::full), request), base::UsageError) << wrong;
  }
  request.opaque_at = 0.5;
  request.projector = Projector::gl;
  EXPECT_THROW((void)plan(scene(Mode::full), request), base::UsageError);
}

TEST_F(PlanTest, RefusesAWrongPicture) {
  Request unsorted;
  unsorted.sort = SortMethod::none;
  EXPECT_THROW((void)plan(scene(Mode::full), unsorted), base::UsageError);
  EXPECT_NO_THROW((void)plan(scene(Mode::emission), unsorted));
  Scene cells = scene(Mode::iso);
  cells.field.location = mesh::Location::cell;
  EXPECT_THROW((void)plan(cells, {}), base::UsageError);
}

TEST_F(PlanTest, TablesHaveTheDimensionOfTheMode) {
  Request request;
  request.integrator = Integrator::table3d;
  const Plan full = plan(scene(Mode::full), request);
  EXPECT_GT(full.table_n, 1);
  EXPECT_GT(full.table_m, 1);
  EXPECT_THROW((void)plan(scene(Mode::emission), request), base::UsageError);
  EXPECT_THROW((void)plan(scene(Mode::thickness), request), base::UsageError);
  request.integrator = Integrator::table2d;
  const Plan emission = plan(scene(Mode::emission), request);
  EXPECT_GT(emission.table_n, 1);
  EXPECT_EQ(emission.table_m, 0);
  EXPECT_THROW((void)plan(scene(Mode::full), request), base::UsageError);
  request.integrator = Integrator::psi;
  EXPECT_THROW((void)plan(scene(Mode::emission), request), base::UsageError);
  EXPECT_GT(plan(scene(Mode::full), request).table_n, 1);
  request.integrator = Integrator::linear;
  EXPECT_THROW((void)plan(scene(Mode::mip), request), base::UsageError);
  EXPECT_EQ(plan(scene(Mode::full), request).table_n, 0);
  request.integrator = Integrator::table2d;
  request.table_n = 1 << 20;
  EXPECT_THROW((void)plan(scene(Mode::emission), request), base::UsageError);
}

TEST_F(PlanTest, NoWorkWithoutNeed) {
  const Plan plain = plan(scene(Mode::full), {});
  EXPECT_EQ(plain.table_n, 0);
  EXPECT_FALSE(plain.gradients);
  Scene shaded = scene(Mode::iso);
  shaded.shading = Shading::smooth;
  EXPECT_TRUE(plan(shaded, {}).gradients);
  shaded.shading = Shading::flat;
  EXPECT_TRUE(plan(shaded, {}).gradients);
}

TEST_F(PlanTest, LightWhereThereIsSomethingToLight) {
  Scene medium = scene(Mode::full);
  medium.shading = Shading::weighted;
  EXPECT_TRUE(plan(medium, {}).gradients);
  medium.mode = Mode::iso;
  EXPECT_THROW((void)plan(medium, {}), base::UsageError);
  Scene unlit = scene(Mode::emission);
  unlit.shading = Shading::smooth;
  EXPECT_THROW((void)plan(unlit, {}), base::UsageError);
  Scene dark = scene(Mode::full);
  dark.lights = Lights{};
  EXPECT_THROW((void)plan(dark, {}), base::UsageError);
  Scene modulated = scene(Mode::emission);
  modulated.modulation = 1;
  EXPECT_NO_THROW((void)plan(modulated, {}));
  modulated.mode = Mode::mip;
  EXPECT_THROW((void)plan(modulated, {}), base::UsageError);
}

TEST_F(PlanTest, TheReferenceTakesNoShortcuts) {
  Request request;
  request.projector = Projector::reference;
  EXPECT_EQ(plan(scene(Mode::full), request).sort, SortMethod::fragments);
  request.sort = SortMethod::centroid;
  EXPECT_THROW((void)plan(scene(Mode::full), request), base::UsageError);
  request = {};
  request.projector = Projector::reference;
  request.integrator = Integrator::table3d;
  EXPECT_THROW((void)plan(scene(Mode::full), request), base::UsageError);
}

TEST_F(PlanTest, SaysWhy) {
  EXPECT_GE(plan(scene(Mode::full), {}).reasons.size(), 4U);
}

}  // namespace
}  // namespace tetraglass::project
