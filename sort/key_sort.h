#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace tetraglass::sort {

/// A number in the upper half to sort by, and what is sorted in the lower one.
using KeyedItem = std::uint64_t;

[[nodiscard]] inline KeyedItem keyed(std::uint32_t key, std::uint32_t item) {
  return KeyedItem{key} << 32 | item;
}
[[nodiscard]] inline std::uint32_t key_of(KeyedItem entry) {
  return static_cast<std::uint32_t>(entry >> 32);
}
[[nodiscard]] inline std::uint32_t item_of(KeyedItem entry) {
  return static_cast<std::uint32_t>(entry);
}

/// Work cut into pieces of about the same length, one for each thread; a piece is long enough to
/// outweigh the start of a task.
struct Chunks {
  std::size_t total;
  std::size_t count = 1;

  explicit Chunks(std::size_t n);
  [[nodiscard]] std::size_t begin(std::size_t chunk) const { return total * chunk / count; }
  [[nodiscard]] std::size_t end(std::size_t chunk) const { return begin(chunk + 1); }

  /// Calls work(chunk) for every chunk, in parallel if there are several.
  void for_each(const std::function<void(std::size_t)>& work) const;
};

/// Sorts items by keys of 32 bits, the smallest first; items of equal keys stay in order. In
/// parallel, with a result that does not depend on the number of threads. Keeps its buffers (16
/// bytes per item).
///
/// Radix sort, the highest digit first: one pass over all entries spreads them into 256 buckets by
/// their first eight bits; buckets, which mostly fit the cache, are sorted by two digits of twelve
/// bits, the lowest first (Knuth, The Art of Computer Programming, vol. 3, 5.2.5). Cost: linear,
/// whichever the keys; where most of them share their first bits the threads share the work
/// unevenly.
class KeySorter {
 public:
  /// Called with a range of the sorted entries and the place of its first one, while they are in
  /// the cache, by several threads.
  using Take = std::function<void(std::span<const KeyedItem> entries, std::size_t place)>;

  /// Writes `count` entries, from the one of number `begin` on, to `target`.
  using Write = std::function<void(std::size_t begin, std::size_t count, KeyedItem* target)>;

  /// Sorts the n entries that `write` writes, some at a time, by several threads. The result is
  /// valid until the next call.
  std::span<const KeyedItem> sort(std::size_t n, const Write& write, const Take& take = {});

 private:
  static constexpr int kFirstBits = 8;
  static constexpr std::size_t kBuckets = std::size_t{1} << kFirstBits;
  using Counts = std::array<std::uint32_t, kBuckets>;
  static std::uint32_t first_digit(KeyedItem entry) { return key_of(entry) >> (32 - kFirstBits); }

  std::vector<KeyedItem> entries_;
  std::vector<KeyedItem> spare_;
  std::vector<Counts> counts_;  // of the first digit in each chunk
};

}  // namespace tetraglass::sort
