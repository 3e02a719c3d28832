#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <vector>

#include "base/parallel.h"
#include "preint/brute_force.h"
#include "preint/cell_series.h"
#include "preint/table.h"

namespace tetraglass::preint {

/// One direction of crossing a table's axis: upwards in `tf`, or in its mirror image.
template <class Span>
class Crossing {
 public:
  Crossing(const TransferFunction& tf, double low, double high, int n, bool upwards,
           double tolerance, TableMethod method)
      : tf_(upwards ? tf : mirrored(tf)), n_(n), upwards_(upwards) {
    for (int i = 0; i < n; ++i) {
      nodes_.push_back(upwards ? table_node(low, high, n, i)
                               : -table_node(low, high, n, n - 1 - i));
    }
    if (method == TableMethod::incremental) {
      series_.emplace(tf_, nodes_, tolerance);
    } else {
      pieces_ = cell_pieces(tf_, nodes_);
    }
  }
  Crossing(const Crossing&) = delete;
  Crossing& operator=(const Crossing&) = delete;

  /// For the incremental method ...
  [[nodiscard]] const CellSeries<Span>& series() const { return *series_; }

  /// ... and for brute force.
  [[nodiscard]] const CellPieces& pieces() const { return pieces_; }

  [[nodiscard]] bool upwards() const { return upwards_; }

  /// Index on the table's axis of sample i of this direction.
  [[nodiscard]] int node(int i) const { return upwards_ ? i : n_ - 1 - i; }

 private:
  TransferFunction tf_;
  int n_;
  bool upwards_;
  std::vector<double> nodes_;
  std::optional<CellSeries<Span>> series_;
  CellPieces pieces_;
};

/// Working memory of one thread.
struct RunMemory {
  std::vector<double> cells;
  std::vector<double> tails;
  std::vector<double> spans;
  std::vector<float> rgba;
};

/// Tables of n values (front and back) for several lengths, by the incremental method or by brute
/// force: `handle(length index, crossing, run, lengths of a cell, memory)` for both crossings and
/// runs of all widths; `diagonal(length index)` for the entries with front = back. From several
/// threads.
///
/// Upwards and downwards are the same computation on the transfer function and its mirror image
/// (lum2004 composites "in the opposite direction" below the diagonal). As many neighbouring
/// diagonals as a vector has lanes are computed at once, and written along the rows of the table:
/// diagonal by diagonal, every entry would touch another cache line.
template <class Span, class HandleRun, class Diagonal>
void for_each_run(const TransferFunction& tf, double low, double high, int n,
                  const std::vector<double>& lengths, double tolerance, TableMethod method,
                  const HandleRun& handle, const Diagonal& diagonal) {
  const Crossing<Span> upwards(tf, low, high, n, true, tolerance, method);
  const Crossing<Span> downwards(tf, low, high, n, false, tolerance, method);
  const std::size_t lanes = run_lanes();
  const std::size_t runs = (static_cast<std::size_t>(n - 1) + lanes - 1) / lanes;
  const std::size_t tasks = lengths.size() * runs;
  // Few and large pieces: each allocates its working memory anew.
  const std::size_t grain = tasks / (4 * static_cast<std::size_t>(base::thread_count()));
  base::parallel_ranges(tasks, grain, [&](std::size_t begin, std::size_t end) {
    RunMemory memory;
    for (std::size_t task = begin; task < end; ++task) {
      const std::size_t l = task / runs;
      for (const Crossing<Span>* crossing : {&upwards, &downwards}) {
        // Lanes along the rows of the table.
        const Run run{1 + task % runs * lanes, crossing == &upwards, lanes};
        std::array<double, kMostLanes> cell_lengths{};
        for (std::size_t lane = 0; lane < lanes; ++lane) {
          cell_lengths[lane] = lengths[l] / static_cast<double>(run.width(lane));
        }
        handle(l, *crossing, run, cell_lengths.data(), memory);
      }
      if (task % runs == 0) diagonal(l);
    }
  });
}

/// All cells of the crossing, in memory, with room for the tails of the run.
template <class Span>
void evaluate_cells(const Crossing<Span>& crossing, const Run& run, const double* lengths,
                    RunMemory& memory) {
  const std::size_t block = kSpanSize<Span> * run.lanes;
  memory.cells.resize(crossing.series().size() * block);
  memory.tails.resize((crossing.series().size() + 2 * run.lanes) * block);
  crossing.series().evaluate(lengths, memory.cells.data());
}

/// Every entry integrated on its own, split at the control points: write as for table_entries.
template <class Span, class Write>
void exact_entries(const TransferFunction& tf, double low, double high, int n,
                   const std::vector<double>& lengths, double tolerance, const Write& write) {
  const auto size = static_cast<std::size_t>(n);
  base::parallel_ranges(lengths.size() * size, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      const int back = static_cast<int>(row % size);
      for (int front = 0; front < n; ++front) {
        const Segment segment{table_node(low, high, n, front), table_node(low, high, n, back),
                              lengths[row / size]};
        write(row / size, front, back, exact_span<Span>(tf, segment, tolerance), 1);
      }
    }
  });
}

/// Every entry: `write(length index, front index, back index, span, cells)` from several threads,
/// each entry once; ramps of the span rise from 0 to `cells`.
template <class Span, class Write>
void table_entries(const TransferFunction& tf, double low, double high, int n,
                   const std::vector<double>& lengths, double tolerance, TableMethod method,
                   const Write& write) {
  if (method == TableMethod::exact) {
    exact_entries<Span>(tf, low, high, n, lengths, tolerance, write);
    return;
  }
  const auto size = static_cast<std::size_t>(n);
  const auto handle = [&](std::size_t l, const Crossing<Span>& crossing, const Run& run,
                          const double* cell_lengths, RunMemory& memory) {
    memory.spans.resize(span_offset(kSpanSize<Span>, run.lanes, size, 0));
    if (method == TableMethod::incremental) {
      evaluate_cells(crossing, run, cell_lengths, memory);
      compose_subranges(memory.cells.data(), size - 1, kSpanSize<Span>, run, memory.tails.data(),
                        memory.spans.data());
    } else {
      brute_force_subranges(crossing.pieces(), kSpanSize<Span>, run, cell_lengths, tolerance,
                            memory.spans.data());
    }
    for (std::size_t end = run.narrowest; end < size; ++end) {
      for (std::size_t lane = 0; lane < run.lanes; ++lane) {
        if (run.width(lane) > end) continue;
        std::array<double, kSpanSize<Span>> doubles;
        for (std::size_t part = 0; part < doubles.size() / 4; ++part) {
          const std::size_t at = span_offset(doubles.size(), run.lanes, end, lane, part);
          std::copy_n(&memory.spans[at], 4, &doubles[4 * part]);
        }
        const int back = static_cast<int>(end);
        const int cells = static_cast<int>(run.width(lane));
        write(l, crossing.node(back - cells), crossing.node(back), std::bit_cast<Span>(doubles),
              cells);
      }
    }
  };
  for_each_run<Span>(tf, low, high, n, lengths, tolerance, method, handle, [&](std::size_t l) {
    for (int i = 0; i < n; ++i) {
      const double value = table_node(low, high, n, i);
      write(l, i, i, exact_span<Span>(tf, {value, value, lengths[l]}, tolerance), 1);
    }
  });
}

}  // namespace tetraglass::preint
