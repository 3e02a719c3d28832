#include "sort/power_keys.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace tetraglass::sort {
namespace {

// Within the range of most powers, at its ends, and as far out as there are numbers.
TEST(PowerKeys, FallAsThePowerGrows) {
  std::vector<double> sample;
  for (int i = 0; i < 1000; ++i) sample.push_back(-3 + 0.01 * i);
  const PowerKeys keys(sample);
  std::vector<double> powers = {-std::numeric_limits<double>::max(), -1e200, -1e30};
  for (int exponent = 60; exponent >= -30; --exponent)
    powers.push_back(-3 - std::ldexp(1, exponent));
  for (int i = 0; i < 100000; ++i) powers.push_back(-3.5 + 1.1e-4 * i);
  for (int exponent = 4; exponent <= 60; ++exponent) powers.push_back(std::ldexp(1, exponent));
  powers.push_back(std::numeric_limits<double>::max());
  std::sort(powers.begin(), powers.end());
  powers.erase(std::unique(powers.begin(), powers.end()), powers.end());
  std::size_t equal = 0;
  for (std::size_t i = 1; i < powers.size(); ++i) {
    ASSERT_LT(powers[i - 1], powers[i]);
    ASSERT_GE(keys.key(powers[i - 1]), keys.key(powers[i])) << powers[i];
    equal += keys.key(powers[i - 1]) == keys.key(powers[i]) ? 1 : 0;
  }
  EXPECT_LT(equal, 30U);  // the very small and the very large steps
}

TEST(PowerKeys, OfOnePowerAreOneKey) {
  const PowerKeys keys(std::vector<double>(10, 2.5));
  EXPECT_EQ(keys.key(2.5), keys.key(2.5));
  EXPECT_EQ(PowerKeys({}).key(1), PowerKeys({}).key(2));
}

TEST(PowerKeys, AreCutOnlyWhereNoDoubtReaches) {
  std::vector<KeyRange> doubtful = {{90, 100}, {10, 20}, {15, 30}};
  join_overlapping(doubtful);
  ASSERT_EQ(doubtful.size(), 2U);
  EXPECT_EQ(doubtful[0].low, 10U);
  EXPECT_EQ(doubtful[0].high, 30U);
  CutFinder cuts(doubtful);
  EXPECT_TRUE(cuts.is_cut(3, 5));
  EXPECT_FALSE(cuts.is_cut(5, 6));    // next to each other
  EXPECT_TRUE(cuts.is_cut(6, 9));     // before the first range
  EXPECT_FALSE(cuts.is_cut(12, 18));  // both in it
  EXPECT_FALSE(cuts.is_cut(28, 30));
  EXPECT_TRUE(cuts.is_cut(30, 50));  // behind it
  EXPECT_FALSE(cuts.is_cut(90, 100));
  EXPECT_TRUE(cuts.is_cut(101, 103));
}

}  // namespace
}  // namespace tetraglass::sort
