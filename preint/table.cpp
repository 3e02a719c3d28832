#include "preint/table.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/errors.h"
#include "base/parallel.h"
#include "preint/segment_integral.h"
#include "preint/table_axis.h"

namespace tetraglass::preint {
namespace {

/// Fills the row of entries of `back`, whose index is `row`, with entry(front, back).
template <class Entry>
void fill_row(float* row, int n, double low, double high, double back, const Entry& entry) {
  for (int f = 0; f < n; ++f) {
    const Eigen::Array4d rgba = entry(table_node(low, high, n, f), back);
    for (int channel = 0; channel < 4; ++channel) {
      row[4 * f + channel] = static_cast<float>(rgba[channel]);
    }
  }
}

template <class Entry>
Table2D table_2d(double low, double high, int n, const Entry& entry) {
  check_axis(low, high, n);
  const auto size = static_cast<std::size_t>(n);
  Table2D table{n, low, high, Entries(4 * size * size), {}};
  base::parallel_ranges(size, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      const double back = table_node(low, high, n, static_cast<int>(b));
      fill_row(&table.rgba[4 * size * b], n, low, high, back, entry);
    }
  });
  return table;
}

/// A table that is the same in both directions, from `entry` of single cells: ranges grow cell by
/// cell, or (brute force) begin anew for every entry.
template <class Entry, class Join, class Finish>
Table2D joined_cells(double low, double high, int n, TableMethod method, const Entry& entry,
                     const Join& join, const Finish& finish) {
  check_axis(low, high, n);
  const auto size = static_cast<std::size_t>(n);
  const auto node = [&](std::size_t i) { return table_node(low, high, n, static_cast<int>(i)); };
  std::vector<Eigen::Array4d> cells(size - 1);
  for (std::size_t i = 0; i + 1 < size; ++i) cells[i] = entry(node(i), node(i + 1));
  Table2D table{n, low, high, Entries(4 * size * size), {}};
  const auto set = [&](std::size_t front, std::size_t back, const Eigen::Array4d& value) {
    Eigen::Map<Eigen::Array4f>(&table.rgba[4 * (back * size + front)]) = value.cast<float>();
  };
  const auto range = [&](std::size_t first, std::size_t last) {
    Eigen::Array4d sum = cells[first];
    for (std::size_t cell = first + 1; cell < last; ++cell) sum = join(sum, cells[cell]);
    return sum;
  };
  base::parallel_ranges(size, 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t first = begin; first < end; ++first) {
      set(first, first, entry(node(first), node(first)));
      if (first + 1 == size) continue;
      Eigen::Array4d sum = cells[first];
      for (std::size_t last = first + 1; last < size; ++last) {
        const auto width = static_cast<int>(last - first);
        if (method == TableMethod::brute_force) {
          set(first, last, finish(range(first, last), width));
          set(last, first, finish(range(first, last), width));
          continue;
        }
        if (last > first + 1) sum = join(sum, cells[last - 1]);
        const Eigen::Array4d value = finish(sum, width);
        set(first, last, value);
        set(last, first, value);
      }
    }
  });
  return table;
}

Eigen::Array4d rgba(const Color& color, double a) {
  return {color[0], color[1], color[2], a};
}

}  // namespace

void check_axis(double low, double high, int n) {
  if (n < 2) throw base::UsageError(fmt::format("a table needs at least 2 values, not {}", n));
  if (!(low < high) || !std::isfinite(high - low)) {
    throw base::UsageError(
        fmt::format("a table needs a range with low < high, both finite, not {}:{}", low, high));
  }
}

void check_length(double length) {
  if (!(length >= 0) || !std::isfinite(length)) {
    throw base::UsageError(fmt::format("the length of a segment cannot be {}", length));
  }
}

std::vector<double> table_lengths(LengthAxis axis, double max_length, int m) {
  if (m < 2) throw base::UsageError(fmt::format("a table needs at least 2 lengths, not {}", m));
  if (!(max_length > 0) || !std::isfinite(max_length)) {
    throw base::UsageError(fmt::format("the longest length must be positive, not {}", max_length));
  }
  std::vector<double> lengths;
  for (int l = 0; l < m; ++l) lengths.push_back(length_at(axis, max_length, m, l));
  return lengths;
}

double table_node(double low, double high, int n, int i) {
  const double t = static_cast<double>(i) / (n - 1);
  return low * (1 - t) + high * t;
}

namespace {

/// Logarithmic: length = max_length expm1(kStretch t) / expm1(kStretch), t in [0, 1].
const double kStretch = std::log(1024.0);

}  // namespace

double length_at(LengthAxis axis, double max_length, int m, double coordinate) {
  const double t = coordinate / (m - 1);
  if (axis == LengthAxis::linear || t == 1) return max_length * t;
  return max_length * (std::expm1(kStretch * t) / std::expm1(kStretch));
}

double length_coordinate(LengthAxis axis, double max_length, int m, double length) {
  const double x = length / max_length;
  const double t = axis == LengthAxis::linear ? x : std::log1p(x * std::expm1(kStretch)) / kStretch;
  return t * (m - 1);
}

Table2D emission_table(const TransferFunction& tf, double low, double high, int n,
                       TableMethod method) {
  const auto mean = [&](double front, double back) {
    const Segment segment{front, back, 1};
    return rgba(integrate_emission(tf, segment), optical_depth(tf, segment));
  };
  if (method == TableMethod::exact) return table_2d(low, high, n, mean);
  // Sums, not differences of one running integral: all terms are positive, so nothing cancels.
  const auto join = [](const Eigen::Array4d& a, const Eigen::Array4d& b) { return (a + b).eval(); };
  const auto average = [](const Eigen::Array4d& sum, int cells) { return (sum / cells).eval(); };
  return joined_cells(low, high, n, method, mean, join, average);
}

Table2D mip_table(const TransferFunction& tf, double low, double high, int n, TableMethod method,
                  MipOf of) {
  if (of == MipOf::field) {
    // The largest value of a linear segment is at one of its ends: nothing to integrate.
    return table_2d(low, high, n, [&](double front, double back) {
      return rgba(tf.at(std::max(front, back)).color, 1);
    });
  }
  const auto largest = [&](double front, double back) {
    return rgba(max_color(tf, front, back), 1);
  };
  if (method == TableMethod::exact) return table_2d(low, high, n, largest);
  const auto join = [](const Eigen::Array4d& a, const Eigen::Array4d& b) {
    return a.max(b).eval();
  };
  const auto itself = [](const Eigen::Array4d& largest_so_far, int) { return largest_so_far; };
  return joined_cells(low, high, n, method, largest, join, itself);
}

}  // namespace tetraglass::preint
