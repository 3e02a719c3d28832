#include "sort/centroid.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace tetraglass::sort {
namespace {

// Keys have four digits of 8 bits: the 256 places of a pass stay in the first-level cache.
constexpr int kDigitBits = 8;
constexpr std::uint32_t kDigits = 1U << kDigitBits;
constexpr int kKeyDigits = 4;

// A chunk has to outweigh its counts and the start of a task; fewer cells are sorted at once.
constexpr std::size_t kLeastChunk = 32768;

// Below this many entries insertion is faster than clearing counts.
constexpr std::size_t kFew = 48;

struct Chunks {
  std::size_t total;
  std::size_t count;
  [[nodiscard]] std::size_t begin(std::size_t chunk) const { return total * chunk / count; }
  [[nodiscard]] std::size_t end(std::size_t chunk) const { return begin(chunk + 1); }
};

// Calls f(chunk) for every chunk, in parallel if there are several.
template <typename F>
void for_each_chunk(const Chunks& chunks, const F& f) {
  if (chunks.count == 1) {
    f(std::size_t{0});
  } else {
    tbb::parallel_for(std::size_t{0}, chunks.count, f, tbb::static_partitioner());
  }
}

// A number that grows with the depth of centroids: in a parallel view four times the depth less
// that of a reference point; in perspective the squared distance less that of the reference, |v +
// w|^2 - |w|^2 = v.(v + 2 w), which does not cancel however far the eye is. Four coordinates are
// added before the reference is taken away: the rounding of the sum is no larger than that of the
// coordinates themselves.
class Depth {
 public:
  Depth(const mesh::TetMesh& mesh, const Eigen::Vector3d& reference, const View& view)
      : points_(mesh.points.data()),
        cells_(mesh.cells.data()),
        four_references_(4 * reference),
        direction_(view.direction),
        two_to_reference_(2 * (reference - view.eye)) {}

  [[nodiscard]] double parallel(std::uint32_t cell) const { return direction_.dot(sum(cell)); }

  [[nodiscard]] double perspective(std::uint32_t cell) const {
    const Eigen::Vector3d v = 0.25 * sum(cell);
    return v.dot(v + two_to_reference_);
  }

 private:
  [[nodiscard]] Eigen::Vector3d sum(std::uint32_t index) const {
    const mesh::Cell& cell = cells_[index];
    return ((points_[cell[0]] + points_[cell[1]]) + (points_[cell[2]] + points_[cell[3]])) -
           four_references_;
  }

