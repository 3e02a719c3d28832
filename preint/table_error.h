#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Core>

#include "preint/table.h"

namespace tetraglass::preint {

struct Lookup {
  Eigen::Array4d rgba;
  bool clamped = false;  ///< a value or a length lay outside the table: rgba is that of its border
};

/// Bilinear in the values.
[[nodiscard]] Lookup lookup(const Table2D& table, double front, double back);

/// Trilinear in the values and the coordinate of the length.
[[nodiscard]] Lookup lookup(const Table3D& table, double front, double back, double length);

/// Place i of a sequence that fills the unit cube evenly (R3, Roberts 2018): where tables are
/// checked.
[[nodiscard]] std::array<double, 3> evenly_spread(std::size_t i);

/// Lengths of the segments that a table is looked up for (those of a mesh), 0 <= shortest <=
/// longest.
struct LengthRange {
  double shortest = 0;
  double longest = 1;
};

/// The largest difference, over channels and over `samples` places spread evenly inside the table
/// (a fixed low-discrepancy sequence), of a lookup in a table made by `slab_table` or `full_table`
/// from the exact integral; of the full table for all its lengths, or those of the range. At a jump
/// of the transfer function the error of any table is of the order of the jump.
[[nodiscard]] double slab_table_error(const Table2D& table, const TransferFunction& tf,
                                      double length, std::size_t samples = 4096);
[[nodiscard]] double full_table_error(const Table3D& table, const TransferFunction& tf,
                                      std::size_t samples = 4096);
[[nodiscard]] double full_table_error(const Table3D& table, const TransferFunction& tf,
                                      const LengthRange& lengths, std::size_t samples = 4096);

/// The smallest table found whose measured error is at most `max_error`, its `max_error` set: sizes
/// double from 16, for the full table on whichever axis has the larger error of its own, on the
/// better of both length axes. Errors count for the lengths of the range only. Where `max_bytes` do
/// not suffice, the table with the smallest error within them; compare its `max_error`. Throws
/// UsageError like `slab_table` and `full_table`, and for lengths that are no range.
[[nodiscard]] Table2D choose_slab_table(const TransferFunction& tf, double low, double high,
                                        double length, double max_error,
                                        std::size_t max_bytes = std::size_t{256} << 20);
[[nodiscard]] Table3D choose_full_table(const TransferFunction& tf, double low, double high,
                                        const LengthRange& lengths, double max_error,
                                        std::size_t max_bytes = std::size_t{256} << 20);

}  // namespace tetraglass::preint
