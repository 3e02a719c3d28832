#include "mesh/time_step.h"

#include <gtest/gtest.h>

namespace tetraglass::mesh {
namespace {

TEST(TimeStep, WhatIsNotedIsReadBack) {
  const std::vector<double> times = {0, 0.25, 1e-7};
  for (const std::string of : {"", "'Temp': "}) {
    std::vector<std::string> notes = {"something else", "time step 1 of 2 is not meant"};
    EXPECT_FALSE(noted_time_step(notes));
    note_time_step(notes, 2, times, of);
    note_time_step(notes, 1, times, of);
    const auto noted = noted_time_step(notes);
    ASSERT_TRUE(noted) << of;
    EXPECT_EQ(noted->step, 2U);
    EXPECT_EQ(noted->count, 3U);
    EXPECT_EQ(noted->time, "1e-07");
  }
}

TEST(TimeStep, OfASingleStepThereIsNothing) {
  std::vector<std::string> notes;
  note_time_step(notes, 0, std::vector<double>{3});
  EXPECT_FALSE(noted_time_step(notes));
}

}  // namespace
}  // namespace tetraglass::mesh
