#include "preint/ramped_table.h"

#include <algorithm>

#include "preint/table_axis.h"
#include "preint/table_entries.h"

namespace tetraglass::preint {
namespace {

void set_entry(Table2D& table, int front, int back, const Eigen::Array4d& rgba) {
  const auto n = static_cast<std::size_t>(table.n);
  const auto at = static_cast<std::size_t>(back) * n + static_cast<std::size_t>(front);
  for (std::size_t c = 0; c < 4; ++c) {
    table.rgba[4 * at + c] = static_cast<float>(rgba[static_cast<long>(c)]);
  }
}

/// `write(front, back, span)` for every entry, the ramps of the span from 0 to 1.
template <class Write>
void ramped_entries(const TransferFunction& tf, double low, double high, double length, int n,
                    TableMethod method, const Write& write) {
  check_axis(low, high, n);
  check_length(length);
  table_entries<RampedSpan>(tf, low, high, n, {length}, kFloatTolerance, method,
                            [&](std::size_t, int front, int back, RampedSpan span, int cells) {
                              for (double* ramped : {&span.ramped_red, &span.ramped_green,
                                                     &span.ramped_blue, &span.ramped_white}) {
                                *ramped /= cells;
                              }
                              write(front, back, span);
                            });
}

Table2D empty_table(double low, double high, int n) {
  const auto size = static_cast<std::size_t>(std::max(n, 0));
  return {n, low, high, Entries(4 * size * size), {}};
}

}  // namespace

RampedTables ramped_tables(const TransferFunction& tf, double low, double high, double length,
                           int n, TableMethod method) {
  RampedTables tables{empty_table(low, high, n), empty_table(low, high, n)};
  ramped_entries(tf, low, high, length, n, method, [&](int front, int back, const RampedSpan& s) {
    set_entry(tables.front, front, back,
              {s.red - s.ramped_red, s.green - s.ramped_green, s.blue - s.ramped_blue, s.opacity});
    set_entry(tables.back, front, back,
              {s.ramped_red, s.ramped_green, s.ramped_blue, s.ramped_white});
  });
  return tables;
}

Table2D material_table(const TransferFunction& tf, double low, double high, double length, int n,
                       TableMethod method) {
  const TransferFunction materials = materials_as_colors(tf);
  Table2D table = empty_table(low, high, n);
  const auto write = [&](int front, int back, const RampedSpan& s) {
    if (s.opacity > 0) {
      const double weight = std::min(1.0, s.ramped_white / s.opacity);
      set_entry(table, front, back,
                {s.red / s.opacity, s.green / s.opacity, s.blue / s.opacity, weight});
      return;
    }
    const Color mean = 0.5 * materials.at(table_node(low, high, n, front)).color +
                       0.5 * materials.at(table_node(low, high, n, back)).color;
    set_entry(table, front, back, {mean[0], mean[1], mean[2], 0.5});
  };
  ramped_entries(materials, low, high, length, n, method, write);
  return table;
}

}  // namespace tetraglass::preint
