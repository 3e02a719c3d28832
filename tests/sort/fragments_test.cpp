#include "sort/fragments.h"

#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace tetraglass::sort {
namespace {

struct Fragment {
  float depth;
  int number;
};

void sort_by_depth(std::vector<Fragment>& fragments) {
  std::vector<Fragment> spare(fragments.size());
  sort_fragments(std::span(fragments), std::span(spare),
                 [](const Fragment& fragment) { return fragment.depth; });
}

// Every length around the runs and their merges; few depths, so that most are equal.
TEST(Fragments, AreSortedLikeTheStandardLibrarySortsStably) {
  std::mt19937 random(4);
  for (int n = 0; n < 200; ++n) {
    for (const unsigned depths : {3U, 1000000U}) {
      std::vector<Fragment> fragments;
      for (int i = 0; i < n; ++i) {
        fragments.push_back({static_cast<float>(random() % depths), i});
      }
      std::vector<Fragment> expected = fragments;
      std::stable_sort(expected.begin(), expected.end(),
                       [](const Fragment& a, const Fragment& b) { return a.depth < b.depth; });
      sort_by_depth(fragments);
      for (std::size_t i = 0; i < fragments.size(); ++i) {
        ASSERT_EQ(fragments[i].number, expected[i].number) << "of " << n << ", place " << i;
      }
    }
  }
}

TEST(Fragments, InOrderStayAsTheyAre) {
  std::vector<Fragment> fragments;
  for (int i = 0; i < 100; ++i) fragments.push_back({static_cast<float>(i / 7), i});
  sort_by_depth(fragments);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(fragments[static_cast<std::size_t>(i)].number, i);
}

}  // namespace
}  // namespace tetraglass::sort
