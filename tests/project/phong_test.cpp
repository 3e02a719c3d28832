#include "project/light/phong.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "project/light/light_sources.h"

namespace tetraglass::project {
namespace {

using Eigen::Vector3d;
using preint::Color;
using preint::Material;

const Vector3d kUp = Vector3d::UnitZ();

Vector3d direction(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  return {std::sin(angle), 0, std::cos(angle)};
}

TEST(Phong, HeadlightByItsFormula) {
  const Color color(0.2, 0.5, 0.9);
  const Material m{0.15, 0.6, 0.3, 20};
  for (const double degrees : {0.0, 20.0, 44.0, 70.0, 120.0, 180.0}) {
    const Color shaded = shade({}, color, m, Vector3d::Zero(), 3 * kUp, direction(degrees));
    const double cosine = std::abs(std::cos(degrees * std::numbers::pi / 180));
    const double reflected = std::max(0.0, 2 * cosine * cosine - 1);
    const Color expected = color * (0.15 + 0.6 * cosine) + 0.3 * std::pow(reflected, 20);
    EXPECT_LT((shaded - expected).abs().maxCoeff(), 1e-14) << degrees;
  }
}

TEST(Phong, WithoutGradientTheColorStays) {
  const Color color(0.2, 0.5, 0.9);
  EXPECT_TRUE((shade({}, color, {}, Vector3d::Zero(), Vector3d::Zero(), kUp) == color).all());
}

// Mirror: light at 30 degrees on one side, viewer at 30 degrees on the other.
TEST(Phong, DirectionalLightIsMirrored) {
  Lights lights;
  lights.ambient = Color(0.5, 0, 0);
  lights.lights.emplace_back(DirectionalLight{-direction(30), Color(1, 2, 3)});
  const Illumination light = illuminate(lights, Vector3d(7, 8, 9), kUp, direction(-30), 50);
  EXPECT_LT((light.diffuse - std::cos(std::numbers::pi / 6) * Color(1, 2, 3)).abs().maxCoeff(),
            1e-14);
  EXPECT_LT((light.specular - Color(1, 2, 3)).abs().maxCoeff(), 1e-13);
  EXPECT_TRUE((light.ambient == lights.ambient).all());
  // Ten degrees beside it.
  const Illumination beside = illuminate(lights, Vector3d::Zero(), kUp, direction(-40), 50);
  EXPECT_NEAR(beside.specular.x(), std::pow(std::cos(std::numbers::pi / 18), 50), 1e-12);
}

TEST(Phong, TheSideOfTheViewerIsLit) {
  Lights lights;
  lights.lights.emplace_back(DirectionalLight{-direction(20), Color::Ones()});
  const Illumination same = illuminate(lights, Vector3d::Zero(), -kUp, direction(10), 10);
  EXPECT_NEAR(same.diffuse.x(), std::cos(std::numbers::pi / 9), 1e-14);
  // From below, the light is behind the surface.
  const Illumination behind = illuminate(lights, Vector3d::Zero(), kUp, -kUp, 10);
  EXPECT_EQ(behind.diffuse.x(), 0);
}

TEST(Phong, PointLightShinesFromItsPlace) {
  Lights lights;
  lights.lights.emplace_back(PointLight{Vector3d(1, 0, 1), Color::Ones()});
  EXPECT_NEAR(illuminate(lights, Vector3d::Zero(), kUp, kUp, 1).diffuse.x(), std::sqrt(0.5), 1e-14);
  EXPECT_NEAR(illuminate(lights, Vector3d(1, 0, 0), kUp, kUp, 1).diffuse.x(), 1, 1e-14);
  EXPECT_EQ(illuminate(lights, Vector3d(1, 0, 1), kUp, kUp, 1).diffuse.x(), 0);
  EXPECT_EQ(illuminate(lights, Vector3d(1, 0, 1), kUp, kUp, 1).specular.x(), 0);
}

/// The mean over 400 x 400 points of a rectangle.
Illumination summed(const RectangleLight& light, const Vector3d& point, const Vector3d& normal,
                    const Vector3d& to_viewer, double shininess) {
  Lights points;
  constexpr int kSide = 400;
  for (int i = 0; i < kSide * kSide; ++i) {
    points.lights.emplace_back(PointLight{light.corner +
                                              (i % kSide + 0.5) / kSide * light.edges[0] +
                                              (i / kSide + 0.5) / kSide * light.edges[1],
                                          light.color / (kSide * kSide)});
  }
  return illuminate(points, point, normal, to_viewer, shininess);
}

// The second one stands half below the surface, the third touches it.
TEST(Phong, RectangleIsTheMeanOfItsPoints) {
  const RectangleLight above{
      {-1, -0.5, 2}, {Vector3d(2, 0, 0), Vector3d(0, 1, 0.3)}, Color(1, 2, 0)};
  const RectangleLight half{{2, -1, -1}, {Vector3d(0, 2, 0), Vector3d(0, 0, 2)}, Color::Ones()};
  const RectangleLight at{{0, 0, 0}, {Vector3d(1, 0, 0), Vector3d(0, 1, 0.5)}, Color::Ones()};
  for (const RectangleLight& rectangle : {above, half, at}) {
    Lights lights;
    lights.lights.emplace_back(rectangle);
    for (const double degrees : {-40.0, 10.0}) {
      const Vector3d v = direction(degrees);
      const Illumination exact = illuminate(lights, Vector3d::Zero(), kUp, v, 32);
      const Illumination expected = summed(rectangle, Vector3d::Zero(), kUp, v, 32);
      // The sum itself is off by the squared width of its cells, and by half of one at a corner
      // that lies in the lit point.
      EXPECT_LT((exact.diffuse - expected.diffuse).abs().maxCoeff(), 1e-4);
      EXPECT_LT((exact.specular - expected.specular).abs().maxCoeff(), 1e-4);
    }
  }
}

TEST(LightSources, RectanglesArePointsToAThousandth) {
  const Eigen::AlignedBox3d box(Vector3d(-1, -1, -1), Vector3d(1, 1, 1));
  Lights lights;
  lights.lights.emplace_back(
      RectangleLight{{1.5, -1, -1}, {Vector3d(0, 2, 0), Vector3d(0.5, 0, 2)}, Color::Ones()});
  lights.lights.emplace_back(DirectionalLight{Vector3d(0, 3, 0), Color::Ones()});
  for (const double shininess : {1.0, 32.0}) {
    Lights points;
    const std::vector<LightSource> sources = light_sources(
        lights, box,
        preint::TransferFunction({{0, Color::Ones(), 1, Material{0.1, 0.7, 0.2, shininess}}}));
    ASSERT_GE(sources.size(), 17U);
    double sum = 0;
    for (const LightSource& source : sources) {
      sum += source.color.x();
      if (source.far_away) {
        points.lights.emplace_back(DirectionalLight{-source.place, source.color});
      } else {
        points.lights.emplace_back(PointLight{source.place, source.color});
      }
    }
    EXPECT_NEAR(sum, 2, 1e-12);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(-1, 1);
    double worst = 0;
    for (int i = 0; i < 200; ++i) {
      const auto vector = [&] { return Vector3d(unit(random), unit(random), unit(random)); };
      const Vector3d at = vector();
      const Vector3d normal = vector().normalized();
      const Vector3d viewer = vector().normalized();
      const Illumination a = illuminate(lights, at, normal, viewer, shininess);
      const Illumination b = illuminate(points, at, normal, viewer, shininess);
      worst = std::max({worst, (a.diffuse - b.diffuse).abs().maxCoeff(),
                        (a.specular - b.specular).abs().maxCoeff()});
    }
    EXPECT_LT(worst, 5e-3) << shininess;
    RecordProperty("worst", std::to_string(worst));
    std::printf("shininess %g: %zu sources, largest error %.2g\n", shininess, sources.size(),
                worst);
  }
}

}  // namespace
}  // namespace tetraglass::project
