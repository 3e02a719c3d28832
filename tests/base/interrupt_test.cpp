#include "base/interrupt.h"

#include <gtest/gtest.h>

#include "base/progress.h"

namespace tetraglass::base {
namespace {

TEST(Interrupt, EndsWorkAtItsNextStep) {
  Progress progress("work", 10);
  EXPECT_NO_THROW(progress.advance());
  interrupt(true);
  EXPECT_THROW(throw_if_interrupted(), Interrupted);
  EXPECT_THROW(progress.advance(), Interrupted);
  interrupt(false);
  EXPECT_NO_THROW(progress.advance());
  EXPECT_NO_THROW(throw_if_interrupted());
}

}  // namespace
}  // namespace tetraglass::base
