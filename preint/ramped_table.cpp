#include "preint/ramped_table.h"

#include <algorithm>
#include <cmath>

#include "preint/table_axis.h"
#include "preint/table_entries.h"

namespace tetraglass::preint {
namespace {

void set_entry(float* entry, const Eigen::Array4d& rgba) {
  Eigen::Map<Eigen::Array4f>(entry, 4) = rgba.cast<float>();
}

/// `write(entry, front, back, span)` for every entry of a table of n x n values for each length,
/// the ramps of the span from 0 to 1.
template <class Write>
void ramped_entries(const TransferFunction& tf, double low, double high,
                    const std::vector<double>& lengths, int n, TableMethod method,
                    const Write& write) {
  const auto size = static_cast<std::size_t>(n);
  table_entries<RampedSpan>(
      tf, low, high, n, lengths, kFloatTolerance, method,
      [&](std::size_t l, int front, int back, RampedSpan span, int cells) {
        for (double* ramped :
             {&span.ramped_red, &span.ramped_green, &span.ramped_blue, &span.ramped_white}) {
          *ramped /= cells;
        }
        const std::size_t row = l * size + static_cast<std::size_t>(back);
        write(row * size + static_cast<std::size_t>(front), front, back, span);
      });
}

Entries empty_entries(int n, std::size_t lengths) {
  const auto size = static_cast<std::size_t>(n);
  return Entries(4 * size * size * lengths);
}

/// Entries [length][back][front] of both tables of RampedTables.
std::pair<Entries, Entries> ramped_light(const TransferFunction& tf, double low, double high,
                                         const std::vector<double>& lengths, int n,
                                         TableMethod method) {
  std::pair<Entries, Entries> tables{empty_entries(n, lengths.size()),
                                     empty_entries(n, lengths.size())};
  ramped_entries(
      tf, low, high, lengths, n, method, [&](std::size_t entry, int, int, const RampedSpan& s) {
        set_entry(&tables.first[4 * entry], {s.red - s.ramped_red, s.green - s.ramped_green,
                                             s.blue - s.ramped_blue, s.opacity});
        set_entry(&tables.second[4 * entry],
                  {s.ramped_red, s.ramped_green, s.ramped_blue, s.ramped_white});
      });
  return tables;
}

/// Entries [length][back][front] of material tables.
Entries material_means(const TransferFunction& tf, double low, double high,
                       const std::vector<double>& lengths, int n, TableMethod method) {
  const TransferFunction materials = materials_as_colors(tf);
  Entries table = empty_entries(n, lengths.size());
  const auto write = [&](std::size_t entry, int front, int back, const RampedSpan& s) {
    if (s.opacity > 0) {
      const double weight = std::min(1.0, s.ramped_white / s.opacity);
      set_entry(&table[4 * entry],
                {s.red / s.opacity, s.green / s.opacity, s.blue / s.opacity, weight});
      return;
    }
    const Color mean = 0.5 * materials.at(table_node(low, high, n, front)).color +
                       0.5 * materials.at(table_node(low, high, n, back)).color;
    set_entry(&table[4 * entry], {mean[0], mean[1], mean[2], 0.5});
  };
  ramped_entries(materials, low, high, lengths, n, method, write);
  return table;
}

}  // namespace

RampedTables ramped_tables(const TransferFunction& tf, double low, double high, double length,
                           int n, TableMethod method) {
  check_axis(low, high, n);
  check_length(length);
  auto [front, back] = ramped_light(tf, low, high, {length}, n, method);
  return {{n, low, high, std::move(front), {}}, {n, low, high, std::move(back), {}}};
}

RampedTables3D ramped_tables_3d(const TransferFunction& tf, double low, double high,
                                double max_length, int n, int m, TableMethod method,
                                LengthAxis axis) {
  check_axis(low, high, n);
  auto [front, back] = ramped_light(tf, low, high, table_lengths(axis, max_length, m), n, method);
  return {{n, m, low, high, max_length, std::move(front), axis, {}},
          {n, m, low, high, max_length, std::move(back), axis, {}}};
}

Table2D material_table(const TransferFunction& tf, double low, double high, double length, int n,
                       TableMethod method) {
  check_axis(low, high, n);
  check_length(length);
  return {n, low, high, material_means(tf, low, high, {length}, n, method), {}};
}

Table3D material_table_3d(const TransferFunction& tf, double low, double high, double max_length,
                          int n, int m, TableMethod method, LengthAxis axis) {
  check_axis(low, high, n);
  std::vector<double> lengths = table_lengths(axis, max_length, m);
  // The limit for short segments: of a length so short that nothing is dimmed to the rounding of a
  // float, at any extinction below 2^76 / max_length.
  lengths[0] = std::ldexp(max_length, -100);
  return {n, m, low, high, max_length, material_means(tf, low, high, lengths, n, method), axis, {}};
}

}  // namespace tetraglass::preint
