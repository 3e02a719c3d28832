#include "sort/centroid.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace tetraglass::sort {
namespace {

// Digits of 11 bits: three passes, and the 2048 counts of a pass fit the first-level cache.
constexpr int kDigitBits = 11;
constexpr std::uint32_t kDigits = 1U << kDigitBits;

// A chunk has to outweigh its 2048 counts, and the start of a task.
constexpr std::size_t kLeastChunk = 32768;

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

// The depth of centroids less the depth of a reference point, four times as large in a parallel
// view (only the order counts). Coordinates are taken relative to the reference before anything is
// rounded; the difference of two distances |v + w| - |w| is (|v|^2 + 2 v.w) / (|v + w| + |w|),
// which does not cancel however far the eye is.
class Depth {
 public:
  Depth(const mesh::TetMesh& mesh, const Eigen::Vector3d& reference, const View& view)
      : points_(mesh.points.data()),
        cells_(mesh.cells.data()),
        reference_(reference),
        direction_(view.direction),
        to_reference_(reference - view.eye),
        distance_(to_reference_.norm()) {}

  [[nodiscard]] double parallel(std::uint32_t cell) const { return direction_.dot(sum(cell)); }

  [[nodiscard]] double perspective(std::uint32_t cell) const {
    const Eigen::Vector3d v = 0.25 * sum(cell);
    const double both = (v + to_reference_).norm() + distance_;
    return both > 0 ? v.dot(v + 2 * to_reference_) / both : 0;
  }

 private:
  [[nodiscard]] Eigen::Vector3d sum(std::uint32_t index) const {
    const mesh::Cell& cell = cells_[index];
    return ((points_[cell[0]] - reference_) + (points_[cell[1]] - reference_)) +
           ((points_[cell[2]] - reference_) + (points_[cell[3]] - reference_));
  }

  const Eigen::Vector3d* points_;
  const mesh::Cell* cells_;
  Eigen::Vector3d reference_;
  Eigen::Vector3d direction_;
  Eigen::Vector3d to_reference_;
  double distance_;
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

// 0 for the farthest depth (and for NaN), 2^32 - 1 for the nearest.
std::uint32_t key_of(double depth, double farthest, double scale) {
  const double steps = (farthest - depth) * scale;
  if (!(steps > 0)) return 0;
  return static_cast<std::uint32_t>(std::min(steps, 4294967295.0));
}

// Turns the counts of each digit in each chunk into the place where the chunk puts its first entry
// of that digit: digits in order, within a digit the chunks in order, which makes the sort stable.
void counts_to_places(std::vector<std::uint32_t>& counts, std::size_t chunk_count) {
  std::uint32_t place = 0;
  for (std::size_t digit = 0; digit < kDigits; ++digit) {
    for (std::size_t chunk = 0; chunk < chunk_count; ++chunk) {
      place += std::exchange(counts[chunk * kDigits + digit], place);
    }
  }
}

std::uint32_t digit_of(std::uint64_t entry, int shift) {
  return static_cast<std::uint32_t>(entry >> (32 + shift)) & (kDigits - 1);
}

void count_digits(const Chunks& chunks, const std::uint64_t* entries, int shift,
                  std::vector<std::uint32_t>& counts) {
  for_each_chunk(chunks, [&](std::size_t chunk) {
    std::uint32_t* mine = counts.data() + chunk * kDigits;
    std::fill_n(mine, kDigits, 0U);
    for (std::size_t i = chunks.begin(chunk); i < chunks.end(chunk); ++i) {
      ++mine[digit_of(entries[i], shift)];
    }
  });
}

// One pass: every entry goes to its place by the digit at `shift`. To: std::uint64_t keeps the
// entry, std::uint32_t only its cell (the low half).
template <typename To>
void scatter(const Chunks& chunks, const std::uint64_t* entries, int shift,
             std::vector<std::uint32_t>& places, To* target) {
  for_each_chunk(chunks, [&](std::size_t chunk) {
    std::uint32_t* mine = places.data() + chunk * kDigits;
    for (std::size_t i = chunks.begin(chunk); i < chunks.end(chunk); ++i) {
      target[mine[digit_of(entries[i], shift)]++] = static_cast<To>(entries[i]);
    }
  });
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
  counts_.resize(chunks.count * kDigits);

  const Depth depth(mesh, reference_point(mesh, cells), view);
  const Extent extent =
      view.parallel
          ? write_depths(
                cells, chunks, [&](auto c) { return depth.parallel(c); }, spare_.data())
          : write_depths(
                cells, chunks, [&](auto c) { return depth.perspective(c); }, spare_.data());
  const double range = extent.high - extent.low;
  const double scale = range > 0 ? 4294967295.0 / range : 0;
  for_each_chunk(chunks, [&](std::size_t chunk) {
    for (std::size_t i = chunks.begin(chunk); i < chunks.end(chunk); ++i) {
      const std::uint64_t key = key_of(std::bit_cast<double>(spare_[i]), extent.high, scale);
      entries_[i] = key << 32 | cells[i];
    }
  });

  count_digits(chunks, entries_.data(), 0, counts_);
  counts_to_places(counts_, chunks.count);
  scatter(chunks, entries_.data(), 0, counts_, spare_.data());
  count_digits(chunks, spare_.data(), kDigitBits, counts_);
  counts_to_places(counts_, chunks.count);
  scatter(chunks, spare_.data(), kDigitBits, counts_, entries_.data());
  count_digits(chunks, entries_.data(), 2 * kDigitBits, counts_);
  counts_to_places(counts_, chunks.count);
  scatter(chunks, entries_.data(), 2 * kDigitBits, counts_, order.cells.data());
  return order;
}

Order sort_centroid(const mesh::TetMesh& mesh, std::span<const std::uint32_t> cells,
                    const View& view) {
  return CentroidSorter().sort(mesh, cells, view);
}

}  // namespace tetraglass::sort
