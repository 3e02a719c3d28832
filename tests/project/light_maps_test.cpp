#include "project/light/light_maps.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "project/compare.h"
#include "project/render.h"
#include "tests/support/grids.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace tetraglass::project {
namespace {

using Eigen::Vector3d;

LightSource far_light(const Vector3d& towards, const preint::Color& color) {
  LightSource source;
  source.place = towards.normalized();
  source.far_away = true;
  source.color = color;
  return source;
}

TEST(LightMaps, DirectionsCoverTheSphere) {
  // The solid angles of the texels, 4 / n^2 / |(s, t, 1)|^3, sum up to that of all directions.
  const int n = 32;
  double sum = 0;
  Vector3d mean = Vector3d::Zero();
  for (int face = 0; face < 6; ++face) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        const Vector3d direction = texel_direction(n, face, x, y);
        EXPECT_NEAR(direction.norm(), 1, 1e-14);
        const double angle = 4.0 / (n * n) * std::pow(direction.cwiseAbs().maxCoeff(), 3);
        sum += angle;
        mean += angle * direction;
      }
    }
  }
  EXPECT_NEAR(sum, 16 * std::atan(1.0), 1e-2);
  EXPECT_LT(mean.norm(), 1e-12);
  EXPECT_GT(texel_direction(n, 0, 3, 5).x(), 0.5);
  EXPECT_LT(texel_direction(n, 3, 3, 5).y(), -0.5);
}

TEST(LightMaps, TexelsAreTheSumOverTheLights) {
  const std::vector<LightSource> sources = {far_light({1, 2, 3}, {1, 0.5, 0}),
                                            far_light({-1, 0.5, 0}, {0, 0.5, 2})};
  const LightMap diffuse = diffuse_map(sources, 8);
  const LightMap specular = specular_map(sources, 20, 8);
  for (int face = 0; face < 6; ++face) {
    const Vector3d d = texel_direction(8, face, 2, 5);
    for (int c = 0; c < 3; ++c) {
      double light = 0;
      double shine = 0;
      for (const LightSource& source : sources) {
        const double cosine = std::max(0.0, d.dot(source.place));
        light += source.color[c] * cosine;
        shine += source.color[c] * std::pow(cosine, 20);
      }
      EXPECT_NEAR(diffuse.texel(face, 2, 5)[c], light, 1e-6);
      EXPECT_NEAR(specular.texel(face, 2, 5)[c], shine, 1e-6);
    }
  }
}

TEST(LightMaps, NearLightsStandWhereTheMiddleSeesThem) {
  LightSource near;
  near.place = {3, 4, 0};
  const std::vector<LightSource> seen = seen_from(std::vector{near}, Vector3d(3, 0, 0));
  EXPECT_TRUE(seen[0].far_away);
  EXPECT_LT((seen[0].place - Vector3d::UnitY()).norm(), 1e-15);
}

Lights three_lights() {
  Lights lights;
  lights.ambient = {0.6, 0.8, 1};
  lights.lights.emplace_back(DirectionalLight{{-1, -0.5, -0.4}, {0.9, 0.8, 0.7}});
  lights.lights.emplace_back(DirectionalLight{{0.3, -1, 0.5}, {0.1, 0.3, 0.6}});
  lights.lights.emplace_back(DirectionalLight{{-0.2, 0.4, 1}, {0.5, 0.1, 0.1}});
  return lights;
}

// Far-away lights only: what is left is the interpolation between texels.
TEST(LightMaps, PicturesComeNearToTheSumAsTheMapsGrow) {
  const mesh::TetMesh mesh = tests::grid_mesh(tests::bent);
  for (const Mode mode : {Mode::iso, Mode::full}) {
    for (const Projector projector : {Projector::gl, Projector::slices}) {
      Scene scene = tests::grid_scene(mesh, mode, tests::smooth_medium(), 64);
      scene.lights = three_lights();
      scene.shading = mode == Mode::iso ? Shading::smooth : Shading::single;
      if (mode == Mode::iso) scene.isosurfaces = {{0.1, {1, 0.8, 0.6}, 1}};
      Request request;
      request.projector = projector;
      Stats stats;
      const Image summed = render(scene, plan(scene, request), stats);
      double before = 1;
      for (const int size : {16, 64, 256}) {
        request.light_map = size;
        const Difference error = compare(render(scene, plan(scene, request), stats), summed);
        EXPECT_LT(error.rms, before / 3) << size;
        EXPECT_GT(error.rms, 1e-8) << "are they used?";
        before = error.rms;
      }
      EXPECT_LT(before, 5e-4) << to_string(mode) << ' ' << to_string(projector);
    }
  }
}

TEST(LightMaps, AreRefusedWhereTheyHaveNoUse) {
  const mesh::TetMesh mesh = tests::grid_mesh(tests::bent);
  Scene scene = tests::make_scene(mesh, Mode::iso, tests::smooth_medium());
  scene.isosurfaces = {{0.1, {1, 0.8, 0.6}, 1}};
  scene.shading = Shading::smooth;
  Request request;
  request.light_map = 64;
  EXPECT_THROW((void)plan(scene, request), base::UsageError) << "a headlight";
  scene.lights = three_lights();
  EXPECT_EQ(plan(scene, request).light_map, 64);
  EXPECT_EQ(plan(scene, request).projector, Projector::gl);
  request.projector = Projector::cpu;
  EXPECT_THROW((void)plan(scene, request), base::UsageError);
  request.projector.reset();
  request.light_map = 1 << 20;
  EXPECT_THROW((void)plan(scene, request), base::UsageError);
}

}  // namespace
}  // namespace tetraglass::project
