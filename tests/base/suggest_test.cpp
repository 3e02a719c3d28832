#include "base/suggest.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

namespace tetraglass::base {
namespace {

using Names = std::vector<std::string>;

TEST(EditDistance, CountsEveryKindOfSlip) {
  EXPECT_EQ(edit_distance("", ""), 0U);
  EXPECT_EQ(edit_distance("", "abc"), 3U);
  EXPECT_EQ(edit_distance("viridis", "viridis"), 0U);
  EXPECT_EQ(edit_distance("VIRIDIS", "viridis"), 0U);
  EXPECT_EQ(edit_distance("viridi", "viridis"), 1U);    // left out
  EXPECT_EQ(edit_distance("viriddis", "viridis"), 1U);  // put in
  EXPECT_EQ(edit_distance("viridas", "viridis"), 1U);   // another
  EXPECT_EQ(edit_distance("virdiis", "viridis"), 1U);   // swapped
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
  EXPECT_EQ(edit_distance("ca", "abc"), 3U);  // no edits between swapped letters (alignment)
}

TEST(EditDistance, IsSymmetricAndBounded) {
  std::mt19937 bits(1);
  const auto word = [&] {
    std::string text(bits() % 8, 'a');
    for (char& c : text) c = static_cast<char>('a' + bits() % 3);
    return text;
  };
  for (int trial = 0; trial < 2000; ++trial) {
    const std::string a = word();
    const std::string b = word();
    const std::size_t distance = edit_distance(a, b);
    ASSERT_EQ(distance, edit_distance(b, a)) << a << ' ' << b;
    ASSERT_LE(distance, std::max(a.size(), b.size())) << a << ' ' << b;
    ASSERT_GE(distance + std::min(a.size(), b.size()), std::max(a.size(), b.size()))
        << a << ' ' << b;
    ASSERT_EQ(distance == 0, a == b);
    const std::string c = word();
    ASSERT_LE(edit_distance(a + c, b + c), distance) << a << ' ' << b << ' ' << c;
  }
}

TEST(NearestNames, PutsNamesThatContainItFirst) {
  const Names known = {"Pressure", "Temperature", "temp", "Velocity"};
  EXPECT_EQ(nearest_names("temp", known), (Names{"Temperature", "temp"}));
  EXPECT_EQ(nearest_names("Presure", known), (Names{"Pressure"}));
  EXPECT_EQ(nearest_names("my velocity", known), (Names{"Velocity"}));
  EXPECT_TRUE(nearest_names("qqqqqq", known).empty());
  EXPECT_TRUE(nearest_names("temp", {}).empty());
}

TEST(NearestNames, GivesAsManyAsAsked) {
  const Names known = {"a1", "a2", "a3", "a4", "a5"};
  EXPECT_EQ(nearest_names("a", known).size(), 3U);
  EXPECT_EQ(nearest_names("a", known, 5).size(), 5U);
}

TEST(Suggestion, OfExtensionsNamesAll) {
  const Names known = {".png", ".vtu", ".vtk"};
  EXPECT_EQ(unknown_extension(".jpg", known),
            "its extension '.jpg' is not known; there are: .png .vtu .vtk");
  EXPECT_EQ(unknown_extension(".vtx", known),
            "its extension '.vtx' is not known; did you mean '.vtu' or '.vtk'?; there are: .png "
            ".vtu .vtk");
  EXPECT_EQ(unknown_extension("", known), "its name has no extension; there are: .png .vtu .vtk");
}

TEST(Suggestion, IsASentence) {
  EXPECT_EQ(suggestion("virdis", {"viridis", "coolwarm"}), "; did you mean 'viridis'?");
  EXPECT_EQ(suggestion("s1", {"s2", "s3"}), "; did you mean 's2' or 's3'?");
  EXPECT_EQ(suggestion("qqqqqq", {"viridis", "coolwarm"}), "; there are: viridis, coolwarm");
  EXPECT_EQ(suggestion("qqqqqq", {}), "; there are none");
  const std::string many = suggestion("q", Names(30, "viridis"));
  EXPECT_EQ(many.substr(many.size() - 5), ", ...");
}

}  // namespace
}  // namespace tetraglass::base
