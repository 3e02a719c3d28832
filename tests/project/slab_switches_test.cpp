#include "project/slices/slab_switches.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/grids.h"

namespace tetraglass::project::slices {
namespace {

using Names = std::vector<std::string>;

Plan plan_of(const Scene& scene, const SlicesRequest& slices = {}) {
  Request request;
  request.projector = Projector::slices;
  request.slices = slices;
  return plan(scene, request);
}

Names switches(const Scene& scene, const SlicesRequest& slices = {}) {
  return slab_switches(scene, plan_of(scene, slices), scene.camera.parallel, {}, false);
}

Names added(const Names& more, const Names& less) {
  Names result;
  for (const std::string& name : more) {
    if (std::ranges::find(less, name) == less.end()) result.push_back(name);
  }
  return result;
}

// Each effect has its switch, and nothing else changes with it.
TEST(SlabSwitches, AnUnlitSceneHasNoLightInItsShader) {
  const mesh::TetMesh mesh = tests::grid_mesh(tests::bent);
  const Scene unlit = tests::grid_scene(mesh, Mode::full, tests::smooth_medium());
  const Names plain = switches(unlit);
  EXPECT_EQ(plain, (Names{"MODE_FULL", "INTEGRATED", "NEEDS_MEDIUM"}));
  EXPECT_FALSE(plan_of(unlit).gradients);

  Scene lit = unlit;
  lit.shading = Shading::single;
  EXPECT_EQ(added(switches(lit), plain), (Names{"SHADING_SMOOTH"}));
  lit.gradient = GradientOf::sobel;
  EXPECT_EQ(added(switches(lit), plain), (Names{"SOBEL", "SHADING_SMOOTH"}));
  lit.gradient = GradientOf::central;
  lit.lights = Lights{};
  EXPECT_EQ(added(switches(lit), plain), (Names{"SHADING_SMOOTH", "LIGHTS"}));
  lit.shading = Shading::weighted;
  EXPECT_EQ(added(switches(lit), plain),
            (Names{"SHADING_SMOOTH", "LIGHTS", "MATERIAL_TABLE", "WEIGHTED_NORMAL"}));
  lit.shading = Shading::surface;
  EXPECT_EQ(added(switches(lit), plain), (Names{"SHADING_SMOOTH", "LIGHTS", "SURFACE_NORMAL"}));
  lit.shading = Shading::interpolated;
  EXPECT_EQ(added(switches(lit), plain),
            (Names{"TABLE_2D", "SHADING_SMOOTH", "LIGHTS", "RAMPED_LIGHT"}));

  Scene modulated = unlit;
  modulated.modulation = 1;
  EXPECT_EQ(added(switches(modulated), plain), (Names{"MODULATED"}));
}

TEST(SlabSwitches, OfTheGridAndItsStack) {
  const mesh::TetMesh even = tests::grid_mesh(tests::bent);
  const mesh::TetMesh uneven = tests::grid_mesh(tests::bent, false);
  const Scene scene = tests::grid_scene(even, Mode::full, tests::smooth_medium());
  const Names plain = switches(scene);
  EXPECT_EQ(added(switches(tests::grid_scene(uneven, Mode::full, tests::smooth_medium())), plain),
            (Names{"UNEVEN"}));
  SlicesRequest shells;
  shells.stack = Stack::shells;
  EXPECT_EQ(added(switches(scene, shells), plain), (Names{"SHELLS"}));
  SlicesRequest textures;
  textures.stack = Stack::textures;
  EXPECT_EQ(added(slab_switches(scene, plan_of(scene, textures), false, 1, true), plain),
            (Names{"BLOCKS", "PLANE xz", "LAYER y", "SLAB_AXIS 1"}));
}

}  // namespace
}  // namespace tetraglass::project::slices
