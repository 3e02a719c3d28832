#include "project/effects.h"

#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "project/compare.h"
#include "project/gl/switches.h"
#include "project/render.h"
#include "project/single_color.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace tetraglass::project {
namespace {

using preint::TransferFunction;

double bumps(const Eigen::Vector3d& p) {
  return 0.5 + 0.3 * std::sin(5 * p.x()) + 0.2 * std::cos(7 * p.y() + p.z());
}

const TransferFunction kTwoColors({{0, {1, 0.2, 0}, 0.5},
                                   {0.6, {0, 0.5, 1}, 6},
                                   {1, {1, 1, 0}, 2}});
const TransferFunction kOneColor({{0, {1, 0.5, 0.2}, 0.5}, {0.6, {1, 0.5, 0.2}, 6}});

class EffectsTest : public testing::Test {
 protected:
  /// Parallel, unlit.
  Scene scene(Mode mode, const TransferFunction& tf = kTwoColors) const {
    Scene result = tests::make_scene(mesh_, mode, tf, 48);
    result.camera.parallel = true;
    result.camera.ortho_height = 2;
    if (mode == Mode::iso) result.isosurfaces = {{0.4, {1, 0.5, 0}, 1}, {0.6, {0, 0.5, 1}, 1}};
    return result;
  }

  struct Drawn {
    Plan plan;
    Image image;
    Stats stats;

    [[nodiscard]] std::set<Effect> worked() const {
      std::set<Effect> result;
      for (const auto& [effect, work] : stats.work) result.insert(effect);
      return result;
    }
  };
  static Drawn draw(const Scene& scene, Projector projector = Projector::cpu) {
    Request request;
    request.projector = projector;
    Drawn drawn;
    drawn.plan = plan(scene, request);
    drawn.image = render(scene, drawn.plan, drawn.stats);
    return drawn;
  }

  mesh::TetMesh mesh_ = tests::box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, 6, 6, 6, bumps);
};

std::string names(const std::set<Effect>& effects) {
  std::string result;
  for (const Effect effect : effects) result += to_string(effect) + " ";
  return result;
}

std::set<Effect> operator+(std::set<Effect> effects, Effect more) {
  effects.insert(more);
  return effects;
}

/// A scene with one thing more, and the effects that this calls for.
struct Addition {
  const char* name;
  std::function<void(Scene&)> add;
  std::set<Effect> effects;
};

const Eigen::Vector3d kOnes = Eigen::Vector3d::Ones();

Lights one_light() {
  Lights lights;
  lights.lights = {DirectionalLight{}};
  return lights;
}

TEST_F(EffectsTest, TheCpuDoesWorkForWhatIsThereOnly) {
  const std::set<Effect> least = {Effect::cells, Effect::segments};
  EXPECT_EQ(draw(scene(Mode::thickness)).worked(), least);
  const std::set<Effect> summed = least + Effect::medium;
  for (const Mode mode : {Mode::emission, Mode::absorption, Mode::mip}) {
    EXPECT_EQ(draw(scene(mode)).worked(), summed) << to_string(mode);
  }
  EXPECT_EQ(draw(scene(Mode::full)).worked(), summed + Effect::order);
  EXPECT_EQ(draw(scene(Mode::full, kOneColor)).worked(), summed);
  EXPECT_EQ(draw(scene(Mode::iso)).worked(), least);
  Scene translucent = scene(Mode::iso);
  translucent.isosurfaces[0].opacity = 0.5;
  EXPECT_EQ(draw(translucent).worked(), least + Effect::order);
}

TEST_F(EffectsTest, WhatIsAddedCostsItselfAndChangesNothingElse) {
  const Addition additions[] = {
      {"perspective", [](Scene& s) { s.camera.parallel = false; }, {Effect::rays}},
      {"clip",
       [](Scene& s) {
         s.clip = {{Eigen::Vector3d::UnitX(), 0.1}};
       },
       {Effect::clipping}},
      {"modulation", [](Scene& s) { s.modulation = 1; }, {Effect::modulation}},
      {"shading",
       [](Scene& s) { s.shading = Shading::interpolated; },
       {Effect::gradients, Effect::materials}},
      {"lights",
       [](Scene& s) {
         s.shading = Shading::single;
         s.lights = one_light();
       },
       {Effect::gradients, Effect::materials, Effect::lights}},
      {"outline",
       [](Scene& s) {
         s.opaque.lines = box_outline({-0.5 * kOnes, 0.5 * kOnes}, {1, 1, 1}, 1.5);
       },
       {Effect::opaque}},
      {"samples", [](Scene& s) { s.samples = 2; }, {Effect::samples}}};
  const Drawn without = draw(scene(Mode::full));
  for (const Addition& addition : additions) {
    Scene more = scene(Mode::full);
    addition.add(more);
    const Drawn with = draw(more);
    std::set<Effect> expected = without.worked();
    expected.insert(addition.effects.begin(), addition.effects.end());
    EXPECT_EQ(with.worked(), expected) << addition.name << ": " << names(with.worked());
    EXPECT_EQ(with.stats.work.at(Effect::medium).bytes, without.stats.work.at(Effect::medium).bytes)
        << addition.name;
    for (const Effect effect : addition.effects) {
      EXPECT_GT(with.stats.work.at(effect).bytes, 0U) << addition.name;
    }
  }
}

