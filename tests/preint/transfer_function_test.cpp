#include "preint/transfer_function.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "base/errors.h"
#include "tests/preint/media.h"

namespace tetraglass::preint {
namespace {

using testing::HasSubstr;

const Color kRed(1, 0, 0);
const Color kBlue(0, 0, 1);

template <class Call>
std::string input_error(const Call& call) {
  try {
    call();
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "no InputError";
}

TEST(TransferFunction, LinearBetweenConstantBeyond) {
  const TransferFunction tf({{1, kRed, 2}, {3, kBlue, 6}});
  EXPECT_EQ(tf.at(-5).extinction, 2);
  EXPECT_EQ(tf.at(1).extinction, 2);
  EXPECT_EQ(tf.at(2).extinction, 4);
  EXPECT_TRUE((tf.at(2).color == Color(0.5, 0, 0.5)).all());
  EXPECT_EQ(tf.at(3).extinction, 6);
  EXPECT_EQ(tf.at(9).extinction, 6);
  EXPECT_EQ(tf.below(2).extinction, 4);
}

TEST(TransferFunction, AJumpHasTheUpperValue) {
  const TransferFunction tf({{0, kRed, 1}, {1, kRed, 2}, {1, kBlue, 7}, {2, kBlue, 7}});
  EXPECT_EQ(tf.at(1).extinction, 7);
  EXPECT_EQ(tf.below(1).extinction, 2);
  EXPECT_EQ(tf.max_extinction(0, std::nextafter(1.0, 0.0)), 2 - std::pow(2.0, -53));
  EXPECT_EQ(tf.max_extinction(0, 1), 7);
  const TransferFunction down({{0, kRed, 9}, {0, kRed, 1}});
  EXPECT_EQ(down.max_extinction(0, 1), 1);
  EXPECT_EQ(down.max_extinction(-1, 0), 9);
  EXPECT_EQ(down.max_extinction(0, 0), 1);
}

TEST(TransferFunction, FallingToZeroKeepsRelativeAccuracy) {
  const TransferFunction tf({{-1, kRed, 1e6}, {1, kRed, 0}});
  const double near = 1 - 0x1p-40;
  EXPECT_EQ(tf.at(near).extinction, 1e6 * 0x1p-41);
}

RC_GTEST_PROP(TransferFunctionProperty, MaxExtinctionBoundsTheRange, ()) {
  const auto tf = *tests::transfer_function();
  double low = *tests::field_value(), high = *tests::field_value();
  const double bound = tf.max_extinction(low, high);
  if (low > high) std::swap(low, high);
  double sampled = tf.at(low).extinction;
  for (int i = 1; i <= 1000; ++i) {
    const double value = i == 1000 ? high : low + (high - low) * i / 1000;
    sampled = std::max(sampled, tf.at(value).extinction);
    if (low < high) sampled = std::max(sampled, tf.below(value).extinction);
  }
  RC_ASSERT(bound >= sampled * (1 - 1e-15));
  // ... and is reached: it is the extinction of an end or of a point between.
  bool reached = bound == tf.at(low).extinction || bound == tf.at(high).extinction;
  for (const ControlPoint& p : tf.points()) {
    reached = reached || (low < p.value && p.value <= high && bound == p.extinction);
  }
  RC_ASSERT(reached);
}

TEST(TransferFunction, ErrorsNameThePoint) {
  const double nan = std::nan("");
  EXPECT_THAT(input_error([] { TransferFunction tf({}); }), HasSubstr("at least one point"));
  EXPECT_THAT(input_error([] {
                TransferFunction tf({{1, kRed, 0}, {0, kRed, 0}});
              }),
              HasSubstr("points[1]: values must not decrease"));
  EXPECT_THAT(input_error([] {
                TransferFunction tf({{1, kRed, 0}, {1, kRed, 0}, {1, kRed, 0}});
              }),
              HasSubstr("points[2]: at most two"));
  EXPECT_THAT(input_error([] {
                TransferFunction tf({{0, kRed, -1}});
              }),
              HasSubstr("points[0]: extinction must not be negative"));
  EXPECT_THAT(input_error([&] {
                TransferFunction tf({{0, kRed, 1}, {nan, kRed, 1}});
              }),
              HasSubstr("points[1]"));
  EXPECT_THAT(input_error([&] {
                TransferFunction tf({{0, Color(0, nan, 0), 1}});
              }),
              HasSubstr("points[0]"));
  EXPECT_THAT(input_error([] {
                TransferFunction tf({{-1e308, kRed, 1}, {1e308, kRed, 1}});
              }),
              HasSubstr("span more than"));
}

}  // namespace
}  // namespace tetraglass::preint
