#include "mesh/number_text.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "mesh/time_step.h"

namespace tetraglass::mesh {
namespace {

TEST(ParseNumber, TakesTheNumbersOfCAndFortran) {
  EXPECT_EQ(parse_number("1.5"), 1.5);
  EXPECT_EQ(parse_number("+2e-3"), 2e-3);
  EXPECT_EQ(parse_number("-1.5D+03"), -1500);
  EXPECT_EQ(parse_number("1d2"), 100);
  EXPECT_TRUE(std::isnan(parse_number("nan").value()));
  EXPECT_EQ(parse_number("-inf"), -INFINITY);
  EXPECT_EQ(parse_number("1e999"), INFINITY);
  EXPECT_EQ(parse_number("1e-999"), 0);
  for (const char* no : {"", "x", "1.5x", "1.5e", "1d", "--1", "1 2", "+"}) {
    EXPECT_FALSE(parse_number(no)) << no;
  }
}

TEST(ParseNumbers, WritesRepetitionsOut) {
  EXPECT_EQ(parse_numbers(" 1, 2\n3*0.5\t4 ", Repetition::allowed),
            (std::vector<double>{1, 2, 0.5, 0.5, 0.5, 4}));
  EXPECT_EQ(parse_numbers(""), std::vector<double>{});
  EXPECT_FALSE(parse_numbers("1 two 3"));
  EXPECT_FALSE(parse_numbers("2*1"));
  EXPECT_FALSE(parse_numbers("99999999999999*1", Repetition::allowed));
  EXPECT_FALSE(parse_numbers("*1", Repetition::allowed));
  // Not more than memory holds, whatever a short text asks for.
  EXPECT_FALSE(parse_numbers("200000000*1 200000000*1", Repetition::allowed));
}

TEST(IsText, TellsTextFromBinary) {
  EXPECT_TRUE(is_text("1 2\r\n3\t4\n"));
  EXPECT_FALSE(is_text(std::string_view("1\0002", 3)));
  EXPECT_FALSE(is_text("\xff"));
}

TEST(FindTimeStep, TakesIndicesAndTheNearestTime) {
  const std::array<double, 3> times = {0, 0.5, 2};
  EXPECT_EQ(find_time_step("", times), 2U);
  EXPECT_EQ(find_time_step("last", times), 2U);
  EXPECT_EQ(find_time_step("index:1", times), 1U);
  EXPECT_EQ(find_time_step("0.6", times), 1U);
  EXPECT_EQ(find_time_step("-3", times), 0U);
  EXPECT_EQ(find_time_step("1e9", times), 2U);
  for (const char* no : {"index:3", "index:-1", "index:", "index:1x", "first", "nan"}) {
    EXPECT_THROW(static_cast<void>(find_time_step(no, times)), base::UsageError) << no;
  }
}

}  // namespace
}  // namespace tetraglass::mesh