TEST_F(EffectsTest, ThePlanTellsWhatWillBeDone) {
  for (const Projector projector : {Projector::cpu, Projector::gl}) {
    for (const Mode mode :
         {Mode::full, Mode::emission, Mode::absorption, Mode::mip, Mode::iso, Mode::thickness}) {
      Scene s = scene(mode);
      if (mode == Mode::iso) s.shading = Shading::smooth;
      const Drawn drawn = draw(s, projector);
      const std::vector<EffectPlan> planned = planned_effects(s, drawn.plan, 2);
      ASSERT_EQ(planned.size(), kEffects.size());
      for (std::size_t i = 0; i < planned.size(); ++i) {
        const EffectPlan& effect = planned[i];
        const std::string what =
            to_string(projector) + " " + to_string(mode) + " " + to_string(effect.effect);
        EXPECT_EQ(effect.effect, kEffects[i]);
        EXPECT_FALSE(effect.why.empty()) << what;
        const auto work = drawn.stats.work.find(effect.effect);
        if (work != drawn.stats.work.end()) {
          EXPECT_TRUE(effect.needed) << what;
        }
        if (!effect.needed) {
          EXPECT_FALSE(effect.bytes || effect.ms) << what;
        }
        if (effect.bytes && effect.effect != Effect::cells) {
          ASSERT_NE(work, drawn.stats.work.end()) << what;
          EXPECT_NEAR(double(*effect.bytes), double(work->second.bytes),
                      0.05 * double(work->second.bytes) + 256)
              << what;
        }
      }
    }
  }
}

TEST_F(EffectsTest, SegmentsAreForeseenInTheMeanOverAllDirections) {
  for (const bool parallel : {true, false}) {
    double foreseen = 0;
    double counted = 0;
    // Points of a spiral spread evenly over the sphere.
    constexpr int kViews = 64;
    for (int i = 0; i < kViews; ++i) {
      const double z = (2.0 * i + 1) / kViews - 1;
      const double angle = 2.399963 * i;
      const double r = std::sqrt(1 - z * z);
      Scene s = scene(Mode::thickness);
      s.camera.eye = 4 * Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), z);
      s.camera.target.setZero();
      s.camera.parallel = parallel;
      const Drawn drawn = draw(s);
      const std::string why = planned_effects(s, drawn.plan, 2)[1].why;
      foreseen += std::stod(why.substr(std::string("about ").size()));
      counted += double(drawn.stats.fragments);
    }
    EXPECT_NEAR(foreseen / counted, 1, 0.03) << parallel;
  }
}

TEST_F(EffectsTest, ShadersOfGlHaveTheCodeOfWhatIsThereOnly) {
  Request request;
  request.projector = Projector::gl;
  const auto switches = [&](const Scene& s) {
    const std::vector<std::string> all =
        gl::shader_switches(s, plan(s, request), s.camera.parallel);
    return std::set<std::string>(all.begin(), all.end());
  };
  const std::set<std::string> emission = {"MODE_EMISSION", "PARALLEL", "VALUES", "NEEDS_MEDIUM"};
  EXPECT_EQ(switches(scene(Mode::emission)), emission);
  Scene clipped = scene(Mode::emission);
  clipped.clip = {{Eigen::Vector3d::UnitX(), 0.1}};
  std::set<std::string> with_clip = emission;
  with_clip.insert("CLIP_PLANES 1");
  EXPECT_EQ(switches(clipped), with_clip);
  Scene perspective = scene(Mode::emission);
  perspective.camera.parallel = false;
  std::set<std::string> with_rays = emission;
  with_rays.erase("PARALLEL");
  EXPECT_EQ(switches(perspective), with_rays);
  const std::set<std::string> unlit = {"MODE_ISO", "PARALLEL", "VALUES", "OPAQUE"};
  EXPECT_EQ(switches(scene(Mode::iso)), unlit);
  Scene lit = scene(Mode::iso);
  lit.shading = Shading::smooth;
  std::set<std::string> with_light = unlit;
  with_light.insert("SHADING_SMOOTH");
  EXPECT_EQ(switches(lit), with_light);
  std::set<std::string> unlit_medium = emission;
  unlit_medium.erase("MODE_EMISSION");
  unlit_medium.insert("MODE_FULL");
  EXPECT_EQ(switches(scene(Mode::full)), unlit_medium);
  Scene lit_medium = scene(Mode::full);
  for (const auto& [shading, names] : std::map<Shading, std::set<std::string>>{
           {Shading::single, {}},
           {Shading::surface, {"SURFACE_NORMAL"}},
           {Shading::weighted, {"MATERIAL_TABLE", "WEIGHTED_NORMAL"}},
           {Shading::interpolated, {"TABLE_3D", "RAMPED_LIGHT"}}}) {
    lit_medium.shading = shading;
    std::set<std::string> expected = unlit_medium;
    expected.insert("SHADING_SMOOTH");
    expected.insert(names.begin(), names.end());
    if (shading == Shading::interpolated) expected.erase("NEEDS_MEDIUM");
    EXPECT_EQ(switches(lit_medium), expected) << to_string(shading);
  }
  EXPECT_EQ(draw(scene(Mode::full), Projector::gl).stats.work.count(Effect::gradients), 0U);
  EXPECT_EQ(draw(scene(Mode::full), Projector::gl).stats.work.count(Effect::table), 0U);
  EXPECT_EQ(draw(scene(Mode::iso), Projector::gl).stats.work.count(Effect::gradients), 0U);
  EXPECT_EQ(draw(lit, Projector::gl).stats.work.count(Effect::gradients), 1U);
}

