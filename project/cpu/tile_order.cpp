#include "project/cpu/tile_order.h"

#include <algorithm>
#include <array>
#include <limits>

namespace tetraglass::project::cpu {
namespace {

constexpr unsigned kDigitBits = 11;  // two digits: counters for one fit into half of the L1 cache
constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;

/// Where entries of each digit start, from their counts.
void sum_up(std::array<std::uint32_t, kDigits>& counts) {
  std::uint32_t start = 0;
  for (std::uint32_t& count : counts) {
    const std::uint32_t next = start + count;
    count = start;
    start = next;
  }
}

}  // namespace

std::span<const std::uint32_t> TileOrder::front_to_back(std::span<const std::uint32_t> cells,
                                                        const DrawnCells& drawn) {
  const std::size_t count = cells.size();
  distances_.resize(count);
  entries_.resize(count);
  half_sorted_.resize(count);
  cells_.resize(count);
  float nearest = std::numeric_limits<float>::infinity();
  float farthest = -nearest;
  for (std::size_t i = 0; i < count; ++i) {
    const float distance = drawn.cells[cells[i]].distance;
    distances_[i] = distance;
    nearest = std::min(nearest, distance);
    farthest = std::max(farthest, distance);
  }
  constexpr auto kMost = static_cast<float>(kDigits * kDigits - 1);
  const float scale = farthest > nearest ? kMost / (farthest - nearest) : 0;
  std::array<std::uint32_t, kDigits> low{};
  std::array<std::uint32_t, kDigits> high{};
  for (std::size_t i = 0; i < count; ++i) {
    const auto key = static_cast<std::uint32_t>(std::min(kMost, (distances_[i] - nearest) * scale));
    entries_[i] = {key, cells[i]};
    ++low[key % kDigits];
    ++high[key / kDigits];
  }
  sum_up(low);
  sum_up(high);
  for (const Entry& entry : entries_) half_sorted_[low[entry.key % kDigits]++] = entry;
  for (const Entry& entry : half_sorted_) cells_[high[entry.key / kDigits]++] = entry.cell;
  return cells_;
}

}  // namespace tetraglass::project::cpu
