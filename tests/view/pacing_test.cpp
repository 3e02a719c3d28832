#include "apps/view/pacing.h"

#include <gtest/gtest.h>

namespace tetraglass::apps::view {
namespace {

TEST(Pacing, ChangesAreDrawnAtOnceAndInFullAtRest) {
  Pacing pacing;
  EXPECT_FALSE(pacing.complete());
  pacing.changed(1000);
  const auto first = pacing.next(1000);
  ASSERT_TRUE(first);
  EXPECT_GT(*first, 1);
  pacing.started(*first);
  EXPECT_FALSE(pacing.next(5000)) << "one picture at a time";
  pacing.finished(50);
  EXPECT_FALSE(pacing.next(1000 + Pacing::kRestMs - 1));
  EXPECT_EQ(*pacing.wait_ms(1000 + Pacing::kRestMs - 1), 1);
  EXPECT_EQ(pacing.next(1000 + Pacing::kRestMs), 1);
  pacing.started(1);
  pacing.finished(400);
  EXPECT_TRUE(pacing.complete());
  EXPECT_FALSE(pacing.next(9000)) << "nothing changed: nothing is drawn";
  EXPECT_FALSE(pacing.wait_ms(9000));
}

TEST(Pacing, AChangeDuringADrawingIsDrawnAfterIt) {
  Pacing pacing;
  pacing.changed(0);
  pacing.started(1);
  pacing.changed(10);
  EXPECT_FALSE(pacing.next(20));
  pacing.finished(30);
  EXPECT_FALSE(pacing.complete());
  EXPECT_TRUE(pacing.next(40));
}

// What is drawn while moving is always shown; what is drawn at rest is given up for a change.
TEST(Pacing, OnlyPicturesAtRestAreOutdated) {
  Pacing pacing;
  pacing.changed(0);
  pacing.started(*pacing.next(0));
  pacing.changed(1);
  EXPECT_FALSE(pacing.outdated());
  pacing.finished(Pacing::kMovingMs);
  pacing.started(*pacing.next(100));
  pacing.finished(Pacing::kMovingMs);
  EXPECT_EQ(pacing.next(1000), 1);
  pacing.started(1);
  EXPECT_FALSE(pacing.outdated()) << "nothing has changed";
  pacing.changed(1010);
  EXPECT_TRUE(pacing.outdated());
  pacing.interrupted();
  EXPECT_FALSE(pacing.outdated());
  EXPECT_FALSE(pacing.complete());
  EXPECT_GT(*pacing.next(1020), 1) << "while it moves";
}

// A machine that takes `ms_in_full` for all pixels: moving pictures settle in time, as fine as that
// allows, and do not flicker between two.
TEST(Pacing, MovingPicturesSettleInTime) {
  for (const double ms_in_full : {10.0, 75.0, 100.0, 300.0, 700.0, 2000.0, 1e5}) {
    Pacing pacing;
    const auto ms = [&](int n) { return ms_in_full / (n * n); };
    int before = 0;
    int now = 0;
    for (int i = 0; i < 30; ++i) {
      pacing.changed(100.0 * i);
      before = now;
      now = *pacing.next(100.0 * i);
      pacing.started(now);
      pacing.finished(ms(now));
    }
    EXPECT_EQ(now, before) << ms_in_full;
    EXPECT_TRUE(ms(now) <= Pacing::kMovingMs || now == Pacing::kCoarsest) << ms_in_full;
    if (now > 1) {
      EXPECT_GT(ms(now - 1), Pacing::kMovingMs) << ms_in_full;
    }
  }
}

TEST(Pacing, WhatFailedIsTriedAgainOnlyAfterAChange) {
  Pacing pacing;
  pacing.changed(0);
  pacing.started(*pacing.next(0));
  pacing.failed();
  EXPECT_FALSE(pacing.next(10000));
  pacing.changed(10000);
  EXPECT_TRUE(pacing.next(10000));
}

}  // namespace
}  // namespace tetraglass::apps::view