TEST_F(EffectsTest, OneColorNeedsNoOrder) {
  for (const bool parallel : {true, false}) {
    Scene s = scene(Mode::full, kOneColor);
    s.camera.parallel = parallel;
    const Image judge = draw(s, Projector::reference).image;
    for (const Projector projector : {Projector::cpu, Projector::gl}) {
      const Drawn drawn = draw(s, projector);
      EXPECT_EQ(drawn.plan.sort, SortMethod::none);
      EXPECT_EQ(drawn.stats.work.count(Effect::order), 0U);
      EXPECT_LE(compare(drawn.image, judge).max, 2e-6) << to_string(projector);
    }
  }
}

TEST_F(EffectsTest, ColorsThatAreNotSeenDoNotCount) {
  using Points = std::vector<preint::ControlPoint>;
  const auto color = [&](Points points) {
    return single_color(scene(Mode::full, TransferFunction(std::move(points))));
  };
  // The field lies between 0 and 1.
  EXPECT_TRUE(color({{-2, {1, 0, 0}, 1}, {-1, {0, 1, 0}, 1}, {1.5, {0, 1, 0}, 1}}));
  EXPECT_TRUE(color({{0.2, {1, 0, 0}, 0}, {0.4, {0, 0, 1}, 0}, {0.6, {0, 0, 1}, 1}}));
  EXPECT_FALSE(color({{0.2, {1, 0, 0}, 0}, {0.4, {0, 1, 0}, 0}, {0.6, {0, 0, 1}, 1}}));
  EXPECT_FALSE(color({{0.2, {1, 0, 0}, 1}, {2, {0, 0, 1}, 1}}));
  EXPECT_FALSE(color({{0.2, {1, 0, 0}, 1}, {0.5, {1, 0, 0}, 1}, {0.5, {0, 0, 1}, 1}}));
  EXPECT_TRUE((*color({{0.5, {1, 0, 0}, 0}}) == preint::Color::Zero()).all());
  Scene lit = scene(Mode::full, kOneColor);
  lit.shading = Shading::smooth;
  EXPECT_FALSE(single_color(lit));
  EXPECT_FALSE(single_color(scene(Mode::emission, kOneColor)));
}

TEST_F(EffectsTest, TheNearestOfOpaqueSurfacesIsSeenWithoutAnOrder) {
  for (const bool parallel : {true, false}) {
    for (const Shading shading : {Shading::none, Shading::flat, Shading::smooth}) {
      Scene s = scene(Mode::iso);
      s.width = s.height = 160;
      s.camera.parallel = parallel;
      s.shading = shading;
      const Drawn drawn = draw(s);
      EXPECT_EQ(drawn.stats.work.count(Effect::order), 0U);
      const Difference error = compare(drawn.image, draw(s, Projector::reference).image);
      EXPECT_LE(error.max, 1e-4) << parallel << " " << to_string(shading);
    }
  }
}

TEST_F(EffectsTest, AConstantFieldHasNoTable) {
  const mesh::TetMesh constant =
      tests::box({0, 0, 0}, {1, 1, 1}, 2, 2, 2, [](const auto&) { return 0.3; });
  Request request;
  request.integrator = Integrator::table3d;
  const Plan chosen = plan(tests::make_scene(constant, Mode::full, kTwoColors), request);
  EXPECT_EQ(chosen.table_n, 0);
  EXPECT_EQ(chosen.integrator, Integrator::exact);
}

}  // namespace
}  // namespace tetraglass::project
