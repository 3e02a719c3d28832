#include "preint/table_error.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "preint/segment_integral.h"

namespace tetraglass::preint {
namespace {

const TransferFunction kSmooth({{0, {1, 0, 0}, 0}, {0.5, {0, 1, 0.5}, 3}, {1, {0, 0, 1}, 1}});

TEST(TableLookup, IsTheEntryAtASampleAndLinearBetween) {
  const Table3D table = full_table(kSmooth, 0, 1, 4, 9, 5);
  const Lookup at = lookup(table, 0.25, 0.75, 2);
  EXPECT_FALSE(at.clamped);
  const Radiance r = integrate_full(kSmooth, {0.25, 0.75, 2});
  EXPECT_LE((at.rgba.head<3>() - r.color).abs().maxCoeff(), 1e-7);
  EXPECT_NEAR(at.rgba[3], 1 - r.transmittance, 1e-7);
  const Eigen::Array4d between = lookup(table, 0.25, 0.8125, 2.5).rgba;
  const Eigen::Array4d mean =
      (lookup(table, 0.25, 0.75, 2).rgba + lookup(table, 0.25, 0.75, 3).rgba +
       lookup(table, 0.25, 0.875, 2).rgba + lookup(table, 0.25, 0.875, 3).rgba) /
      4;
  EXPECT_LE((between - mean).abs().maxCoeff(), 1e-7);
}

TEST(TableLookup, SaysWhereItClamps) {
  const Table3D table = full_table(kSmooth, 0, 1, 4, 9, 5);
  for (const auto axis : {LengthAxis::linear, LengthAxis::logarithmic}) {
    const Table3D t = full_table(kSmooth, 0, 1, 4, 9, 5, TableMethod::incremental, axis);
    EXPECT_FALSE(lookup(t, 0, 1, 0).clamped);
    EXPECT_FALSE(lookup(t, 1, 0, 4).clamped);
    EXPECT_TRUE(lookup(t, 0.5, 0.5, 4.01).clamped);
    EXPECT_TRUE(lookup(t, -0.01, 0.5, 1).clamped);
    EXPECT_TRUE(lookup(t, 0.5, 1.01, 1).clamped);
    EXPECT_TRUE(lookup(t, std::nan(""), 0.5, 1).clamped);
    EXPECT_TRUE((lookup(t, 0.5, 0.5, 9).rgba == lookup(t, 0.5, 0.5, 4).rgba).all());
  }
  const Table2D slab = slab_table(kSmooth, 0, 1, 1, 5);
  EXPECT_FALSE(lookup(slab, 0, 1).clamped);
  EXPECT_TRUE(lookup(slab, 0, 1.5).clamped);
}

TEST(LengthAxis, InverseAndSpacing) {
  for (const auto axis : {LengthAxis::linear, LengthAxis::logarithmic}) {
    EXPECT_EQ(length_at(axis, 3, 9, 0), 0);
    EXPECT_EQ(length_at(axis, 3, 9, 8), 3);
    for (double c = 0; c <= 8; c += 0.3) {
      EXPECT_NEAR(length_coordinate(axis, 3, 9, length_at(axis, 3, 9, c)), c, 1e-12);
    }
  }
  const double first = length_at(LengthAxis::logarithmic, 1, 1001, 1) * 1000;
  const double last = (1 - length_at(LengthAxis::logarithmic, 1, 1001, 999)) * 1000;
  EXPECT_NEAR(first, 1 / 150.0, 1e-3);
  EXPECT_NEAR(last, 7, 0.1);
}

TEST(TableError, FallsWithTheSquareOfTheStep) {
  // A smooth function of both values: lookups are linear, so four times less at half the step.
  const double coarse = slab_table_error(slab_table(kSmooth, 0, 1, 1, 33), kSmooth, 1);
  const double fine = slab_table_error(slab_table(kSmooth, 0, 1, 1, 65), kSmooth, 1);
  EXPECT_GT(coarse / fine, 2.5);
  EXPECT_LT(coarse / fine, 5);
  const double slices = full_table_error(full_table(kSmooth, 0, 1, 2, 65, 17), kSmooth);
  const double more = full_table_error(full_table(kSmooth, 0, 1, 2, 65, 33), kSmooth);
  EXPECT_GT(slices / more, 2);
}

TEST(TableError, ChoosesTheSizeForABudget) {
  for (const double budget : {1e-2, 1e-3}) {
    const Table3D table = choose_full_table(kSmooth, 0, 1, {0, 5}, budget);
    ASSERT_TRUE(table.max_error.has_value());
    EXPECT_LE(*table.max_error, budget);
    EXPECT_EQ(*table.max_error, full_table_error(table, kSmooth));
    const Table2D slab = choose_slab_table(kSmooth, 0, 1, 0.5, budget);
    EXPECT_LE(*slab.max_error, budget);
    // No larger than needed: half the samples are not enough.
    const Table2D half = slab_table(kSmooth, 0, 1, 0.5, slab.n / 2);
    if (slab.n > 16) {
      EXPECT_GT(slab_table_error(half, kSmooth, 0.5), budget);
    }
  }
}

TEST(TableError, AShortLengthMattersInADenseMedium) {
  const TransferFunction dense({{0, {1, 0, 0}, 50}, {1, {0, 0, 1}, 200}});
  EXPECT_EQ(choose_full_table(dense, 0, 1, {0, 10}, 1e-2).axis, LengthAxis::logarithmic);
}

TEST(TableError, OnlyLengthsThatOccurCount) {
  // Where all segments are opaque the short ones, which need a fine axis, do not matter.
  const TransferFunction dense({{0, {1, 0, 0}, 50}, {1, {0, 0, 1}, 200}});
  const LengthRange long_ones{5, 10};
  const Table3D all = choose_full_table(dense, 0, 1, {0, 10}, 3e-3);
  const Table3D some = choose_full_table(dense, 0, 1, long_ones, 3e-3);
  EXPECT_LE(*all.max_error, 3e-3);
  EXPECT_LE(*some.max_error, 3e-3);
  EXPECT_EQ(*some.max_error, full_table_error(some, dense, long_ones));
  EXPECT_LT(some.rgba.size(), all.rgba.size());
  EXPECT_GT(full_table_error(some, dense), 3e-3);
  EXPECT_THROW((void)choose_full_table(dense, 0, 1, {2, 1}, 1e-2), base::UsageError);
  EXPECT_THROW((void)choose_full_table(dense, 0, 1, {-1, 1}, 1e-2), base::UsageError);
  EXPECT_THROW((void)choose_full_table(dense, 0, 1, {std::nan(""), 1}, 1e-2), base::UsageError);
}

TEST(TableError, StopsAtTheMemoryGiven) {
  const TransferFunction spike(
      {{0.5, {1, 1, 1}, 0}, {0.5005, {1, 1, 1}, 1e5}, {0.501, {1, 1, 1}, 0}});
  const Table3D table = choose_full_table(spike, 0, 1, {0, 1}, 1e-6, std::size_t{4} << 20);
  EXPECT_LE(table.rgba.size() * sizeof(float), std::size_t{4} << 20);
  EXPECT_GT(*table.max_error, 1e-6);
}

}  // namespace
}  // namespace tetraglass::preint
