#include "apps/options.h"

#include <gtest/gtest.h>

namespace tetraglass::apps {
namespace {

using base::UsageError;

TEST(Options, NumbersAreWholeWords) {
  EXPECT_EQ(parse_number("-1.5e3", "--x"), -1500);
  EXPECT_EQ(parse_number("+2", "--x"), 2);
  for (const std::string text : {"", "1x", "nan", "inf", "1e999", "--2", "+-2", " 1"}) {
    EXPECT_THROW((void)parse_number(text, "--x"), UsageError) << "'" << text << "'";
  }
}

TEST(Options, CountsAreWholeWithOrWithoutAnExponent) {
  EXPECT_EQ(parse_count("12", "--rays", 1), 12);
  EXPECT_EQ(parse_count("1e6", "--rays", 1), 1'000'000);
  EXPECT_EQ(parse_count("1.5e3", "--rays", 1), 1500);
  EXPECT_EQ(parse_count("2147483647", "--rays", 0), 2147483647);
  for (const std::string text : {"", "0", "-1", "1.5", "1e-1", "1e6x", " 1", "nan", "inf", "-inf",
                                 "1e10", "2147483648", "1e999"}) {
    EXPECT_THROW((void)parse_count(text, "--rays", 1), UsageError) << "'" << text << "'";
  }
}

TEST(Options, DirectionsByAxisOrVector) {
  EXPECT_EQ(parse_direction("-z", "--view"), Eigen::Vector3d(0, 0, -1));
  EXPECT_EQ(parse_direction("y", "--view"), Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(parse_direction("-1,2,0.5", "--view"), Eigen::Vector3d(-1, 2, 0.5));
  for (const std::string text : {"", "+w", "0,0,0", "1,2", "1,2,3,4", "--x"}) {
    EXPECT_THROW((void)parse_direction(text, "--view"), UsageError) << "'" << text << "'";
  }
}

TEST(Options, SizesAndRanges) {
  EXPECT_EQ(parse_size("640x480", "--size"), std::make_pair(640, 480));
  EXPECT_EQ(parse_size("1e3x2", "--size"), std::make_pair(1000, 2));
  EXPECT_EQ(parse_range("-1:2.5", "--range"), std::make_pair(-1.0, 2.5));
  EXPECT_EQ(parse_range("3:3", "--range"), std::make_pair(3.0, 3.0));
  for (const std::string text :
       {"640", "0x5", "5x-1", "5x5x5", "1.5x2", "99999999x1", "99999999999x1"}) {
    EXPECT_THROW((void)parse_size(text, "--size"), UsageError) << text;
  }
  for (const std::string text : {"1", "2:1", "1:2:3", "a:b"}) {
    EXPECT_THROW((void)parse_range(text, "--range"), UsageError) << text;
  }
}

TEST(Options, WrongNamesGetTheRightOnes) {
  const std::vector<std::pair<std::string, int>> choices = {{"emission", 1}, {"absorption", 2}};
  EXPECT_EQ(parse_choice<int>("absorption", "--mode", choices), 2);
  try {
    (void)parse_choice<int>("emision", "--mode", choices);
    FAIL() << "no exception";
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean 'emission'?"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace tetraglass::apps
