#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tetraglass::sort {

/// Two cells of which `front` hides a part of `back`.
struct Relation {
  std::uint32_t front = 0;
  std::uint32_t back = 0;
};

/// Cells 0 .. size - 1 and, for each, those that hide a part of it.
struct HidingGraph {
  std::vector<std::uint32_t> offsets{
      0};  ///< cell i is hidden by fronts[offsets[i] .. offsets[i + 1])
  std::vector<std::uint32_t> fronts;

  [[nodiscard]] std::size_t size() const { return offsets.size() - 1; }
  [[nodiscard]] std::span<const std::uint32_t> fronts_of(std::uint32_t cell) const {
    return {fronts.data() + offsets[cell], fronts.data() + offsets[cell + 1]};
  }
};

/// The graph of `size` cells and these relations.
[[nodiscard]] HidingGraph make_graph(std::size_t size, std::span<const Relation> relations);

/// The strongly connected components of the graph, in an order in which each comes before those
/// that hide it. Members in no particular order. Cost: linear, no recursion. Source: Tarjan 1972,
/// "Depth-First Search and Linear Graph Algorithms".
[[nodiscard]] std::vector<std::vector<std::uint32_t>> strong_components(const HidingGraph& graph);

/// An order of all cells in which the hidden ones come first, and where cells hide each other in a
/// ring as few as possible do not: within a component, whenever no cell is left that hides none of
/// those left, the one that is farthest by `depths` (one number per cell, growing away from the
/// eye) goes next.
struct ResolvedOrder {
  std::vector<std::uint32_t> cells;
  std::size_t cycles = 0;                   ///< components of more than one cell
  std::vector<std::uint32_t> cyclic_cells;  ///< their cells
};
[[nodiscard]] ResolvedOrder resolve(const HidingGraph& graph, std::span<const double> depths);

}  // namespace tetraglass::sort
