#include "preint/transfer_function_edit.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "preint/segment_integral.h"

namespace tetraglass::preint {
namespace {

const Color kRed(1, 0, 0);
const Color kBlue(0, 0, 1);

TEST(TransferFunctionEdit, ScalesExtinctionOnly) {
  const TransferFunction tf({{0, kRed, 1}, {1, kBlue, 3}});
  const TransferFunction scaled = scale_extinction(tf, 2.5);
  EXPECT_EQ(scaled.at(0.5).extinction, 5);
  EXPECT_TRUE((scaled.at(0.5).color == tf.at(0.5).color).all());
  EXPECT_THROW(static_cast<void>(scale_extinction(tf, -1)), base::UsageError);
  EXPECT_THROW(static_cast<void>(scale_extinction(tf, NAN)), base::UsageError);
}

TEST(TransferFunctionEdit, ExtinctionOfAnother) {
  const TransferFunction colors(
      {{0, kRed, 9, {1, 0, 0, 1}}, {1, kBlue, 9}, {1, kRed, 9, {0, 1, 0, 1}}, {3, kBlue, 9}});
  const TransferFunction extinction({{-1, kRed, 1}, {0, kRed, 4}, {0, kRed, 2}, {2, kRed, 6}});
  const TransferFunction both = with_extinction_of(colors, extinction);
  for (double v = -2; v <= 4; v += 0.25) {
    EXPECT_EQ(both.at(v).extinction, extinction.at(v).extinction) << v;
    EXPECT_EQ(both.below(v).extinction, extinction.below(v).extinction) << v;
    EXPECT_LE((both.at(v).color - colors.at(v).color).abs().maxCoeff(), 1e-15) << v;
    EXPECT_LE((both.below(v).color - colors.below(v).color).abs().maxCoeff(), 1e-15) << v;
    EXPECT_NEAR(both.material_at(v).diffuse, colors.material_at(v).diffuse, 1e-15) << v;
  }
}

TEST(TransferFunctionEdit, LogarithmicValues) {
  const TransferFunction tf({{0.01, kRed, 0, {0, 0, 0, 1}},
                             {400, kBlue, 6},
                             {400, kRed, 1},
                             {1000, kBlue, 2, {1, 1, 1, 2}}});
  const TransferFunction logarithmic = with_logarithmic_values(tf);
  EXPECT_EQ(logarithmic.points().front().value, 0.01);
  EXPECT_EQ(logarithmic.points().back().value, 1000);
  for (double v = 0.01; v < 1000; v *= 1.0173) {
    const double place = 0.01 + (1000 - 0.01) * std::log(v / 0.01) / std::log(1e5);
    const Medium expected = tf.at(place), found = logarithmic.at(v);
    EXPECT_NEAR(found.extinction, expected.extinction, 6.0 / 1024) << v;
    EXPECT_LE((found.color - expected.color).abs().maxCoeff(), 1.0 / 1024) << v;
  }
  const double jump = 0.01 * std::pow(1e5, (400 - 0.01) / (1000 - 0.01));
  EXPECT_NEAR(logarithmic.at(jump * (1 - 1e-12)).extinction, 6, 1e-6);
  EXPECT_NEAR(logarithmic.at(jump * (1 + 1e-12)).extinction, 1, 1e-6);
  EXPECT_THROW(
      static_cast<void>(with_logarithmic_values(TransferFunction({{0, kRed, 1}, {1, kRed, 1}}))),
      base::InputError);
  EXPECT_EQ(with_logarithmic_values(TransferFunction({{3, kRed, 1}})).points().size(), 1U);
}

TEST(TransferFunctionEdit, TentsAreAsOpaqueAsAsked) {
  constexpr double kDiagonal = 12;
  for (const double opacity : {0.0, 0.3, 0.9}) {
    // The second and third are closer than their width.
    const TransferFunction tf = tents({7, 2, 7.1, 2}, 0.4, opacity, "viridis", 0, 10, kDiagonal);
    EXPECT_EQ(tf.points().size(), 9U);
    for (const auto& [low, high] : {std::pair{0.0, 5.0}, {5.0, 7.05}, {7.05, 10.0}}) {
      const double length = kDiagonal * (high - low) / 10;
      EXPECT_NEAR(integrate_full(tf, {low, high, length}).transmittance, 1 - opacity, 1e-12) << low;
    }
    EXPECT_EQ(tf.at(5).extinction, 0);
    EXPECT_EQ(tf.at(0).extinction, 0);
    EXPECT_TRUE((tf.at(2).color - preset("viridis", 0, 10, 1).at(2).color).abs().maxCoeff() <
                1e-15);
  }
  EXPECT_THROW(static_cast<void>(tents({}, 1, 0.5, "grey", 0, 1, 1)), base::UsageError);
  EXPECT_THROW(static_cast<void>(tents({1}, 0, 0.5, "grey", 0, 1, 1)), base::UsageError);
  EXPECT_THROW(static_cast<void>(tents({1}, 1, 1, "grey", 0, 1, 1)), base::UsageError);
  EXPECT_THROW(static_cast<void>(tents({1}, 1, 0.5, "gray?", 0, 1, 1)), base::UsageError);
}

TEST(TransferFunctionEdit, HistogramCountsWhatIsInside) {
  const std::vector<double> values = {0, 0.1, 0.5, 0.99, 1, -0.1, 1.1, NAN};
  EXPECT_EQ(histogram(values, 0, 1, 2).counts, (std::vector<std::uint64_t>{2, 3}));
  EXPECT_THROW(static_cast<void>(histogram(values, 1, 1, 2)), base::UsageError);
  EXPECT_THROW(static_cast<void>(histogram(values, 0, 1, 0)), base::UsageError);
}

TEST(TransferFunctionEdit, AutomaticExtinctionShowsTheRare) {
  const TransferFunction tf({{0, kRed, 7}, {0.3, kBlue, 7}, {0.3, kRed, 7}, {1, kBlue, 7}});
  const Histogram cold{0, 1, {900, 60, 30, 10}};
  constexpr double kDepth = 1.5, kDiagonal = 20;
  const TransferFunction result = automatic_extinction(tf, cold, kDepth, kDiagonal);
  EXPECT_GT(result.at(0.875).extinction, 3 * result.at(0.125).extinction);
  double depth = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    depth += static_cast<double>(cold.counts[i]) / 1000 * kDiagonal *
             result.at((static_cast<double>(i) + 0.5) / 4).extinction;
  }
  EXPECT_NEAR(depth, kDepth, 1e-12);
  for (double v = -0.2; v < 1.2; v += 0.01) {
    EXPECT_LE((result.at(v).color - tf.at(v).color).abs().maxCoeff(), 1e-12) << v;
  }
  EXPECT_THROW(static_cast<void>(automatic_extinction(tf, {0, 1, {0, 0}}, 1, 1)), base::InputError);
  EXPECT_THROW(static_cast<void>(automatic_extinction(tf, cold, 0, 1)), base::UsageError);
}

}  // namespace
}  // namespace tetraglass::preint
