#include "project/cpu/tile_bins.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.h"

namespace tetraglass::project::cpu {
namespace {

// Screen positions are floats: at the right edge of the widest picture (65,536 pixels) they are
// rounded by at most 2^-8 of a pixel.
constexpr float kMargin = 1.0F / 128;

int to_pixel(float position, int limit) {
  return static_cast<int>(std::clamp(position, -1.0F, static_cast<float>(limit)));
}

/// An edge from a, in front of the eye, to b, behind it, is seen from a to infinity: towards which
/// sides. The part in front is that of the points a + t (b - a) with z > 0.
void extend_to_infinity(double a, double a_z, double b, double b_z, float& low, float& high) {
  const double at_eye_plane = a * b_z - b * a_z;  // times -1 / (a_z - b_z), negative
  const double uncertainty =
      4 * std::numeric_limits<double>::epsilon() * (std::abs(a * b_z) + std::abs(b * a_z));
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  if (-at_eye_plane >= -uncertainty) high = kInfinity;
  if (-at_eye_plane <= uncertainty) low = -kInfinity;
}

/// The tiles that the bounds touch.
template <class F>
void for_tiles(const PixelBounds& bounds, std::size_t size, const F& visit) {
  if (bounds.empty()) return;
  for (std::size_t y = bounds.first_y / size; y <= bounds.last_y / size; ++y) {
    for (std::size_t x = bounds.first_x / size; x <= bounds.last_x / size; ++x) visit(x, y);
  }
}

}  // namespace

PixelBounds pixel_bounds(const mesh::Cell& cell, const ViewPoints& points, int width, int height) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  float low_x = kInfinity, high_x = -kInfinity, low_y = kInfinity, high_y = -kInfinity;
  int in_front = 0;
  for (const std::uint32_t v : cell) {
    const ScreenPoint& p = points.screen[v];
    if (p.in_front == 0) continue;
    ++in_front;
    low_x = std::min(low_x, p.x);
    high_x = std::max(high_x, p.x);
    low_y = std::min(low_y, p.y);
    high_y = std::max(high_y, p.y);
  }
  if (in_front == 0) return {};
  if (in_front < 4) {
    for (const std::uint32_t front : cell) {
      if (points.screen[front].in_front == 0) continue;
      for (const std::uint32_t back : cell) {
        if (points.screen[back].in_front != 0) continue;
        const ViewPoint& a = points.exact[front];
        const ViewPoint& b = points.exact[back];
        extend_to_infinity(a.x, a.z, b.x, b.z, low_x, high_x);
        extend_to_infinity(a.y, a.z, b.y, b.z, low_y, high_y);
      }
    }
  }
  const int first_x = std::max(0, to_pixel(std::ceil(low_x - kMargin), width));
  const int first_y = std::max(0, to_pixel(std::ceil(low_y - kMargin), height));
  const int last_x = std::min(width - 1, to_pixel(std::floor(high_x + kMargin), width));
  const int last_y = std::min(height - 1, to_pixel(std::floor(high_y + kMargin), height));
  if (first_x > last_x || first_y > last_y) return {};
  return {static_cast<std::uint16_t>(first_x), static_cast<std::uint16_t>(first_y),
          static_cast<std::uint16_t>(last_x), static_cast<std::uint16_t>(last_y)};
}

void TileBins::assign(DrawnCells& cells, const ViewPoints& points, int width, int height,
                      int tile_size, std::span<const std::uint32_t> order) {
  tiles_x_ = static_cast<std::size_t>((width + tile_size - 1) / tile_size);
  tiles_y_ = static_cast<std::size_t>((height + tile_size - 1) / tile_size);
  const auto size = static_cast<std::size_t>(tile_size);
  // Chunks of a fixed size, not one per thread: the order of the entries must not depend on
  // threads. Not too many either: each has a count per tile.
  constexpr std::size_t kMostCounts = std::size_t{1} << 22;
  const std::size_t most = std::clamp<std::size_t>(kMostCounts / tiles(), 1, 64);
  const std::size_t binned = order.empty() ? cells.size() : order.size();
  const std::size_t chunks = std::clamp<std::size_t>(binned / 4096, 1, most);
  const auto chunk_begin = [&](std::size_t chunk) { return binned * chunk / chunks; };
  const auto cell_at = [&](std::size_t i) {
    return order.empty() ? static_cast<std::uint32_t>(i) : order[i];
  };
  counts_.assign(chunks * tiles(), 0);
  base::parallel_ranges(chunks, 1, [&](std::size_t first, std::size_t end) {
    for (std::size_t chunk = first; chunk < end; ++chunk) {
      std::uint32_t* counts = counts_.data() + chunk * tiles();
      for (std::size_t i = chunk_begin(chunk); i < chunk_begin(chunk + 1); ++i) {
        DrawnCell& cell = cells.cells[cell_at(i)];
        cell.bounds = pixel_bounds(cell.vertices, points, width, height);
        cell.distance = 0;
        for (const std::uint32_t v : cell.vertices) {
          cell.distance += 0.25F * points.screen[v].distance;
        }
        for_tiles(cell.bounds, size,
                  [&](std::size_t x, std::size_t y) { ++counts[y * tiles_x_ + x]; });
      }
    }
  });
  starts_.resize(tiles() + 1);
  std::size_t total = 0;
  for (std::size_t tile = 0; tile < tiles(); ++tile) {
    starts_[tile] = total;
    std::uint32_t before = 0;  // of this tile, in the chunks before
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
      std::uint32_t& count = counts_[chunk * tiles() + tile];
      before += std::exchange(count, before);
    }
    total += before;
  }
  starts_[tiles()] = total;
  entries_.resize(total);
  base::parallel_ranges(chunks, 1, [&](std::size_t first, std::size_t end) {
    for (std::size_t chunk = first; chunk < end; ++chunk) {
      std::uint32_t* counts = counts_.data() + chunk * tiles();
      for (std::size_t i = chunk_begin(chunk); i < chunk_begin(chunk + 1); ++i) {
        const std::uint32_t cell = cell_at(i);
        for_tiles(cells.cells[cell].bounds, size, [&](std::size_t x, std::size_t y) {
          const std::size_t tile = y * tiles_x_ + x;
          entries_[starts_[tile] + counts[tile]++] = cell;
        });
      }
    }
  });
}

std::vector<std::uint32_t> TileBins::largest_first() const {
  std::vector<std::uint32_t> order;
  for (std::size_t tile = 0; tile < tiles(); ++tile) {
    if (!cells(tile).empty()) order.push_back(static_cast<std::uint32_t>(tile));
  }
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return cells(a).size() > cells(b).size();
  });
  return order;
}

}  // namespace tetraglass::project::cpu
