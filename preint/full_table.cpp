#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/errors.h"
#include "base/parallel.h"
#include "preint/table.h"
#include "preint/table_axis.h"
#include "preint/table_entries.h"

namespace tetraglass::preint {
namespace {

void write_entry(float* rgba, const LightSpan& span) {
  rgba[0] = static_cast<float>(span.red);
  rgba[1] = static_cast<float>(span.green);
  rgba[2] = static_cast<float>(span.blue);
  rgba[3] = static_cast<float>(1 - span.transmittance);
}

/// Entries [length][back][front], RGBA, for all the lengths, by incremental subrange integration.
Entries incremental_rgba(const TransferFunction& tf, double low, double high, int n,
                         const std::vector<double>& lengths) {
  const auto size = static_cast<std::size_t>(n);
  const std::size_t lanes = run_lanes();
  Entries rgba(4 * size * size * lengths.size());
  const auto place = [&](std::size_t l, std::size_t front, std::size_t back) {
    return &rgba[4 * ((l * size + back) * size + front)];
  };
  const auto handle = [&](std::size_t l, const Crossing<LightSpan>& crossing, const Run& run,
                          const double* cell_lengths, RunMemory& memory) {
    evaluate_cells(crossing, run, cell_lengths, memory);
    memory.rgba.resize(4 * lanes * size);
    compose_entries(memory.cells.data(), size - 1, run, memory.tails.data(), memory.rgba.data());
    for (std::size_t end = run.narrowest; end < size; ++end) {
      // The lanes whose ranges begin on the axis; neighbours in the row.
      const std::size_t count = std::min(lanes, end - run.narrowest + 1);
      const std::size_t first = run.descending ? lanes - count : 0;
      const std::size_t front = end - run.width(first);
      const float* entries = &memory.rgba[4 * (end * lanes + first)];
      float* row =
          crossing.upwards() ? place(l, front, end) : place(l, size - 1 - front, size - 1 - end);
      std::copy_n(entries, 4 * count, row);
    }
  };
  const auto diagonal = [&](std::size_t l) {
    for (std::size_t i = 0; i < size; ++i) {
      const double value = table_node(low, high, n, static_cast<int>(i));
      write_entry(place(l, i, i),
                  exact_span<LightSpan>(tf, {value, value, lengths[l]}, kFloatTolerance));
    }
  };
  for_each_run<LightSpan>(tf, low, high, n, lengths, kFloatTolerance, TableMethod::incremental,
                          handle, diagonal);
  return rgba;
}

Entries full_entries(const TransferFunction& tf, double low, double high, int n,
                     const std::vector<double>& lengths, TableMethod method) {
  if (method == TableMethod::incremental) return incremental_rgba(tf, low, high, n, lengths);
  const auto size = static_cast<std::size_t>(n);
  Entries rgba(4 * size * size * lengths.size());
  table_entries<LightSpan>(
      tf, low, high, n, lengths, kFloatTolerance, method,
      [&](std::size_t l, int front, int back, const LightSpan& span, int /*cells*/) {
        const std::size_t row = l * size + static_cast<std::size_t>(back);
        write_entry(&rgba[4 * (row * size + static_cast<std::size_t>(front))], span);
      });
  return rgba;
}

}  // namespace

Table2D slab_table(const TransferFunction& tf, double low, double high, double length, int n,
                   TableMethod method) {
  check_axis(low, high, n);
  check_length(length);
  return {n, low, high, full_entries(tf, low, high, n, {length}, method), {}};
}

Table3D full_table(const TransferFunction& tf, double low, double high, double max_length, int n,
                   int m, TableMethod method, LengthAxis axis) {
  check_axis(low, high, n);
  const std::vector<double> lengths = table_lengths(axis, max_length, m);
  return {n, m, low, high, max_length, full_entries(tf, low, high, n, lengths, method), axis, {}};
}

}  // namespace tetraglass::preint
