#include "preint/table.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "base/errors.h"
#include "preint/segment_integral.h"
#include "tests/preint/media.h"

namespace tetraglass::preint {
namespace {

const TransferFunction kMedium({{-1, {1, 0, 0}, 0},
                                {0, {0, 1, 0.5}, 3},
                                {0.2, {0, 0, 1}, 100},
                                {0.2, {1, 1, 0}, 0},
                                {1, {0.5, 0.5, 1}, 1}});

TEST(Table, NodesMeetBothEnds) {
  for (const int n : {2, 3, 7, 256}) {
    EXPECT_EQ(table_node(-0.3, 1.7, n, 0), -0.3);
    EXPECT_EQ(table_node(-0.3, 1.7, n, n - 1), 1.7);
  }
  EXPECT_EQ(table_node(0, 2, 3, 1), 1);
}

TEST(Table, EntriesOf2DAreTheIntegrals) {
  constexpr int kN = 23;
  const Table2D emission = emission_table(kMedium, -1.5, 1.2, kN, TableMethod::exact);
  const Table2D mip = mip_table(kMedium, -1.5, 1.2, kN, TableMethod::exact);
  ASSERT_EQ(emission.rgba.size(), 4U * kN * kN);
  for (int b = 0; b < kN; ++b) {
    for (int f = 0; f < kN; ++f) {
      SCOPED_TRACE(testing::Message() << "front " << f << " back " << b);
      const double front = table_node(-1.5, 1.2, kN, f), back = table_node(-1.5, 1.2, kN, b);
      const auto at = static_cast<std::size_t>(4 * (b * kN + f));
      const Color light = integrate_emission(kMedium, {front, back, 1});
      const Color largest = max_color(kMedium, front, back);
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_EQ(emission.rgba[at + c], static_cast<float>(light[static_cast<long>(c)]));
        EXPECT_EQ(mip.rgba[at + c], static_cast<float>(largest[static_cast<long>(c)]));
      }
      EXPECT_EQ(emission.rgba[at + 3],
                static_cast<float>(optical_depth(kMedium, {front, back, 1})));
      EXPECT_EQ(mip.rgba[at + 3], 1);
    }
  }
}

TEST(Table, MethodsAgree) {
  for (const int n : {2, 3, 22, 100}) {
    // 0.2, where a jump lies, is a sample for n = 22.
    for (const auto& [low, high] : {std::pair{-1.5, 1.2}, {-1.9, 2.3}, {5.0, 6.0}}) {
      SCOPED_TRACE(testing::Message() << "n " << n << " from " << low << " to " << high);
      const Table2D exact = emission_table(kMedium, low, high, n, TableMethod::exact);
      for (const auto method : {TableMethod::incremental, TableMethod::brute_force}) {
        const Table2D emission = emission_table(kMedium, low, high, n, method);
        for (std::size_t i = 0; i < exact.rgba.size(); ++i) {
          ASSERT_NEAR(emission.rgba[i], exact.rgba[i], 2e-7 * exact.rgba[i]) << i;
        }
        EXPECT_EQ(mip_table(kMedium, low, high, n, method).rgba,
                  mip_table(kMedium, low, high, n, TableMethod::exact).rgba);
      }
    }
  }
}

TEST(Table, IsosurfacesAreCompositedNearestFirst) {
  const std::vector<Isosurface> surfaces = {{0.25, {1, 0, 0}, 0.5}, {0.75, {0, 0, 1}, 1}};
  const Table2D table = iso_table(surfaces, 0, 1, 3);  // nodes 0, 1/2, 1
  const auto entry = [&](int f, int b) {
    return Eigen::Map<const Eigen::Array4f>(&table.rgba[static_cast<std::size_t>(4 * (b * 3 + f))]);
  };
  EXPECT_TRUE((entry(0, 0) == 0).all());
  EXPECT_TRUE((entry(0, 1) == Eigen::Array4f(0.5F, 0, 0, 0.5F)).all());
  EXPECT_TRUE((entry(1, 0) == Eigen::Array4f(0.5F, 0, 0, 0.5F)).all());
  EXPECT_TRUE((entry(0, 2) == Eigen::Array4f(0.5F, 0, 0.5F, 1)).all());
  EXPECT_TRUE((entry(2, 0) == Eigen::Array4f(0, 0, 1, 1)).all());
  EXPECT_TRUE((entry(1, 2) == Eigen::Array4f(0, 0, 1, 1)).all());
}

RC_GTEST_PROP(TableProperty, IsosurfacesAreThoseThatEachSegmentCrosses, ()) {
  const auto values = *rc::gen::container<std::vector<double>>(*rc::gen::inRange<std::size_t>(0, 6),
                                                               tests::field_value());
  std::vector<Isosurface> surfaces;
  for (const double v : values) {
    surfaces.push_back({v, Color(*tests::unit(), *tests::unit(), *tests::unit()), *tests::unit()});
  }
  const int n = *rc::gen::inRange(2, 20);
  const double thickening = *rc::gen::element(0.0, 0.25, 0.3);
  const Table2D fast = iso_table(surfaces, -2, 2, n, thickening);
  const Table2D slow = iso_table(surfaces, -2, 2, n, thickening, TableMethod::brute_force);
  RC_ASSERT(fast.rgba == slow.rgba);
  for (int f = 0; f < n && thickening == 0; ++f) {
    for (int b = 0; b < n; ++b) {
      Color color = Color::Zero();
      double transmittance = 1;
      for (const std::size_t i :
           crossed(surfaces, table_node(-2, 2, n, f), table_node(-2, 2, n, b))) {
        color += transmittance * surfaces[i].opacity * surfaces[i].color;
        transmittance *= 1 - surfaces[i].opacity;
      }
      const auto at = static_cast<std::size_t>(4 * (b * n + f));
      RC_ASSERT(std::abs(fast.rgba[at] - color[0]) <= 1e-7);
      RC_ASSERT(std::abs(fast.rgba[at + 3] - (1 - transmittance)) <= 1e-7);
    }
  }
}

TEST(Table, ThickenedIsosurfacesLeaveNoGap) {
  const Table2D table = iso_table({{0.5, Color::Ones(), 1}}, 0, 1, 11, 0.1);
  const auto opacity = [&](int f, int b) {
    return table.rgba[static_cast<std::size_t>(4 * (b * 11 + f) + 3)];
  };
  EXPECT_EQ(opacity(5, 5), 1);  // half open: no crossing
  EXPECT_EQ(opacity(4, 4), 1);
  EXPECT_EQ(opacity(6, 9), 1);
  EXPECT_EQ(opacity(7, 9), 0);
  EXPECT_EQ(opacity(3, 0), 0);
  EXPECT_THROW(static_cast<void>(iso_table({}, 0, 1, 4, -1)), base::UsageError);
}

TEST(Table, MaximumOfTheField) {
  const Table2D table = mip_table(kMedium, -1, 1, 11, TableMethod::incremental, MipOf::field);
  for (int f = 0; f < 11; ++f) {
    for (int b = 0; b < 11; ++b) {
      const Color expected = kMedium.at(table_node(-1, 1, 11, std::max(f, b))).color;
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_EQ(table.rgba[static_cast<std::size_t>(4 * (b * 11 + f)) + c],
                  static_cast<float>(expected[static_cast<long>(c)]));
      }
    }
  }
}

TEST(Table, RefusesWhatMakesNoTable) {
  EXPECT_THROW(static_cast<void>(emission_table(kMedium, 0, 1, 1)), base::UsageError);
  EXPECT_THROW(static_cast<void>(mip_table(kMedium, 1, 1, 8)), base::UsageError);
  EXPECT_THROW(static_cast<void>(iso_table({}, 1, 0, 8)), base::UsageError);
}

}  // namespace
}  // namespace tetraglass::preint
