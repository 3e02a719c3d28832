#include "sort/power_keys.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "sort/views.h"

namespace tetraglass::sort {
namespace {

using Eigen::Vector3d;

std::vector<std::uint32_t> items(std::size_t n) {
  std::vector<std::uint32_t> result(n);
  std::iota(result.begin(), result.end(), 100U);
  return result;
}

std::vector<PowerSphere> random_spheres(std::size_t n) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<PowerSphere> spheres(n);
  for (PowerSphere& sphere : spheres) {
    sphere.center = {unit(random), unit(random), unit(random)};
    sphere.constant = sphere.center.squaredNorm() - 0.1 * std::abs(unit(random));
    sphere.center_error = sphere.constant_error = 0x1p-45;
  }
  return spheres;
}

// In views that make little and much of the constants, and from afar.
TEST(KeyedSpheres, KeysFallAsPowersGrowButForTheirDoubt) {
  const std::vector<PowerSphere> spheres = random_spheres(20001);
  const KeyedSpheres keyed(spheres, std::sqrt(3), 0, items(spheres.size()));
  ASSERT_TRUE(keyed.far().empty());
  for (const View& view : {parallel({1, 2, 3}), parallel({0, 0, 1}), from({0.2, 0.1, 0}),
                           from({3, -4, 5}), from({1e9, 1e8, 0})}) {
    const PowerOfEye power(view, Vector3d::Zero());
    const KeyedSpheres::Keys keys = keyed.choose_keys(power);
    EXPECT_LT(keys.doubt, 32U);
    std::vector<KeyedItem> entries(spheres.size());
    keyed.write(keys, 0, entries.size(), entries.data());
    std::vector<std::uint32_t> order(spheres.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return power.of(spheres[a]) > power.of(spheres[b]);
    });
    std::uint32_t highest = 0;
    for (const std::uint32_t i : order) {
      EXPECT_EQ(item_of(entries[i]), i + 100);
      const std::uint32_t key = key_of(entries[i]);
      ASSERT_FALSE(highest > key && is_cut(keys, key, highest));
      const KeyRange range = doubtful_range(keys, power.of(spheres[i]), power.doubt(spheres[i]));
      ASSERT_LE(range.low, key);
      ASSERT_GE(range.high, key);
      ASSERT_LE(range.high - range.low, 4 * keys.doubt + 8);
      highest = std::max(highest, key);
    }
    EXPECT_GT(highest, 1U << 31);
  }
}

TEST(KeyedSpheres, SetApartWhatIsOutOfProportion) {
  std::vector<PowerSphere> spheres = random_spheres(10);
  spheres[2].center = {1e6, 0, 0};
  spheres[4].constant = -1e12;
  spheres[7].center_error = 1e-3;
  spheres[8].constant = std::numeric_limits<double>::infinity();
  const KeyedSpheres keyed(spheres, std::sqrt(3), 0, items(10));
  EXPECT_EQ(keyed.far(), (std::vector<std::uint32_t>{2, 4, 7, 8}));
  const PowerOfEye power(from({5, 0, 0}), Vector3d::Zero());
  const KeyedSpheres::Keys keys = keyed.choose_keys(power);
  constexpr std::uint32_t kLast = std::numeric_limits<std::uint32_t>::max();
  EXPECT_EQ(doubtful_range(keys, power.of(spheres[2]), 0).low, kLast);  // the nearest of all
  const KeyRange range = doubtful_range(keys, std::numeric_limits<double>::infinity(), 0);
  EXPECT_EQ(range.low, 0U);
  EXPECT_EQ(range.high, kLast);
}

TEST(KeyedSpheres, OfOnePowerAreNeverCut) {
  const std::vector<PowerSphere> spheres(3, random_spheres(1).front());
  const KeyedSpheres keyed(spheres, 2, 0, items(3));
  const KeyedSpheres::Keys keys = keyed.choose_keys(PowerOfEye(from({5, 0, 0}), Vector3d::Zero()));
  EXPECT_FALSE(is_cut(keys, 0, std::numeric_limits<std::uint32_t>::max()));
}

TEST(KeyRange, JoinedWhereTheyOverlap) {
  std::vector<KeyRange> ranges = {{90, 100}, {10, 20}, {15, 30}, {30, 31}};
  join_overlapping(ranges);
  ASSERT_EQ(ranges.size(), 2U);
  EXPECT_EQ(ranges[0].low, 10U);
  EXPECT_EQ(ranges[0].high, 31U);
  std::vector<sort::Run> runs = {{5, 7}, {1, 3}, {2, 4}, {4, 5}};
  join_overlapping(runs);
  ASSERT_EQ(runs.size(), 3U);
  EXPECT_EQ(runs[0].begin, 1U);
  EXPECT_EQ(runs[0].end, 4U);
}

}  // namespace
}  // namespace tetraglass::sort
