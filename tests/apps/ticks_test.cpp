#include "apps/ticks.h"

#include <cmath>

#include <gtest/gtest.h>

namespace tetraglass::apps {
namespace {

using Labels = std::vector<std::string>;

TEST(TicksTest, StepsAreOneTwoOrFive) {
  EXPECT_EQ(linear_ticks(0, 1, 6).labels, (Labels{"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
  EXPECT_EQ(linear_ticks(-3, 7, 6).labels, (Labels{"\u22122", "0", "2", "4", "6"}));
  EXPECT_EQ(linear_ticks(293.15, 873.15, 7).labels,
            (Labels{"300", "400", "500", "600", "700", "800"}));
}

TEST(TicksTest, LargeAndSmallNumbersShareAPowerOfTen) {
  const Ticks large = linear_ticks(0, 2.1e8, 5);
  EXPECT_EQ(large.exponent, 8);
  EXPECT_EQ(large.labels, (Labels{"0.0", "0.5", "1.0", "1.5", "2.0"}));
  const Ticks small = linear_ticks(0, 3e-6, 4);
  EXPECT_EQ(small.exponent, -6);
  EXPECT_EQ(small.labels, (Labels{"0", "1", "2", "3"}));
  EXPECT_EQ(linear_ticks(99990, 100010, 5).labels,
            (Labels{"0.99990", "0.99995", "1.00000", "1.00005", "1.00010"}));
}

// Whatever the range: no more ticks than asked for, ascending, in the range, at least one.
TEST(TicksTest, HoldForAllRanges) {
  for (const double low : {-1e300, -7.3, -1e-12, 0.0, 1e-300, 0.1, 3.0, 1e15}) {
    for (const double span : {0.0, 1e-14, 1e-3, 0.7, 1.0, 12.5, 9.99e6, 1e300}) {
      for (const int most : {2, 5, 10}) {
        const double high = low + span;
        const Ticks ticks = linear_ticks(low, high, most);
        ASSERT_FALSE(ticks.values.empty()) << low << ' ' << span;
        ASSERT_EQ(ticks.values.size(), ticks.labels.size());
        ASSERT_LE(static_cast<int>(ticks.values.size()), most) << low << ' ' << span;
        for (std::size_t i = 0; i < ticks.values.size(); ++i) {
          ASSERT_TRUE(ticks.values[i] >= low && ticks.values[i] <= high) << low << ' ' << span;
          ASSERT_LT(ticks.labels[i].size(), 30U) << ticks.labels[i];
          if (i > 0) ASSERT_LT(ticks.values[i - 1], ticks.values[i]);
        }
      }
    }
  }
}

TEST(TicksTest, LogarithmicScalesMarkPowersOfTen) {
  EXPECT_EQ(logarithmic_ticks(1, 1000, 7).labels, (Labels{"1", "10", "100", "1000"}));
  EXPECT_EQ(logarithmic_ticks(1, 100, 7).labels, (Labels{"1", "2", "5", "10", "20", "50", "100"}));
  EXPECT_EQ(logarithmic_ticks(1e-12, 1e12, 5).values.size(), 5U);
  EXPECT_EQ(logarithmic_ticks(3e-8, 4e-6, 7).labels,
            (Labels{"5·10⁻⁸", "10⁻⁷", "2·10⁻⁷", "5·10⁻⁷", "10⁻⁶", "2·10⁻⁶"}));
  EXPECT_EQ(logarithmic_ticks(3, 4, 5).labels, linear_ticks(3, 4, 5).labels);
}

TEST(TicksTest, NumbersAreWrittenForPeople) {
  EXPECT_EQ(number_text(-0.5), "\u22120.5");
  EXPECT_EQ(number_text(0.1 + 0.2), "0.3");
  EXPECT_EQ(number_text(1.5e-9), "1.5·10⁻⁹");
  EXPECT_EQ(number_text(-0.0), "0");
}

}  // namespace
}  // namespace tetraglass::apps