  const Eigen::Vector3d* points_;
  const mesh::Cell* cells_;
  Eigen::Vector3d four_references_;
  Eigen::Vector3d direction_;
  Eigen::Vector3d two_to_reference_;
};

struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

// Writes the bits of the depth of each cell; says how far the finite ones extend.
template <typename DepthOf>
Extent write_depths(std::span<const std::uint32_t> cells, const Chunks& chunks,
                    const DepthOf& depth_of, std::uint64_t* bits) {
  std::vector<Extent> extents(chunks.count);
  for_each_chunk(chunks, [&](std::size_t chunk) {
    Extent extent;
    for (std::size_t i = chunks.begin(chunk); i < chunks.end(chunk); ++i) {
      const double depth = depth_of(cells[i]);
      bits[i] = std::bit_cast<std::uint64_t>(depth);
      if (!std::isfinite(depth)) continue;
      extent.low = std::min(extent.low, depth);
      extent.high = std::max(extent.high, depth);
    }
    extents[chunk] = extent;
  });
  Extent all;
  for (const Extent& extent : extents) {
    all.low = std::min(all.low, extent.low);
    all.high = std::max(all.high, extent.high);
  }
  return all;
}

constexpr double kLastStep = 4294967294.0;  // 2^32 - 2

// 1 for the farthest depth, 2^32 - 1 for the nearest, 0 where there is no finite one.
std::uint32_t key_of(double depth, double farthest, double scale) {
  if (!std::isfinite(depth)) return 0;
  return 1 + static_cast<std::uint32_t>(std::min((farthest - depth) * scale, kLastStep));
}

std::uint32_t digit_of(std::uint64_t entry, int digit) {
  return static_cast<std::uint32_t>(entry >> (32 + kDigitBits * digit)) & (kDigits - 1);
}

// Spreads the entries over buckets by their highest digit, keeping their order within each bucket.
// Gives where each bucket begins.
std::array<std::uint32_t, kDigits + 1> spread(const Chunks& chunks, const std::uint64_t* entries,
                                              std::vector<std::uint32_t>& places,
                                              std::uint64_t* target) {
  for_each_chunk(chunks, [&](std::size_t chunk) {
    std::uint32_t* mine = places.data() + chunk * kDigits;
    std::fill_n(mine, kDigits, 0U);
    for (std::size_t i = chunks.begin(chunk); i < chunks.end(chunk); ++i) {
      ++mine[digit_of(entries[i], kKeyDigits - 1)];
    }
  });
  std::array<std::uint32_t, kDigits + 1> begins{};
  std::uint32_t place = 0;
  for (std::size_t digit = 0; digit < kDigits; ++digit) {
    begins[digit] = place;
    for (std::size_t chunk = 0; chunk < chunks.count; ++chunk) {
      place += std::exchange(places[chunk * kDigits + digit], place);
    }
  }
  begins[kDigits] = place;
  for_each_chunk(chunks, [&](std::size_t chunk) {
    std::uint32_t* mine = places.data() + chunk * kDigits;
    for (std::size_t i = chunks.begin(chunk); i < chunks.end(chunk); ++i) {
      target[mine[digit_of(entries[i], kKeyDigits - 1)]++] = entries[i];
    }
  });
  return begins;
}

void insertion_sort(std::span<std::uint64_t> entries) {
  for (std::size_t i = 1; i < entries.size(); ++i) {
    const std::uint64_t moved = entries[i];
    std::size_t hole = i;
    for (; hole > 0 && entries[hole - 1] >> 32 > moved >> 32; --hole) {
      entries[hole] = entries[hole - 1];
    }
    entries[hole] = moved;
  }
}

// Sorts entries by the lowest kCount digits of their keys, from the lowest one up, and writes
// their cells to `cells`. `spare` is as long as the entries; both are left in disorder.
template <int kCount>
void sort_bucket(std::span<std::uint64_t> entries, std::span<std::uint64_t> spare,
                 std::uint32_t* cells) {
  const auto cell_of = [](std::uint64_t entry) { return static_cast<std::uint32_t>(entry); };
  if (entries.size() <= kFew) {
    insertion_sort(entries);
    std::transform(entries.begin(), entries.end(), cells, cell_of);
    return;
  }
  std::array<std::array<std::uint32_t, kDigits>, kCount> places{};
  for (const std::uint64_t entry : entries) {
    for (int digit = 0; digit < kCount; ++digit) {
      ++places[static_cast<std::size_t>(digit)][digit_of(entry, digit)];
    }
  }
  for (int digit = 0; digit < kCount; ++digit) {
    std::array<std::uint32_t, kDigits>& mine = places[static_cast<std::size_t>(digit)];
    std::exclusive_scan(mine.begin(), mine.end(), mine.begin(), 0U);
    if (digit + 1 == kCount) {
      for (const std::uint64_t entry : entries)
        cells[mine[digit_of(entry, digit)]++] = cell_of(entry);
    } else {
      for (const std::uint64_t entry : entries) spare[mine[digit_of(entry, digit)]++] = entry;
      std::swap(entries, spare);
    }
  }
}

Eigen::Vector3d reference_point(const mesh::TetMesh& mesh, std::span<const std::uint32_t> cells) {
  const Eigen::Vector3d& first = mesh.points[mesh.cells[cells.front()][0]];
  return first.allFinite() ? first : Eigen::Vector3d::Zero();
}

}  // namespace

Order CentroidSorter::sort(const mesh::TetMesh& mesh, std::span<const std::uint32_t> cells,
                           const View& view) {
  Order order;
  order.method = "centroid";
  if (cells.empty()) return order;
  const std::size_t n = cells.size();
  const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  const Chunks chunks{n, std::clamp(n / kLeastChunk, std::size_t{1}, threads)};
  order.cells.resize(n);
  entries_.resize(n);
  spare_.resize(n);
  places_.resize(chunks.count * kDigits);

  const Depth depth(mesh, reference_point(mesh, cells), view);
  const Extent extent =
      view.parallel
          ? write_depths(
                cells, chunks, [&](auto c) { return depth.parallel(c); }, spare_.data())
          : write_depths(
                cells, chunks, [&](auto c) { return depth.perspective(c); }, spare_.data());
  const double range = extent.high - extent.low;
  // Finite also where the range is subnormal.
  const double scale =
      range > 0 ? std::min(kLastStep / range, std::numeric_limits<double>::max()) : 0;
  for_each_chunk(chunks, [&](std::size_t chunk) {
    for (std::size_t i = chunks.begin(chunk); i < chunks.end(chunk); ++i) {
      const std::uint64_t key = key_of(std::bit_cast<double>(spare_[i]), extent.high, scale);
      entries_[i] = key << 32 | cells[i];
    }
  });

  if (chunks.total < kLeastChunk) {
    sort_bucket<kKeyDigits>(entries_, spare_, order.cells.data());
    return order;
  }
  // Buckets fit the second-level cache, where the remaining passes cost half as much as over all
  // entries.
  const auto begins = spread(chunks, entries_.data(), places_, spare_.data());
  tbb::parallel_for(std::size_t{0}, std::size_t{kDigits}, [&](std::size_t bucket) {
    const std::size_t begin = begins[bucket];
    const std::size_t count = begins[bucket + 1] - begin;
    sort_bucket<kKeyDigits - 1>(std::span(spare_).subspan(begin, count),
                                std::span(entries_).subspan(begin, count),
                                order.cells.data() + begin);
  });
  return order;
}

Order sort_centroid(const mesh::TetMesh& mesh, std::span<const std::uint32_t> cells,
                    const View& view) {
  return CentroidSorter().sort(mesh, cells, view);
}

}  // namespace tetraglass::sort
