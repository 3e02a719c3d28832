#pragma once

#include <cstddef>
#include <vector>

#include "preint/table.h"
#include "preint/transfer_function.h"

namespace tetraglass::apps {

enum class TableKind { emission, mip, iso, full2d, full3d, weighted, material, psi };

/// What is to be built, read from the arguments.
struct TableTask {
  TableKind kind = TableKind::emission;
  preint::TableMethod method = preint::TableMethod::incremental;
  preint::TransferFunction tf{{preint::ControlPoint{}}};
  double low = 0;
  double high = 1;
  double length = 1;
  double shortest = 0;  ///< of the segments, where the size is chosen
  int n = 0;
  int m = 0;  ///< lengths; 0 for a table of one length
  preint::LengthAxis axis = preint::LengthAxis::linear;
  preint::MipOf mip_of = preint::MipOf::field;
  std::vector<preint::Isosurface> surfaces;
  double thickening = 0;
};

/// A finished table.
struct BuiltTable {
  std::vector<std::size_t> shape;
  std::size_t channels = 4;
  std::vector<preint::Entries> parts;  ///< one after the other

  [[nodiscard]] std::size_t entries() const {
    std::size_t count = 0;
    for (const preint::Entries& part : parts) count += part.size();
    return count / channels;
  }
};

[[nodiscard]] BuiltTable build(const TableTask& task);

/// The largest error of a lookup in the smallest full2d or full3d table that keeps it below
/// `max_error`; sets the size, and the axis of the lengths, in the task. Throws InputError if no
/// table of 256 MiB does.
double choose_size(TableTask& task, double max_error);

/// The largest difference of the entries from the exact integrals: of all of a table of 65,536, of
/// as many that are evenly spread in a larger one.
[[nodiscard]] double largest_error(const TableTask& task, const BuiltTable& table);

/// The largest difference of lookups, at 4096 places spread evenly inside the table, from the exact
/// integrals there: interpolated, but for isosurfaces at the nearest entry. Where the integral
/// jumps, as at isovalues, it is of the order of the jump.
[[nodiscard]] double largest_lookup_error(const TableTask& task, const BuiltTable& table);

}  // namespace tetraglass::apps
