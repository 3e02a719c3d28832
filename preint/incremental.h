#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "base/parallel.h"
#include "preint/cell_series.h"
#include "preint/table.h"

namespace tetraglass::preint {

/// One direction of crossing a table's axis: upwards in `tf`, or in its mirror image.
template <class Span>
class Crossing {
 public:
  Crossing(const TransferFunction& tf, double low, double high, int n, bool upwards,
           double tolerance)
      : tf_(upwards ? tf : mirrored(tf)), n_(n), upwards_(upwards) {
    for (int i = 0; i < n; ++i) {
      nodes_.push_back(upwards ? table_node(low, high, n, i)
                               : -table_node(low, high, n, n - 1 - i));
    }
    cells_.emplace(tf_, nodes_, tolerance);
  }
  Crossing(const Crossing&) = delete;
  Crossing& operator=(const Crossing&) = delete;

  [[nodiscard]] const CellSeries<Span>& cells() const { return *cells_; }

  /// Index on the table's axis of sample i of this direction.
  [[nodiscard]] int node(int i) const { return upwards_ ? i : n_ - 1 - i; }

 private:
  TransferFunction tf_;
  int n_;
  bool upwards_;
  std::vector<double> nodes_;
  std::optional<CellSeries<Span>> cells_;
};

/// Every entry of tables of n values (front and back) for several lengths, by incremental subrange
/// integration: `write(length index, front index, back index, span, cells)` from several threads,
/// each entry once; `cells` is the width of the span, 1 where front = back (the constant medium).
///
/// Upwards and downwards are the same computation on the transfer function and its mirror image
/// (lum2004 composites "in the opposite direction" below the diagonal). Neighbouring diagonals are
/// kept until a run of them can be written along the rows of the table: diagonal by diagonal, every
/// entry would touch another cache line.
template <class Span, class Write>
void incremental_entries(const TransferFunction& tf, double low, double high, int n,
                         const std::vector<double>& lengths, double tolerance, const Write& write) {
  constexpr int kRun = 8;
  const Crossing<Span> upwards(tf, low, high, n, true, tolerance);
  const Crossing<Span> downwards(tf, low, high, n, false, tolerance);
  struct Memory {
    std::vector<Span> cells;
    std::vector<Span> tails;
    std::vector<Span> run;  // [diagonal in the run][back]
  };
  const auto size = static_cast<std::size_t>(n);
  const int runs = (n - 1 + kRun - 1) / kRun;
  const auto crossing_run = [&](std::size_t l, const Crossing<Span>& crossing, int run,
                                Memory& memory) {
    const int first = 1 + run * kRun;  // the narrowest diagonal
    const int last = std::min(first + kRun, n) - 1;
    for (int d = first; d <= last; ++d) {
      crossing.cells().evaluate(lengths[l] / d, memory.cells);
      Span* diagonal = &memory.run[static_cast<std::size_t>(d - first) * size];
      const auto width = static_cast<std::size_t>(d);
      for_each_subrange(memory.cells, size - 1, width, memory.tails,
                        [&](std::size_t i, const Span& span) { diagonal[i + width] = span; });
    }
    for (int back = first; back < n; ++back) {
      for (int d = first; d <= std::min(last, back); ++d) {
        const Span& span =
            memory.run[static_cast<std::size_t>(d - first) * size + static_cast<std::size_t>(back)];
        write(l, crossing.node(back - d), crossing.node(back), span, d);
      }
    }
  };
  const auto task_count = lengths.size() * static_cast<std::size_t>(runs);
  base::parallel_ranges(task_count, 1, [&](std::size_t begin, std::size_t end) {
    Memory memory{std::vector<Span>(upwards.cells().padded()), std::vector<Span>(size - 1),
                  std::vector<Span>(kRun * size)};
    for (std::size_t task = begin; task < end; ++task) {
      const std::size_t l = task / static_cast<std::size_t>(runs);
      const int run = static_cast<int>(task % static_cast<std::size_t>(runs));
      crossing_run(l, upwards, run, memory);
      crossing_run(l, downwards, run, memory);
      if (run > 0) continue;
      for (int i = 0; i < n; ++i) {
        const double value = table_node(low, high, n, i);
        write(l, i, i, exact_span<Span>(tf, {value, value, lengths[l]}, tolerance), 1);
      }
    }
  });
}

}  // namespace tetraglass::preint
