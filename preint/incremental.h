#pragma once

#include <algorithm>
#include <array>
#include <bit>
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

  [[nodiscard]] bool upwards() const { return upwards_; }

  /// Index on the table's axis of sample i of this direction.
  [[nodiscard]] int node(int i) const { return upwards_ ? i : n_ - 1 - i; }

 private:
  TransferFunction tf_;
  int n_;
  bool upwards_;
  std::vector<double> nodes_;
  std::optional<CellSeries<Span>> cells_;
};

/// Working memory of one thread.
struct RunMemory {
  std::vector<double> cells;
  std::vector<double> tails;
  std::vector<double> spans;
  std::vector<float> rgba;
};

/// Tables of n values (front and back) for several lengths, by incremental subrange integration:
/// `run(length index, crossing, run, memory)` for both crossings and runs of all widths, with the
/// cells in memory and room for the tails; `diagonal(length index)` for the entries with front =
/// back. From several threads.
///
/// Upwards and downwards are the same computation on the transfer function and its mirror image
/// (lum2004 composites "in the opposite direction" below the diagonal). As many neighbouring
/// diagonals as a vector has lanes are computed at once, and written along the rows of the table:
/// diagonal by diagonal, every entry would touch another cache line.
template <class Span, class HandleRun, class Diagonal>
void for_each_run(const TransferFunction& tf, double low, double high, int n,
                  const std::vector<double>& lengths, double tolerance, const HandleRun& handle,
                  const Diagonal& diagonal) {
  const Crossing<Span> upwards(tf, low, high, n, true, tolerance);
  const Crossing<Span> downwards(tf, low, high, n, false, tolerance);
  const auto cell_count = static_cast<std::size_t>(n - 1);
  const std::size_t lanes = run_lanes();
  const std::size_t runs = (cell_count + lanes - 1) / lanes;
  base::parallel_ranges(lengths.size() * runs, 1, [&](std::size_t begin, std::size_t end) {
    const std::size_t block = kSpanSize<Span> * lanes;
    RunMemory memory{std::vector<double>(cell_count * block),
                     std::vector<double>((runs * lanes + lanes + 1) * block),
                     {},
                     {}};
    for (std::size_t task = begin; task < end; ++task) {
      const std::size_t l = task / runs;
      for (const Crossing<Span>* crossing : {&upwards, &downwards}) {
        // Lanes along the rows of the table.
        const Run run{1 + task % runs * lanes, crossing == &upwards, lanes};
        std::array<double, kMostLanes> cell_lengths{};
        for (std::size_t lane = 0; lane < lanes; ++lane) {
          cell_lengths[lane] = lengths[l] / static_cast<double>(run.width(lane));
        }
        crossing->cells().evaluate(cell_lengths.data(), memory.cells.data());
        handle(l, *crossing, run, memory);
      }
      if (task % runs == 0) diagonal(l);
    }
  });
}

/// Every entry: `write(length index, front index, back index, span, cells)` from several threads,
/// each entry once; `cells` is the width of the span, 1 where front = back (the constant medium).
template <class Span, class Write>
void incremental_entries(const TransferFunction& tf, double low, double high, int n,
                         const std::vector<double>& lengths, double tolerance, const Write& write) {
  const auto cell_count = static_cast<std::size_t>(n - 1);
  const std::size_t lanes = run_lanes();
  const auto handle = [&](std::size_t l, const Crossing<Span>& crossing, Run run,
                          RunMemory& memory) {
    memory.spans.resize(span_offset(kSpanSize<Span>, lanes, cell_count + 1, 0));
    compose_subranges(memory.cells.data(), cell_count, kSpanSize<Span>, run, memory.tails.data(),
                      memory.spans.data());
    for (std::size_t end = run.narrowest; end <= cell_count; ++end) {
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        if (run.width(lane) > end) continue;
        std::array<double, kSpanSize<Span>> doubles;
        for (std::size_t part = 0; part < doubles.size() / 4; ++part) {
          const std::size_t at = span_offset(doubles.size(), lanes, end, lane, part);
          std::copy_n(&memory.spans[at], 4, &doubles[4 * part]);
        }
        const int back = static_cast<int>(end);
        const int cells = static_cast<int>(run.width(lane));
        write(l, crossing.node(back - cells), crossing.node(back), std::bit_cast<Span>(doubles),
              cells);
      }
    }
  };
  for_each_run<Span>(tf, low, high, n, lengths, tolerance, handle, [&](std::size_t l) {
    for (int i = 0; i < n; ++i) {
      const double value = table_node(low, high, n, i);
      write(l, i, i, exact_span<Span>(tf, {value, value, lengths[l]}, tolerance), 1);
    }
  });
}

}  // namespace tetraglass::preint
