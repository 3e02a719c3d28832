#include "preint/isosurfaces.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/preint/media.h"

namespace tetraglass::preint {
namespace {

std::vector<Isosurface> surfaces(const std::vector<double>& values) {
  std::vector<Isosurface> result;
  for (const double v : values) result.push_back({v, Color::Ones(), 1});
  return result;
}

TEST(Isosurfaces, NearestFirst) {
  const auto three = surfaces({0.5, 0.1, 0.9});
  EXPECT_EQ(crossed(three, 0, 1), (std::vector<std::size_t>{1, 0, 2}));
  EXPECT_EQ(crossed(three, 1, 0), (std::vector<std::size_t>{2, 0, 1}));
  EXPECT_EQ(crossed(three, 0.4, 0.6), (std::vector<std::size_t>{0}));
  EXPECT_TRUE(crossed(three, 0.2, 0.3).empty());
  EXPECT_TRUE(crossed(three, 0.5, 0.5).empty());
}

TEST(Isosurfaces, EqualValuesKeepTheirOrder) {
  const auto equal = surfaces({0.5, 0.5, 0.2});
  EXPECT_EQ(crossed(equal, 0, 1), (std::vector<std::size_t>{2, 0, 1}));
  EXPECT_EQ(crossed(equal, 1, 0), (std::vector<std::size_t>{0, 1, 2}));
}

TEST(Isosurfaces, ATouchedEndBelongsToOneSegment) {
  EXPECT_TRUE(crosses(0, 0.5, 0.5));
  EXPECT_FALSE(crosses(0.5, 1, 0.5));
  EXPECT_TRUE(crosses(0.5, 0, 0.5));
  EXPECT_FALSE(crosses(1, 0.5, 0.5));
}

RC_GTEST_PROP(IsosurfacesProperty, ChainsOfSegmentsCrossOncePerChangeOfSide, ()) {
  const auto chain = *rc::gen::container<std::vector<double>>(*rc::gen::inRange<std::size_t>(2, 30),
                                                              tests::field_value());
  const double isovalue = *tests::field_value();
  const auto one = surfaces({isovalue});
  std::size_t crossings = 0;
  int changes = 0;
  bool is_below = chain.front() < isovalue;
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    crossings += crossed(one, chain[i], chain[i + 1]).size();
    if ((chain[i + 1] < isovalue) != is_below) {
      ++changes;
      is_below = !is_below;
    }
  }
  RC_ASSERT(crossings == static_cast<std::size_t>(changes));
  // ... so an odd number exactly where the ends lie on different sides, however the chain is cut.
  RC_ASSERT((crossings % 2 == 1) == crosses(chain.front(), chain.back(), isovalue));
}

}  // namespace
}  // namespace tetraglass::preint
