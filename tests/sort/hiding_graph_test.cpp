#include "sort/hiding_graph.h"

#include <algorithm>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace tetraglass::sort {
namespace {

using Edges = std::vector<std::pair<std::uint32_t, std::uint32_t>>;  // (hidden, front)

HidingGraph graph_of(std::uint32_t size, Edges edges) {
  std::sort(edges.begin(), edges.end());
  HidingGraph graph;
  for (std::uint32_t cell = 0; cell < size; ++cell) {
    for (const auto& [hidden, front] : edges) {
      if (hidden == cell) graph.fronts.push_back(front);
    }
    graph.offsets.push_back(static_cast<std::uint32_t>(graph.fronts.size()));
  }
  return graph;
}

std::vector<std::size_t> places(const std::vector<std::uint32_t>& order) {
  std::vector<std::size_t> result(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) result[order[i]] = i;
  return result;
}

TEST(HidingGraph, WithoutRingsIsOrderedWholly) {
  std::mt19937 random(2);
  constexpr std::uint32_t kSize = 60;
  std::vector<std::uint32_t> hidden_order(kSize);
  std::iota(hidden_order.begin(), hidden_order.end(), 0U);
  std::shuffle(hidden_order.begin(), hidden_order.end(), random);
  Edges edges;
  for (int i = 0; i < 300; ++i) {
    const std::uint32_t a = random() % kSize;
    const std::uint32_t b = random() % kSize;
    if (a < b) edges.emplace_back(hidden_order[a], hidden_order[b]);
  }
  const ResolvedOrder resolved = resolve(graph_of(kSize, edges), std::vector<double>(kSize, 0.0));
  EXPECT_EQ(resolved.cycles, 0U);
  EXPECT_TRUE(resolved.cyclic_cells.empty());
  ASSERT_EQ(resolved.cells.size(), kSize);
  const auto place = places(resolved.cells);
  for (const auto& [hidden, front] : edges) EXPECT_LT(place[hidden], place[front]);
}

// 0 -> {1 -> 2 -> 3 -> 1} -> 4, and apart {5 <-> 6}.
TEST(HidingGraph, FindsRingsAndBreaksEachOnce) {
  const Edges edges = {{0, 1}, {1, 2}, {2, 3}, {3, 1}, {3, 4}, {5, 6}, {6, 5}};
  const std::vector<double> depths = {0, 1, 7, 2, 9, 3, 4};
  const HidingGraph graph = graph_of(7, edges);
  const auto components = strong_components(graph);
  EXPECT_EQ(components.size(), 4U);
  const ResolvedOrder resolved = resolve(graph, depths);
  EXPECT_EQ(resolved.cycles, 2U);
  std::vector<std::uint32_t> cyclic = resolved.cyclic_cells;
  std::sort(cyclic.begin(), cyclic.end());
  EXPECT_EQ(cyclic, (std::vector<std::uint32_t>{1, 2, 3, 5, 6}));
  const auto place = places(resolved.cells);
  EXPECT_LT(place[0], place[1]);
  EXPECT_LT(place[3], place[4]);
  // The farthest of the ring, 2, goes first; the relations to 3 and from it to 1 hold.
  EXPECT_LT(place[2], place[3]);
  EXPECT_LT(place[3], place[1]);
  EXPECT_LT(place[6], place[5]);
}

TEST(HidingGraph, OfAMillionCellsInARowNeedsNoStack) {
  constexpr std::uint32_t kSize = 1000000;
  HidingGraph graph;
  for (std::uint32_t cell = 0; cell < kSize; ++cell) {
    graph.fronts.push_back((cell + 1) % kSize);
    graph.offsets.push_back(cell + 1);
  }
  const ResolvedOrder resolved = resolve(graph, std::vector<double>(kSize, 0.0));
  EXPECT_EQ(resolved.cycles, 1U);
  EXPECT_EQ(resolved.cells.size(), kSize);
  EXPECT_TRUE(std::is_sorted(resolved.cells.begin(), resolved.cells.end()));
}

}  // namespace
}  // namespace tetraglass::sort
