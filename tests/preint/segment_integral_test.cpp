#include "preint/segment_integral.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/preint/media.h"
#include "tests/preint/quadrature.h"

namespace tetraglass::preint {
namespace {

constexpr double kTolerance = 1e-12;

const Color kRed(1, 0, 0);
const Color kBlue(0, 0, 1);

TransferFunction constant(const Color& color, double extinction) {
  return TransferFunction({{0, color, extinction}});
}

/// Front over back.
Radiance composite(const Radiance& front, const Radiance& back) {
  return {front.color + front.transmittance * back.color, front.transmittance * back.transmittance};
}

double largest_difference(const Radiance& a, const Radiance& b) {
  return std::max((a.color - b.color).abs().maxCoeff(),
                  std::abs(a.transmittance - b.transmittance));
}

TEST(SegmentIntegral, ConstantMedium) {
  const Color color(0.2, 0.5, 0.9);
  for (const double extinction : {0.0, 1e-30, 1e-3, 0.7, 1.0, 30.0, 1e6}) {
    for (const double length : {0.0, 1e-6, 1.0, 55.0}) {
      SCOPED_TRACE(testing::Message() << "extinction " << extinction << " length " << length);
      const Radiance r = integrate_full(constant(color, extinction), {-3, 8, length});
      const double opacity = -std::expm1(-extinction * length);
      EXPECT_NEAR(r.transmittance, 1 - opacity, 1e-15);
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(r.color[c], color[c] * opacity, 4e-15 * opacity);
      }
    }
  }
}

TEST(SegmentIntegral, LinearExtinctionOfOneColor) {
  // kappa(s) = 3 s: whatever the profile of the extinction, a white medium emits 1 - exp(-tau).
  const TransferFunction tf({{0, Color::Ones(), 0}, {10, Color::Ones(), 30}});
  for (const double back : {0.5, 2.0, 9.0, 10.0}) {
    for (const double length : {1e-8, 0.01, 1.0, 100.0}) {
      SCOPED_TRACE(testing::Message() << "back " << back << " length " << length);
      const double depth = length * 3 * (1 + back) / 2;
      for (const Segment& s : {Segment{1, back, length}, Segment{back, 1, length}}) {
        const Radiance r = integrate_full(tf, s);
        EXPECT_NEAR(r.color[0], -std::expm1(-depth), -4e-15 * std::expm1(-depth));
        EXPECT_NEAR(optical_depth(tf, s), depth, 4e-16 * depth);
      }
    }
  }
}

TEST(SegmentIntegral, LinearColorInConstantExtinction) {
  const TransferFunction tf({{0, Color::Zero(), 5}, {1, Color::Ones(), 5}});
  for (const double a : {0.01, 0.5, 3.0, 20.0, 500.0}) {
    SCOPED_TRACE(testing::Message() << "depth " << a);
    // int_0^1 a x exp(-a x) dx; from the back: int_0^1 a (1 - x) exp(-a x) dx
    const long double opacity = -std::expm1(-static_cast<long double>(a));
    const auto rising = static_cast<double>(opacity / a - (1 - opacity));
    const auto falling = static_cast<double>(opacity - (opacity / a - (1 - opacity)));
    EXPECT_NEAR(integrate_full(tf, {0, 1, a / 5}).color[1], rising, 1e-14);
    EXPECT_NEAR(integrate_full(tf, {1, 0, a / 5}).color[1], falling, 1e-14);
  }
}

TEST(SegmentIntegral, TwoSlabsInBothOrders) {
  const TransferFunction tf({{0.25, kRed, 2}, {0.25, kBlue, 8}});
  // A quarter of the length lies in red.
  const double red = 1 - std::exp(-2 * 0.25), blue = 1 - std::exp(-8 * 0.75);
  const Radiance rising = integrate_full(tf, {0, 1, 1});
  EXPECT_NEAR(rising.color[0], red, 1e-15);
  EXPECT_NEAR(rising.color[2], (1 - red) * blue, 1e-15);
  const Radiance falling = integrate_full(tf, {1, 0, 1});
  EXPECT_NEAR(falling.color[0], (1 - blue) * red, 1e-15);
  EXPECT_NEAR(falling.color[2], blue, 1e-15);
  EXPECT_NEAR(falling.transmittance, rising.transmittance, 1e-17);
}

TEST(SegmentIntegral, OneValueIsTheMediumThere) {
  const TransferFunction tf({{0, kRed, 1}, {1, kRed, 2}, {1, kBlue, 5}, {2, kBlue, 4}});
  const auto opacity = [](double depth) { return 1 - std::exp(-depth); };
  EXPECT_NEAR(integrate_full(tf, {0, 0, 2}).color[0], opacity(2), 1e-15);
  const Radiance at_jump = integrate_full(tf, {1, 1, 2});  // the upper point's
  EXPECT_EQ(at_jump.color[0], 0);
  EXPECT_NEAR(at_jump.color[2], opacity(10), 1e-15);
  EXPECT_NEAR(optical_depth(tf, {2, 2, 2}), 8, 1e-15);
  EXPECT_NEAR(optical_depth(tf, {7, 7, 2}), 8, 1e-15);
  EXPECT_NEAR(optical_depth(tf, {0.5, 0.5, 2}), 3, 1e-15);
}

TEST(SegmentIntegral, BeginsOnTheRightSideOfAJump) {
  const TransferFunction tf({{0, kRed, 1}, {1, kRed, 1}, {1, kBlue, 1}, {2, kBlue, 1}});
  EXPECT_EQ(integrate_full(tf, {1, 2, 1}).color[0], 0);  // up from the jump: only blue
  EXPECT_EQ(integrate_full(tf, {2, 1, 1}).color[0], 0);
  EXPECT_EQ(integrate_full(tf, {1, 0, 1}).color[2], 0);  // down from the jump: only red
  EXPECT_EQ(integrate_full(tf, {0, 1, 1}).color[2], 0);
}

RC_GTEST_PROP(SegmentIntegralProperty, FullMeetsQuadrature, ()) {
  const auto tf = *tests::transfer_function();
  const auto s = *tests::segment();
  const Radiance r = integrate_full(tf, s);
  const tests::Reference reference = tests::integrate_by_quadrature(tf, s);
  for (std::size_t c = 0; c < 3; ++c) {
    const auto error = std::abs(r.color[static_cast<long>(c)] - reference.full[c]);
    RC_ASSERT(error <= kTolerance);
  }
  RC_ASSERT(std::abs(r.transmittance - std::exp(-reference.depth)) <= kTolerance);
}

RC_GTEST_PROP(SegmentIntegralProperty, MeetsTheToleranceAskedFor, ()) {
  const auto tf = *tests::transfer_function(50);
  const auto s = *tests::segment(10);
  const Radiance exact = integrate_full(tf, s);
  const RampedRadiance ramped = integrate_ramped(tf, s);
  for (const double tolerance : {1e-12, 1e-10, 1e-9, 1e-6, 1e-5, 1e-4, 1.0}) {
    const Radiance r = integrate_full(tf, s, tolerance);
    const double bound = std::max(kTolerance, std::min(tolerance, 1e-4));
    RC_ASSERT(largest_difference(r, exact) <= bound);
    const RampedRadiance coarse = integrate_ramped(tf, s, tolerance);
    RC_ASSERT((coarse.front - ramped.front).abs().maxCoeff() <= bound);
    RC_ASSERT((coarse.back - ramped.back).abs().maxCoeff() <= bound);
  }
}

RC_GTEST_PROP(SegmentIntegralProperty, EmissionAndDepthMeetQuadrature, ()) {
  const auto tf = *tests::transfer_function();
  const auto s = *tests::segment();
  const Color emission = integrate_emission(tf, s);
  const tests::Reference reference = tests::integrate_by_quadrature(tf, s, 1);
  constexpr long double kRounding = 1e-14L;  // relative: all terms are positive
  for (std::size_t c = 0; c < 3; ++c) {
    const auto error = std::abs(emission[static_cast<long>(c)] - reference.emission[c]);
    RC_ASSERT(error <= kRounding * reference.emission[c]);
  }
  RC_ASSERT(std::abs(optical_depth(tf, s) - reference.depth) <= kRounding * reference.depth);
}

RC_GTEST_PROP(SegmentIntegralProperty, SplittingChangesNothing, ()) {
  const auto tf = *tests::transfer_function();
  const auto s = *tests::segment();
  const double at = s.front + *tests::unit() * (s.back - s.front);
  RC_PRE(s.front != s.back);
  const double t = (at - s.front) / (s.back - s.front);
  const Segment first{s.front, at, s.length * t};
  const Segment second{at, s.back, s.length * ((s.back - at) / (s.back - s.front))};
  const Radiance whole = integrate_full(tf, s);
  const Radiance parts = composite(integrate_full(tf, first), integrate_full(tf, second));
  RC_ASSERT(largest_difference(whole, parts) <= kTolerance);

  const Color emission = integrate_emission(tf, s);
  const Color sum = integrate_emission(tf, first) + integrate_emission(tf, second);
  RC_ASSERT(((emission - sum).abs() <= 1e-13 * emission).all());
}

RC_GTEST_PROP(SegmentIntegralProperty, TransmittanceIsExpOfSymmetricDepth, ()) {
  const auto tf = *tests::transfer_function();
  const auto s = *tests::segment();
  const double depth = optical_depth(tf, s);
  const double turned = optical_depth(tf, {s.back, s.front, s.length});
  RC_ASSERT(std::abs(depth - turned) <= 1e-15 * depth);
  const Radiance r = integrate_full(tf, s);
  RC_ASSERT(r.transmittance >= 0 && r.transmittance <= 1);
  RC_ASSERT(r.transmittance == std::exp(-depth));
  RC_ASSERT((r.color >= 0).all());
  RC_ASSERT((r.color <= 1 - r.transmittance + 1e-15).all());
}

RC_GTEST_PROP(SegmentIntegralProperty, ThinSegmentsOnlyEmit, ()) {
  const auto tf = *tests::transfer_function(1);
  auto s = *tests::segment(1);
  s.length *= *rc::gen::element(1e-3, 1e-6, 1e-12);
  // exp(-depth) >= 1 - depth inside the integral
  const Color emission = integrate_emission(tf, s);
  const Color full = integrate_full(tf, s).color;
  RC_ASSERT((full <= (1 + 1e-14) * emission).all());
  RC_ASSERT((full >= (1 - 1e-14 - optical_depth(tf, s)) * emission).all());
}

RC_GTEST_PROP(SegmentIntegralProperty, MaxColorIsTheLargestOnTheWay, ()) {
  const auto tf = *tests::transfer_function();
  const auto s = *tests::segment();
  const Color largest = max_color(tf, s.front, s.back);
  Color sampled = tf.at(s.front).color.max(tf.at(s.back).color);
  for (int i = 1; i < 1000 && s.front != s.back; ++i) {
    const double value = s.front + (s.back - s.front) * i / 1000;
    sampled = sampled.max(tf.at(value).color).max(tf.below(value).color);
  }
  const auto [low, high] = std::minmax(s.front, s.back);
  for (const ControlPoint& p : tf.points()) {
    const bool inside = low < p.value && p.value < high;
    if (inside) sampled = sampled.max(p.color);
  }
  if (low < high) sampled = sampled.max(tf.below(high).color);
  RC_ASSERT((largest - sampled).abs().maxCoeff() <= 1e-15);
}

TEST(SegmentIntegral, NeverNanOrInfinite) {
  constexpr double kTiny = std::numeric_limits<double>::denorm_min();
  constexpr double kMost = std::numeric_limits<double>::max();
  const std::vector<double> numbers = {0, kTiny, 1e-310, 1, 1e30, kMost};
  std::vector<double> values = numbers;
  for (const double v : numbers) values.push_back(-v);
  for (const double width : {kTiny, 1e-310, 1.0, 1e30, kMost / 2}) {
    for (const double k0 : numbers) {
      for (const double k1 : numbers) {
        const TransferFunction tf(
            {{-width, kRed, k0}, {0, kRed, 0}, {0, kBlue, k0}, {width, kRed, k1}});
        for (const double front : values) {
          for (const double back : values) {
            for (const double length : numbers) {
              const Segment s{front, back, length};
              const Radiance r = integrate_full(tf, s);
              const Color emission = integrate_emission(tf, s);
              const bool right = r.color.isFinite().all() && (r.color >= 0).all() &&
                                 (r.color <= 1 + 1e-15).all() && r.transmittance >= 0 &&
                                 r.transmittance <= 1 && emission.isFinite().all() &&
                                 std::isfinite(optical_depth(tf, s)) &&
                                 max_color(tf, front, back).isFinite().all();
              ASSERT_TRUE(right) << s << " in " << tf << "gives " << r.color.transpose() << ", "
                                 << r.transmittance;
            }
          }
        }
      }
    }
  }
}

TEST(SegmentIntegral, ManyControlPoints) {
  std::vector<ControlPoint> points;
  for (int i = 0; i <= 800; ++i)
    points.push_back({i / 800.0, Color::Constant(i % 2), 50.0 * (i % 3)});
  const TransferFunction tf(points);
  for (const Segment& s : {Segment{0, 1, 1}, Segment{1, 0, 0.1}, Segment{-1, 2, 10}}) {
    const tests::Reference reference = tests::integrate_by_quadrature(tf, s, 1);
    EXPECT_NEAR(integrate_full(tf, s).color[0], static_cast<double>(reference.full[0]), kTolerance)
        << s;
  }
}

}  // namespace
}  // namespace tetraglass::preint
