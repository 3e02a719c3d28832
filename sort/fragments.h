#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

/// The order `fragments`: not of cells, but of the pieces of one pixel's ray.
///
/// A fragment is the piece of a pixel's ray in one cell, from the depth `entry` to the depth
/// `exit`. The fragments of a pixel are in order if they are sorted by the middle of the piece,
/// entry + exit, nearest first; fragments of the same middle keep the order in which they came, so
/// they should come in the order of the cells wherever the picture is not to depend on threads.
/// Pieces in cells that do not overlap are disjoint: whichever cells they belong to (cycles, holes,
/// parts, another mesh), the middle orders them, up to the rounding of the depths. A piece of no
/// length falls between its neighbours. Where cells overlap no order is right; the middle gives the
/// same one at every pixel that sees the same depths.
namespace tetraglass::sort {

/// Sorts the few fragments of a pixel by `depth_of(fragment)`, which grows, stably and without
/// allocating; `spare` is as long as `fragments` and left in disorder. Runs of kInsertionRun by
/// insertion, then merges: n log n, and linear where the fragments come in order.
template <typename Fragment, typename DepthOf>
void sort_fragments(std::span<Fragment> fragments, std::span<Fragment> spare,
                    const DepthOf& depth_of) {
  constexpr std::size_t kInsertionRun = 16;
  const std::size_t n = fragments.size();
  for (std::size_t begin = 0; begin < n; begin += kInsertionRun) {
    const std::size_t end = std::min(n, begin + kInsertionRun);
    for (std::size_t i = begin + 1; i < end; ++i) {
      const Fragment moved = fragments[i];
      const auto depth = depth_of(moved);
      std::size_t hole = i;
      for (; hole > begin && depth_of(fragments[hole - 1]) > depth; --hole) {
        fragments[hole] = fragments[hole - 1];
      }
      fragments[hole] = moved;
    }
  }
  const auto before = [&](const Fragment& a, const Fragment& b) {
    return depth_of(a) < depth_of(b);
  };
  for (std::size_t width = kInsertionRun; width < n; width *= 2) {
    for (std::size_t begin = 0; begin + width < n; begin += 2 * width) {
      const std::size_t middle = begin + width;
      const std::size_t end = std::min(n, middle + width);
      if (!before(fragments[middle], fragments[middle - 1])) continue;
      std::copy(fragments.begin() + begin, fragments.begin() + middle, spare.begin());
      std::merge(spare.begin(), spare.begin() + width, fragments.begin() + middle,
                 fragments.begin() + end, fragments.begin() + begin, before);
    }
  }
}

}  // namespace tetraglass::sort
