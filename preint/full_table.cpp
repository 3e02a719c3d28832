#include <cmath>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "base/errors.h"
#include "base/parallel.h"
#include "preint/incremental.h"
#include "preint/table.h"
#include "preint/table_axis.h"

namespace tetraglass::preint {
namespace {

/// Entries [length][back][front], RGBA, for all the lengths.
Entries full_entries(const TransferFunction& tf, double low, double high, int n,
                     const std::vector<double>& lengths, TableMethod method) {
  const auto size = static_cast<std::size_t>(n);
  Entries rgba(4 * size * size * lengths.size());
  const auto write = [&](std::size_t l, int front, int back, const LightSpan& span, int /*cells*/) {
    float* entry = &rgba[4 * ((l * size + static_cast<std::size_t>(back)) * size +
                              static_cast<std::size_t>(front))];
    entry[0] = static_cast<float>(span.red);
    entry[1] = static_cast<float>(span.green);
    entry[2] = static_cast<float>(span.blue);
    entry[3] = static_cast<float>(1 - span.transmittance);
  };
  if (method == TableMethod::incremental) {
    incremental_entries<LightSpan>(tf, low, high, n, lengths, kFloatTolerance, write);
    return rgba;
  }
  base::parallel_ranges(lengths.size() * size, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      const double length = lengths[row / size];
      const int back = static_cast<int>(row % size);
      const double to = table_node(low, high, n, back);
      for (int front = 0; front < n; ++front) {
        const Segment segment{table_node(low, high, n, front), to, length};
        write(row / size, front, back, exact_span<LightSpan>(tf, segment, kFloatTolerance), 1);
      }
    }
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
  if (m < 2) throw base::UsageError(fmt::format("a table needs at least 2 lengths, not {}", m));
  if (!(max_length > 0) || !std::isfinite(max_length)) {
    throw base::UsageError(fmt::format("the longest length must be positive, not {}", max_length));
  }
  std::vector<double> lengths(static_cast<std::size_t>(m));
  for (int l = 0; l < m; ++l) {
    lengths[static_cast<std::size_t>(l)] = length_at(axis, max_length, m, l);
  }
  return {n, m, low, high, max_length, full_entries(tf, low, high, n, lengths, method), axis, {}};
}

}  // namespace tetraglass::preint
