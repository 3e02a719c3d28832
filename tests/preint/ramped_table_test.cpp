#include "preint/ramped_table.h"

#include <cmath>
#include <mutex>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "preint/table_entries.h"
#include "tests/preint/media.h"

namespace tetraglass::preint {
namespace {

const TransferFunction kMedium({{0, {1, 0, 0.3}, 0, {0.1, 0.7, 0.2, 32}},
                                {0.4, {0.2, 1, 0}, 7, {0.3, 0.4, 0.9, 10}},
                                {0.4, {0, 0, 1}, 1, {0, 1, 0, 5}},
                                {0.41, {0, 0, 1}, 500, {0.5, 0.5, 0.5, 5}},
                                {0.42, {1, 1, 1}, 0},
                                {0.7, {0, 1, 0}, 0},
                                {1, {1, 0, 1}, 3}});

Eigen::Array4d entry(const Table2D& table, int front, int back) {
  return Eigen::Map<const Eigen::Array4f>(
             &table.rgba[static_cast<std::size_t>(4 * (back * table.n + front))])
      .cast<double>();
}

/// Sums over thin slabs as in the papers: light, light weighted by position, for any value along
/// the segment.
template <class Value>
std::pair<double, double> visible_sum(const TransferFunction& tf, const Segment& s,
                                      const Value& f) {
  constexpr int kSlabs = 40000;
  double sum = 0, ramped = 0, remaining = 1;
  for (int i = 0; i < kSlabs; ++i) {
    const double x = (i + 0.5) / kSlabs;
    const double value = s.front + x * (s.back - s.front);
    const double alpha = -std::expm1(-tf.at(value).extinction * s.length / kSlabs);
    sum += remaining * alpha * f(value);
    ramped += remaining * alpha * f(value) * x;
    remaining *= 1 - alpha;
  }
  return {sum, ramped};
}

constexpr double kSumTolerance =
    2e-4;  // slabs that straddle a jump: 500 / 40000 of their extinction

RC_GTEST_PROP(RampedIntegralProperty, FrontAndBackAreTheWhole, ()) {
  const auto tf = *tests::transfer_function();
  const auto s = *tests::segment();
  const RampedRadiance r = integrate_ramped(tf, s);
  const Radiance whole = integrate_full(tf, s);
  RC_ASSERT((r.front + r.back - whole.color).abs().maxCoeff() <= 1e-12);
  RC_ASSERT(std::abs(r.white_front + r.white_back + whole.transmittance - 1) <= 1e-12);
  RC_ASSERT((r.front >= 0).all() && (r.back >= 0).all());
  RC_ASSERT(r.transmittance == whole.transmittance);
}

TEST(RampedIntegral, MeetsSums) {
  for (const Segment& s : {Segment{0, 1, 1}, Segment{1, 0, 1}, Segment{0.1, 0.39, 4},
                           Segment{0.45, 0.3, 0.2}, Segment{0.8, 0.8, 2}}) {
    SCOPED_TRACE(testing::Message() << s);
    const RampedRadiance r = integrate_ramped(kMedium, s);
    for (int c = 0; c < 3; ++c) {
      const auto [sum, ramped] =
          visible_sum(kMedium, s, [&](double v) { return kMedium.at(v).color[c]; });
      EXPECT_NEAR(r.back[c], ramped, kSumTolerance);
      EXPECT_NEAR(r.front[c], sum - ramped, kSumTolerance);
    }
    const auto [white, ramped_white] = visible_sum(kMedium, s, [](double) { return 1; });
    EXPECT_NEAR(r.white_back, ramped_white, kSumTolerance);
    EXPECT_NEAR(r.white_front, white - ramped_white, kSumTolerance);
  }
}

TEST(RampedIntegral, ConstantMedium) {
  // int_0^1 a x exp(-a x) dx
  const TransferFunction tf({{0, Color::Ones(), 2}});
  for (const double a : {1e-3, 0.5, 3.0, 40.0}) {
    const double back = (1 - std::exp(-a) * (1 + a)) / a;
    EXPECT_NEAR(integrate_ramped(tf, {0, 1, a / 2}).white_back, back, 1e-13) << a;
    EXPECT_NEAR(integrate_ramped(tf, {1, 1, a / 2}).back[1], back, 1e-13) << a;
  }
}

using RampedMethod = testing::TestWithParam<TableMethod>;

INSTANTIATE_TEST_SUITE_P(RampedTables, RampedMethod,
                         testing::Values(TableMethod::incremental, TableMethod::brute_force),
                         [](const auto& method) {
                           return method.param == TableMethod::incremental ? "incremental"
                                                                           : "brute_force";
                         });

TEST_P(RampedMethod, IsTheIntegralInDouble) {
  for (const int n : {2, 3, 7, 100}) {
    for (const double length : {0.0, 1e-10, 0.3, 20.0}) {
      SCOPED_TRACE(testing::Message() << "n " << n << " length " << length);
      double worst = 0, worst_relative = 0;
      std::mutex mutex;
      table_entries<RampedSpan>(
          kMedium, 0, 1, n, {length}, kFinest, GetParam(),
          [&](std::size_t, int f, int b, const RampedSpan& span, int cells) {
            const Segment s{table_node(0, 1, n, f), table_node(0, 1, n, b), length};
            const RampedRadiance r = integrate_ramped(kMedium, s);
            const Color back(span.ramped_red, span.ramped_green, span.ramped_blue);
            const Color whole(span.red, span.green, span.blue);
            const double white = span.ramped_white / cells;
            const std::lock_guard lock(mutex);
            worst = std::max({worst, (back / cells - r.back).abs().maxCoeff(),
                              (whole - r.front - r.back).abs().maxCoeff(),
                              std::abs(white - r.white_back),
                              std::abs(span.opacity - r.white_front - r.white_back)});
            if (white > 0) {
              worst_relative = std::max(worst_relative, std::abs(white - r.white_back) / white);
            }
          });
      EXPECT_LE(worst, 1e-12);
      // Short ranges far from the origin, and thin ones, cancel nowhere.
      EXPECT_LE(worst_relative, 1e-10);
    }
  }
}

TEST(RampedTables, PackedAsInThePaper) {
  constexpr int kN = 41;
  constexpr double kLength = 0.8;
  const RampedTables fast = ramped_tables(kMedium, 0, 1, kLength, kN);
  const RampedTables slow = ramped_tables(kMedium, 0, 1, kLength, kN, TableMethod::brute_force);
  const Table2D whole = slab_table(kMedium, 0, 1, kLength, kN);
  for (int b = 0; b < kN; ++b) {
    for (int f = 0; f < kN; ++f) {
      SCOPED_TRACE(testing::Message() << "front " << f << " back " << b);
      const RampedRadiance r =
          integrate_ramped(kMedium, {table_node(0, 1, kN, f), table_node(0, 1, kN, b), kLength});
      const Eigen::Array4d front = entry(fast.front, f, b), back = entry(fast.back, f, b);
      EXPECT_LE((front.head<3>() - r.front).abs().maxCoeff(), 1e-7);
      EXPECT_LE((back.head<3>() - r.back).abs().maxCoeff(), 1e-7);
      EXPECT_NEAR(front[3], 1 - r.transmittance, 1e-7);
      EXPECT_NEAR(back[3], r.white_back, 1e-7);
      EXPECT_LE((front.head<3>() + back.head<3>() - entry(whole, f, b).head<3>()).abs().maxCoeff(),
                2e-7);
      EXPECT_LE((entry(slow.front, f, b) - front).abs().maxCoeff(), 1e-7);
      EXPECT_LE((entry(slow.back, f, b) - back).abs().maxCoeff(), 1e-7);
    }
  }
}

TEST(MaterialTable, MeetsTheNormalizedSums) {
  constexpr int kN = 6;
  constexpr double kLength = 1.3;
  const Table2D table = material_table(kMedium, 0, 1, kLength, kN);
  const Table2D slow = material_table(kMedium, 0, 1, kLength, kN, TableMethod::brute_force);
  for (int b = 0; b < kN; ++b) {
    for (int f = 0; f < kN; ++f) {
      SCOPED_TRACE(testing::Message() << "front " << f << " back " << b);
      const Segment s{table_node(0, 1, kN, f), table_node(0, 1, kN, b), kLength};
      const Eigen::Array4d e = entry(table, f, b);
      EXPECT_LE((e - entry(slow, f, b)).abs().maxCoeff(), 1e-6);
      const auto [opacity, position] = visible_sum(kMedium, s, [](double) { return 1; });
      if (opacity < 1e-6) continue;
      const auto mean = [&](auto coefficient) {
        return visible_sum(kMedium, s,
                           [&](double v) { return kMedium.material_at(v).*coefficient; })
                   .first /
               opacity;
      };
      EXPECT_NEAR(e[0], mean(&Material::ambient), 1e-3);
      EXPECT_NEAR(e[1], mean(&Material::diffuse), 1e-3);
      EXPECT_NEAR(e[2], mean(&Material::specular), 1e-3);
      EXPECT_NEAR(e[3], position / opacity, 1e-3);
    }
  }
}

TEST(RampedTables, SlicesOf3DAreTablesOfOneLength) {
  constexpr int kN = 13, kM = 5;
  for (const auto axis : {LengthAxis::linear, LengthAxis::logarithmic}) {
    for (const auto method :
         {TableMethod::incremental, TableMethod::brute_force, TableMethod::exact}) {
      const RampedTables3D tables = ramped_tables_3d(kMedium, 0, 1, 2, kN, kM, method, axis);
      const Table3D materials = material_table_3d(kMedium, 0, 1, 2, kN, kM, method, axis);
      for (int l = 1; l < kM; ++l) {
        const double length = length_at(axis, 2, kM, l);
        const RampedTables slice = ramped_tables(kMedium, 0, 1, length, kN);
        const Table2D material = material_table(kMedium, 0, 1, length, kN);
        for (std::size_t i = 0; i < slice.front.rgba.size(); ++i) {
          const std::size_t at = static_cast<std::size_t>(l) * slice.front.rgba.size() + i;
          ASSERT_NEAR(tables.front.rgba[at], slice.front.rgba[i], 2e-7);
          ASSERT_NEAR(tables.back.rgba[at], slice.back.rgba[i], 2e-7);
          ASSERT_NEAR(materials.rgba[at], material.rgba[i], 1e-6);
        }
      }
    }
  }
}

TEST(MaterialTable, LengthZeroIsTheLimitOfShortSegments) {
  const Table3D table = material_table_3d(kMedium, 0, 1, 1, 9, 3);
  const Table2D thin = material_table(kMedium, 0, 1, 1e-9, 9);
  for (std::size_t i = 0; i < thin.rgba.size(); ++i) {
    ASSERT_NEAR(table.rgba[i], thin.rgba[i], 1e-6) << i;
  }
}

RC_GTEST_PROP(RampedIntegralProperty, WeightsOfAConstantMedium, ()) {
  // Back weight: int_0^1 a x exp(-a x) dx / (1 - exp(-a)): 1/2 in the thin limit.
  const double a = std::pow(10.0, -6 + 8 * *tests::unit());
  const TransferFunction tf({{0, Color::Ones(), a}});
  const RampedRadiance r = integrate_ramped(tf, {0, 1, 1});
  const double weight = r.white_back / (r.white_front + r.white_back);
  RC_ASSERT(weight >= 0 && weight <= 0.5 + 1e-15);
  const long double exact =
      1 / static_cast<long double>(a) - 1 / std::expm1(static_cast<long double>(a));
  RC_ASSERT(std::abs(weight - static_cast<double>(exact)) <= 1e-12);
}

TEST(MaterialTable, ThinAndTransparentSegments) {
  // Thin: the mean position of the extinction itself. A ramp of the extinction from 0: 2/3;
  // downwards 1/3.
  const TransferFunction ramp({{0, Color::Ones(), 0}, {1, Color::Ones(), 1}});
  for (const auto method : {TableMethod::incremental, TableMethod::brute_force}) {
    for (const double length : {1e-6, 1e-100, 1e-200}) {
      const Table2D thin = material_table(ramp, 0, 1, length, 8, method);
      EXPECT_NEAR(entry(thin, 0, 7)[3], 2.0 / 3, 1e-6) << length;
      EXPECT_NEAR(entry(thin, 7, 0)[3], 1.0 / 3, 1e-6) << length;
      EXPECT_NEAR(entry(thin, 3, 3)[3], 0.5, 1e-6) << length;
    }
    const Table2D nothing =
        material_table(TransferFunction({{0, Color::Ones(), 0, {0.2, 0, 0, 1}},
                                         {1, Color::Ones(), 0, {0.4, 1, 0, 1}}}),
                       0, 1, 1, 3, method);
    EXPECT_TRUE((entry(nothing, 0, 2) - Eigen::Array4d(0.3, 0.5, 0, 0.5)).abs().maxCoeff() < 1e-7);
  }
  // One opaque isosurface: its gradient, wherever it lies.
  const TransferFunction spike(
      {{0.6, {1, 1, 1}, 0}, {0.6001, {1, 1, 1}, 1e7}, {0.6002, {1, 1, 1}, 0}});
  EXPECT_NEAR(entry(material_table(spike, 0, 1, 1, 3), 0, 2)[3], 0.6, 1e-3);
  EXPECT_NEAR(entry(material_table(spike, 0, 1, 1, 3), 2, 0)[3], 0.4, 1e-3);
}

}  // namespace
}  // namespace tetraglass::preint
