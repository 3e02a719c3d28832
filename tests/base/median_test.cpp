#include "base/median.h"

#include <gtest/gtest.h>

namespace tetraglass::tests {
namespace {

TEST(Median, IsTheMiddleWhateverTheOrder) {
  EXPECT_EQ(base::median({}), 0);
  EXPECT_EQ(base::median({3}), 3);
  EXPECT_EQ(base::median({5, 1, 4}), 4);
  EXPECT_EQ(base::median({4, 1, 5, 2}), 4);
}

}  // namespace
}  // namespace tetraglass::tests
