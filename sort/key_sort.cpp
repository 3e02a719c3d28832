#include "sort/key_sort.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include <tbb/parallel_for.h>

#include "base/parallel.h"

namespace tetraglass::sort {
namespace {

constexpr std::size_t kFew = 32;     // insertion is faster than clearing counts
constexpr std::size_t kSome = 1024;  // the counts of large digits outweigh the entries

// Sorts to `target`, which may be where the entries are. Stable.
void insertion_sort(std::span<const KeyedItem> entries, std::span<KeyedItem> target) {
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const KeyedItem moved = entries[i];
    std::size_t hole = i;
    for (; hole > 0 && key_of(target[hole - 1]) > key_of(moved); --hole) {
      target[hole] = target[hole - 1];
    }
    target[hole] = moved;
  }
}

// Sorts by the lowest kDigits digits of kBits each, from the lowest one up; `spare` is as long.
template <int kBits, std::size_t kDigits>
void sort_digits(std::span<KeyedItem> entries, std::span<KeyedItem> spare) {
  static_assert(kDigits % 2 == 0, "the result has to end where it began");
  constexpr std::uint32_t kPlaces = 1U << kBits;
  const auto digit = [](KeyedItem entry, std::size_t i) {
    return (key_of(entry) >> (kBits * i)) & (kPlaces - 1);
  };
  std::array<std::array<std::uint32_t, kPlaces>, kDigits> places{};
  for (const KeyedItem entry : entries) {
    for (std::size_t i = 0; i < kDigits; ++i) ++places[i][digit(entry, i)];
  }
  for (std::size_t i = 0; i < kDigits; ++i) {
    std::exclusive_scan(places[i].begin(), places[i].end(), places[i].begin(), 0U);
    for (const KeyedItem entry : entries) spare[places[i][digit(entry, i)]++] = entry;
    std::swap(entries, spare);
  }
}

// Spreads some entries by so many bits that about one falls to each place, and finishes them by
// insertion. False, and nothing done, if a place is crowded.
bool spread_and_insert(std::span<KeyedItem> entries, std::span<KeyedItem> spare) {
  const auto digit = [](KeyedItem entry) { return key_of(entry) >> 14 & (kSome - 1); };
  std::array<std::uint32_t, kSome> places{};
  for (const KeyedItem entry : entries) ++places[digit(entry)];
  std::uint32_t place = 0;
  std::uint32_t most = 0;
  for (std::uint32_t& count : places) {
    most = std::max(most, count);
    place += std::exchange(count, place);
  }
  if (most > kFew) return false;
  for (const KeyedItem entry : entries) spare[places[digit(entry)]++] = entry;
  insertion_sort(spare, entries);
  return true;
}

// Sorts entries whose keys differ in the lower 24 bits only.
void sort_bucket(std::span<KeyedItem> entries, std::span<KeyedItem> spare) {
  if (entries.size() <= kFew) {
    insertion_sort(entries, entries);
  } else if (entries.size() > kSome) {
    sort_digits<12, 2>(entries, spare);
  } else if (!spread_and_insert(entries, spare)) {
    sort_digits<6, 4>(entries, spare);
  }
}

}  // namespace

Chunks::Chunks(std::size_t n) : total(n) {
  constexpr std::size_t kLeast = 16384;
  count = std::clamp(n / kLeast, std::size_t{1}, static_cast<std::size_t>(base::thread_count()));
}

void Chunks::for_each(const std::function<void(std::size_t)>& work) const {
  if (count == 1) {
    work(0);
  } else {
    tbb::parallel_for(std::size_t{0}, count, work, tbb::static_partitioner());
  }
}

std::span<const KeyedItem> KeySorter::sort(std::size_t n, const Write& write, const Take& take) {
  constexpr std::size_t kBlock = 512;  // is still in the first cache when it is counted
  const Chunks chunks(n);
  entries_.resize(n);
  spare_.resize(n);
  counts_.resize(chunks.count);
  chunks.for_each([&](std::size_t chunk) {
    Counts counts{};
    const std::size_t end = chunks.end(chunk);
    for (std::size_t begin = chunks.begin(chunk); begin < end; begin += kBlock) {
      const std::size_t count = std::min(kBlock, end - begin);
      write(begin, count, spare_.data() + begin);
      for (std::size_t i = begin; i < begin + count; ++i) ++counts[first_digit(spare_[i])];
    }
    counts_[chunk] = counts;
  });
  std::array<std::uint32_t, kBuckets + 1> begins{};
  std::uint32_t place = 0;
  for (std::size_t digit = 0; digit < kBuckets; ++digit) {
    begins[digit] = place;
    for (Counts& counts : counts_) place += std::exchange(counts[digit], place);
  }
  begins[kBuckets] = place;
  chunks.for_each([&](std::size_t chunk) {
    Counts places = counts_[chunk];
    for (std::size_t i = chunks.begin(chunk); i < chunks.end(chunk); ++i) {
      entries_[places[first_digit(spare_[i])]++] = spare_[i];
    }
  });
  tbb::parallel_for(std::size_t{0}, kBuckets, [&](std::size_t bucket) {
    const std::size_t begin = begins[bucket];
    const std::size_t count = begins[bucket + 1] - begin;
    const auto entries = std::span(entries_).subspan(begin, count);
    sort_bucket(entries, std::span(spare_).subspan(begin, count));
    if (take) take(entries, begin);
  });
  return entries_;
}

}  // namespace tetraglass::sort
