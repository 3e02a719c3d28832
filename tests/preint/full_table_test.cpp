#include <cmath>
#include <limits>
#include <mutex>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "base/errors.h"
#include "preint/segment_integral.h"
#include "preint/table.h"
#include "preint/table_entries.h"
#include "tests/preint/media.h"

namespace tetraglass::preint {
namespace {

struct NamedMedium {
  const char* name;
  TransferFunction tf;
  double low;
  double high;
};

std::vector<NamedMedium> media() {
  std::vector<ControlPoint> dense;
  for (int i = 0; i <= 150; ++i) {
    dense.push_back({i / 150.0, Color(0.5 + 0.5 * std::sin(i), i % 3 == 0, i / 150.0),
                     4.0 * (i % 7) * (i % 7)});
  }
  const Color red(1, 0, 0), blue(0.1, 0.2, 1);
  return {
      {"nothing", TransferFunction({{0, red, 0}}), -1, 1},
      {"constant", TransferFunction({{0, red, 3}}), -1, 1},
      {"ramp", TransferFunction({{0, red, 0}, {1, blue, 10}}), 0, 1},
      {"spike", TransferFunction({{0.49, red, 0}, {0.5, blue, 900}, {0.51, red, 0}}), 0, 1},
      {"narrow spike", TransferFunction({{0.5, red, 0}, {0.50001, blue, 1e6}, {0.50002, red, 0}}),
       0, 1},
      {"jumps",
       TransferFunction({{0.25, red, 0},
                         {0.25, blue, 40},
                         {0.5, red, 1},
                         {0.5, red, 0},
                         {0.77, red, 0},
                         {0.77, blue, 1e-30}}),
       0, 1},
      {"huge", TransferFunction({{0, red, 0}, {0.3, blue, 1e6}, {0.6, red, 1e6}, {0.6, blue, 0.5}}),
       0, 1},
      {"far from 0", TransferFunction({{1000, red, 0}, {1001, blue, 5}}), 999.5, 1001},
      {"dense", TransferFunction(dense), 0, 1},
  };
}

using MethodCase = testing::TestWithParam<TableMethod>;

INSTANTIATE_TEST_SUITE_P(FullTable, MethodCase,
                         testing::Values(TableMethod::incremental, TableMethod::brute_force),
                         [](const auto& method) {
                           return method.param == TableMethod::incremental ? "incremental"
                                                                           : "brute_force";
                         });

TEST_P(MethodCase, IsTheIntegralInDouble) {
  for (const NamedMedium& medium : media()) {
    for (const int n : {2, 3, 7, 33, 100}) {
      for (const double length : {0.0, 1e-8, 0.3, 20.0}) {
        SCOPED_TRACE(testing::Message() << medium.name << " n " << n << " length " << length);
        std::vector<int> written(static_cast<std::size_t>(n * n));
        double worst = 0;
        const auto check = [&](std::size_t, int f, int b, const LightSpan& span, int) {
          const double from = table_node(medium.low, medium.high, n, f);
          const double to = table_node(medium.low, medium.high, n, b);
          const Radiance r = integrate_full(medium.tf, {from, to, length});
          const double error =
              std::max((r.color - Color(span.red, span.green, span.blue)).abs().maxCoeff(),
                       std::abs(r.transmittance - span.transmittance));
          static std::mutex mutex;
          const std::lock_guard lock(mutex);
          ++written[static_cast<std::size_t>(b * n + f)];
          worst = std::max(worst, error);
        };
        table_entries<LightSpan>(medium.tf, medium.low, medium.high, n, {length}, kFinest,
                                 GetParam(), check);
        // The samples of the axis are rounded; the incremental form takes them for exactly equally
        // spaced. Lengths that are wrong by a relative delta change the light by at most delta
        // max(tau exp(-tau)) < delta.
        const double most = std::max(std::abs(medium.low), std::abs(medium.high));
        const double spacing = (medium.high - medium.low) / (n - 1);
        EXPECT_LE(worst, 1e-12 + 2 * std::numeric_limits<double>::epsilon() * most / spacing);
        for (const int times : written) ASSERT_EQ(times, 1);
      }
    }
  }
}

/// All entries in double, [back][front].
std::vector<LightSpan> spans(const TransferFunction& tf, int n, double length, TableMethod method) {
  std::vector<LightSpan> result(static_cast<std::size_t>(n * n));
  table_entries<LightSpan>(tf, -2, 2, n, {length}, kFinest, method,
                           [&](std::size_t, int f, int b, const LightSpan& span, int) {
                             result[static_cast<std::size_t>(b * n + f)] = span;
                           });
  return result;
}

RC_GTEST_PROP(FullTableProperty, IncrementalIsBruteForceOnRandomTransferFunctions, ()) {
  const auto tf = *tests::transfer_function();
  const int n = *rc::gen::inRange(2, 70);
  const double length = *rc::gen::element(1e-6, 0.1, 1.0, 30.0);
  const auto fast = spans(tf, n, length, TableMethod::incremental);
  const auto slow = spans(tf, n, length, TableMethod::brute_force);
  for (std::size_t i = 0; i < fast.size(); ++i) {
    RC_ASSERT(std::abs(fast[i].red - slow[i].red) <= 1e-12);
    RC_ASSERT(std::abs(fast[i].green - slow[i].green) <= 1e-12);
    RC_ASSERT(std::abs(fast[i].blue - slow[i].blue) <= 1e-12);
    RC_ASSERT(std::abs(fast[i].transmittance - slow[i].transmittance) <= 1e-12);
    RC_ASSERT(fast[i].transmittance >= 0 && fast[i].transmittance <= 1);
  }
  const auto in_float = slab_table(tf, -2, 2, length, n).rgba;
  for (std::size_t i = 0; i < fast.size(); ++i) {
    RC_ASSERT(std::abs(in_float[4 * i] - slow[i].red) <= 1e-5);
    RC_ASSERT(std::abs(in_float[4 * i + 3] - (1 - slow[i].transmittance)) <= 1e-5);
  }
}

TEST(FullTable, MethodsAgreeInFloat) {
  for (const NamedMedium& medium : media()) {
    SCOPED_TRACE(medium.name);
    const auto difference = [](const Entries& a, const Entries& b) {
      float worst = 0;
      for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
      return worst;
    };
    const auto slab = [&](TableMethod method) {
      return slab_table(medium.tf, medium.low, medium.high, 0.7, 61, method).rgba;
    };
    const auto full = [&](TableMethod method) {
      return full_table(medium.tf, medium.low, medium.high, 2, 23, 5, method).rgba;
    };
    ASSERT_EQ(slab(TableMethod::exact).size(), 4U * 61 * 61);
    ASSERT_EQ(full(TableMethod::exact).size(), 4U * 23 * 23 * 5);
    for (const auto method : {TableMethod::incremental, TableMethod::brute_force}) {
      EXPECT_LE(difference(slab(TableMethod::exact), slab(method)), 2e-7F);
      EXPECT_LE(difference(full(TableMethod::exact), full(method)), 2e-7F);
    }
  }
}

TEST(FullTable, EntriesOf3DAreTheIntegrals) {
  constexpr int kN = 9, kM = 5;
  constexpr double kLongest = 3;
  const NamedMedium medium = media()[5];
  const Table3D table = full_table(medium.tf, -1, 1, kLongest, kN, kM, TableMethod::exact);
  ASSERT_EQ(table.rgba.size(), 4U * kN * kN * kM);
  for (int l = 0; l < kM; ++l) {
    for (int b = 0; b < kN; ++b) {
      for (int f = 0; f < kN; ++f) {
        SCOPED_TRACE(testing::Message() << "front " << f << " back " << b << " length " << l);
        const Radiance r = integrate_full(
            medium.tf,
            {table_node(-1, 1, kN, f), table_node(-1, 1, kN, b), kLongest * l / (kM - 1)});
        const auto at = static_cast<std::size_t>(4 * ((l * kN + b) * kN + f));
        for (std::size_t c = 0; c < 3; ++c) {
          EXPECT_EQ(table.rgba[at + c], static_cast<float>(r.color[static_cast<long>(c)]));
        }
        EXPECT_EQ(table.rgba[at + 3], static_cast<float>(1 - r.transmittance));
      }
    }
  }
}

TEST(FullTable, RefusesWhatMakesNoTable) {
  const TransferFunction tf({{0, Color::Ones(), 1}});
  EXPECT_THROW(static_cast<void>(full_table(tf, 0, 1, 1, 8, 1)), base::UsageError);
  EXPECT_THROW(static_cast<void>(full_table(tf, 0, 1, 0, 8, 8)), base::UsageError);
  EXPECT_THROW(static_cast<void>(full_table(tf, 0, INFINITY, 1, 8, 8)), base::UsageError);
  EXPECT_THROW(static_cast<void>(slab_table(tf, 0, 1, -1, 8)), base::UsageError);
  EXPECT_THROW(static_cast<void>(slab_table(tf, 0, 1, 1, 1)), base::UsageError);
}

}  // namespace
}  // namespace tetraglass::preint
