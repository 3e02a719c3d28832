#include "project/compare.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/errors.h"

namespace tetraglass::project {
namespace {

TEST(Compare, FindsTheWorstPixelAndItsMeasures) {
  const Image a(4, 3);
  Image b(4, 3);
  b.pixel(2, 1)[3] = 0.5F;
  b.pixel(0, 0)[0] = -0.25F;
  const Difference difference = compare(a, b);
  EXPECT_EQ(difference.worst_x, 2);
  EXPECT_EQ(difference.worst_y, 1);
  EXPECT_DOUBLE_EQ(difference.max, 0.5);
  EXPECT_DOUBLE_EQ(difference.rms, std::sqrt((0.25 + 0.0625) / 48));
  EXPECT_DOUBLE_EQ(difference.psnr_db, -20 * std::log10(difference.rms));
  EXPECT_EQ(difference.pixels, 12U);
  EXPECT_FLOAT_EQ(difference_image(a, b, difference).pixel(0, 0)[0], 0.5F);
}

TEST(Compare, EqualPicturesHaveNoNoise) {
  const Image a(2, 2);
  EXPECT_EQ(compare(a, a).max, 0);
  EXPECT_TRUE(std::isinf(compare(a, a).psnr_db));
}

TEST(Compare, NotANumberIsInfinitelyFar) {
  const Image a(2, 2);
  Image b(2, 2);
  b.pixel(1, 1)[2] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(std::isinf(compare(a, b).max));
  EXPECT_EQ(compare(b, b).max, 0);
}

TEST(Compare, RefusesDifferentSizes) {
  EXPECT_THROW((void)compare(Image(2, 3), Image(3, 2)), base::InputError);
}

}  // namespace
}  // namespace tetraglass::project
