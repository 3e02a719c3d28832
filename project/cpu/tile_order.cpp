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

/// The distance of the middle of a cell where the tile sees it: of the plane that comes nearest to
/// its four vertices, at the middle of the pixels that it has in the tile. That of the centroid
/// says little where the cell is as large as the tile.
float distance_in_tile(const DrawnCell& cell, const ViewPoints& points, const Region& tile) {
  const auto middle = [](int first, int last, int tile_first, int tile_size) {
    return 0.5F * static_cast<float>(std::max(first, tile_first) +
                                     std::min(last, tile_first + tile_size - 1));
  };
  const float x = middle(cell.bounds.first_x, cell.bounds.last_x, tile.x, tile.width);
  const float y = middle(cell.bounds.first_y, cell.bounds.last_y, tile.y, tile.height);
  std::array<ScreenPoint, 4> p;
  float mean_x = 0;
  float mean_y = 0;
  float mean = 0;
  float least = std::numeric_limits<float>::infinity();
  float most = -least;
  for (std::size_t k = 0; k < 4; ++k) {
    p[k] = points.screen[cell.vertices[k]];
    if (p[k].in_front == 0) return cell.distance;
    mean_x += 0.25F * p[k].x;
    mean_y += 0.25F * p[k].y;
    mean += 0.25F * p[k].distance;
    least = std::min(least, p[k].distance);
    most = std::max(most, p[k].distance);
  }
  float xx = 0;
  float xy = 0;
  float yy = 0;
  float x_distance = 0;
  float y_distance = 0;
  for (const ScreenPoint& point : p) {
    const float dx = point.x - mean_x;
    const float dy = point.y - mean_y;
    const float d = point.distance - mean;
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
    x_distance += dx * d;
    y_distance += dy * d;
  }
  const float determinant = xx * yy - xy * xy;
  const float slope_x = (x_distance * yy - y_distance * xy) / determinant;
  const float slope_y = (y_distance * xx - x_distance * xy) / determinant;
  const float distance = mean + slope_x * (x - mean_x) + slope_y * (y - mean_y);
  // Also where the vertices lie on a line: a quotient that is no number is not above either.
  return distance > least ? std::min(distance, most) : distance <= least ? least : mean;
}

}  // namespace

std::span<const std::uint32_t> TileOrder::front_to_back(std::span<const std::uint32_t> cells,
                                                        const DrawnCells& drawn,
                                                        const ViewPoints& points,
                                                        const Region& tile) {
  const std::size_t count = cells.size();
  distances_.resize(count);
  entries_.resize(count);
  half_sorted_.resize(count);
  cells_.resize(count);
  float nearest = std::numeric_limits<float>::infinity();
  float farthest = -nearest;
  for (std::size_t i = 0; i < count; ++i) {
    const DrawnCell& cell = drawn.cells[cells[i]];
    const bool large = cell.bounds.last_x - cell.bounds.first_x > tile.width / 2 ||
                       cell.bounds.last_y - cell.bounds.first_y > tile.height / 2;
    const float distance = large ? distance_in_tile(cell, points, tile) : cell.distance;
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
