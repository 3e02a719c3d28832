#include "base/stopwatch.h"

#include <chrono>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace tetraglass::base {
namespace {

TEST(Stopwatch, CountsMillisecondsSinceItsStart) {
  Stopwatch clock;
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const double first = clock.milliseconds();
  EXPECT_GE(first, 20);
  EXPECT_GE(clock.milliseconds(), first);
  clock.restart();
  EXPECT_LT(clock.milliseconds(), first);
}

TEST(PeakBytes, GrowWithTheMemoryInUse) {
  const std::uint64_t before = peak_bytes();
  EXPECT_GT(before, 0U);
  std::vector<char> block(before + 50'000'000, 1);
  EXPECT_EQ(block[block.size() / 2], 1);
  EXPECT_GE(peak_bytes(), before + 40'000'000);
}

}  // namespace
}  // namespace tetraglass::base
