#include "project/reference/lit_segment.h"

#include <cmath>

#include <gtest/gtest.h>

namespace tetraglass::project {
namespace {

using preint::Color;
using preint::RampedRadiance;
using preint::Segment;

const preint::TransferFunction& tents() {
  static const preint::TransferFunction kTents({{0, Color(0.1, 0.2, 0.9), 0},
                                                {0.3, Color(0.9, 0.2, 0.1), 4},
                                                {0.5, Color(0.2, 0.9, 0.1), 0},
                                                {0.5, Color(0.4, 0.1, 0.2), 2},
                                                {1, Color(1, 1, 1), 0.5}});
  return kTents;
}

const std::vector<Segment>& segments() {
  static const std::vector<Segment> kSegments = {{0, 1, 1},     {1, 0, 1},      {0.1, 0.45, 0.01},
                                                 {0.4, 0.4, 2}, {0.9, 0.2, 30}, {0.05, 0.95, 4000},
                                                 {0.2, 0.7, 0}};
  return kSegments;
}

// Unlit colors: the closed forms.
TEST(LitSegment, UnlitIsTheIntegral) {
  for (const Segment& segment : segments()) {
    const preint::Radiance lit =
        integrate_lit(tents(), segment, [](double, double, const Color& c) { return c; });
    const preint::Radiance expected = integrate_full(tents(), segment);
    EXPECT_LT((lit.color - expected.color).abs().maxCoeff(), 2e-8) << segment.length;
    EXPECT_NEAR(lit.transmittance, expected.transmittance, 1e-15);
  }
}

// Light that falls linearly along the segment: lum2004's front-weighted integral.
TEST(LitSegment, LinearLightIsTheRampedIntegral) {
  for (const Segment& segment : segments()) {
    const preint::Radiance lit = integrate_lit(
        tents(), segment, [](double t, double, const Color& c) { return Color((1 - t) * c); });
    const RampedRadiance expected = integrate_ramped(tents(), segment);
    EXPECT_LT((lit.color - expected.front).abs().maxCoeff(), 2e-8) << segment.length;
  }
}

// A light that jumps in the middle of a constant medium.
TEST(LitSegment, JumpsOfTheLightAreFound) {
  const double depth = 3;
  const preint::TransferFunction tf({{0, Color::Ones(), depth}});
  const preint::Radiance lit = integrate_lit(
      tf, {0, 1, 1},
      [](double t, double, const Color& c) -> Color { return t < 1.0 / 3 ? c : Color(2 * c); });
  const double first = 1 - std::exp(-depth / 3);
  const double second = std::exp(-depth / 3) - std::exp(-depth);
  EXPECT_NEAR(lit.color.x(), first + 2 * second, 1e-7);
}

// The value where the light is asked for is that of the place.
TEST(LitSegment, ValuesBelongToPlaces) {
  for (const Segment& segment : segments()) {
    static_cast<void>(
        integrate_lit(tents(), segment, [&](double t, double s, const Color& c) -> Color {
          EXPECT_NEAR(s, segment.front + t * (segment.back - segment.front), 1e-12);
          EXPECT_GE(t, 0);
          EXPECT_LE(t, 1 + 1e-12);
          return c;
        }));
  }
}

}  // namespace
}  // namespace tetraglass::project
