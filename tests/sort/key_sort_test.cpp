#include "sort/key_sort.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

namespace tetraglass::sort {
namespace {

// Items count up, so that among equal keys their order is the one in which they came.
void expect_sorted(const std::vector<std::uint32_t>& keys) {
  std::vector<KeyedItem> expected(keys.size());
  for (std::uint32_t i = 0; i < keys.size(); ++i) expected[i] = keyed(keys[i], i);
  std::stable_sort(expected.begin(), expected.end(),
                   [](KeyedItem a, KeyedItem b) { return key_of(a) < key_of(b); });
  std::vector<KeyedItem> taken(keys.size());
  KeySorter sorter;
  const auto sorted = sorter.sort(
      keys.size(),
      [&](std::size_t begin, std::size_t count, KeyedItem* target) {
        for (std::size_t i = begin; i < begin + count; ++i) {
          *target++ = keyed(keys[i], static_cast<std::uint32_t>(i));
        }
      },
      [&](std::span<const KeyedItem> entries, std::size_t place) {
        std::copy(entries.begin(), entries.end(),
                  taken.begin() + static_cast<std::ptrdiff_t>(place));
      });
  ASSERT_TRUE(std::equal(sorted.begin(), sorted.end(), expected.begin(), expected.end()));
  ASSERT_EQ(taken, expected);
}

// From nothing to more than a bucket's large digits and several threads; keys of all bits, of the
// highest and of the lowest ones only, a few, and one.
TEST(KeySort, AgreesWithTheStandardLibrarysStableSort) {
  std::mt19937 random(7);
  for (const std::size_t n : {0U, 1U, 2U, 31U, 33U, 1000U, 1025U, 40000U, 700000U}) {
    for (const std::uint32_t mask :
         {0xffffffffU, 0xff000000U, 0x00ffffffU, 0xfffU, 0x80000003U, 0x00fff000U, 0U}) {
      SCOPED_TRACE(testing::Message() << n << " keys of the bits " << mask);
      std::vector<std::uint32_t> keys(n);
      for (std::uint32_t& key : keys) key = static_cast<std::uint32_t>(random()) & mask;
      expect_sorted(keys);
    }
  }
}

}  // namespace
}  // namespace tetraglass::sort
