#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include "preint/isosurfaces.h"
#include "preint/transfer_function.h"

namespace tetraglass::preint {

/// std::allocator that leaves numbers uninitialized: the threads that fill a large table are the
/// first to touch its memory, and nobody writes it twice.
template <class T>
struct UninitializedAllocator : std::allocator<T> {
  template <class U>
  struct rebind {  // NOLINT(readability-identifier-naming): the standard names it
    using other = UninitializedAllocator<U>;
  };
  template <class U>
  void construct(U* place) noexcept {
    ::new (static_cast<void*>(place)) U;
  }
  template <class U, class... Args>
  void construct(U* place, Args&&... args) {
    ::new (static_cast<void*>(place)) U(std::forward<Args>(args)...);
  }
};
using Entries = std::vector<float, UninitializedAllocator<float>>;

/// RGBA entries over (front value, back value), both of n samples, linear from `low` to `high`
/// inclusive. Entry (f, b) is at rgba[4 * (b * n + f)].
struct Table2D {
  int n = 0;
  double low = 0;
  double high = 1;
  Entries rgba;
  std::optional<double> max_error = {};  ///< of lookups, where it was measured (table_error.h)
};

enum class LengthAxis {
  linear,
  logarithmic,  ///< fine near 0 (spacing max_length / 150 / m), coarse near max_length (7 / m)
};

/// RGBA entries over (front, back, length): n x n x m, lengths from 0 to `max_length` inclusive.
/// Entry (f, b, l) is at rgba[4 * ((l * n + b) * n + f)].
struct Table3D {
  int n = 0;
  int m = 0;
  double low = 0;
  double high = 1;
  double max_length = 1;
  Entries rgba;
  LengthAxis axis = LengthAxis::linear;
  std::optional<double> max_error = {};  ///< of lookups, where it was measured (table_error.h)
};

/// The value of sample i of n of an axis from `low` to `high`, both met exactly.
[[nodiscard]] double table_node(double low, double high, int n, int i);

/// The length at a coordinate in [0, m - 1]; whole coordinates are the m samples.
[[nodiscard]] double length_at(LengthAxis axis, double max_length, int m, double coordinate);

/// The inverse of `length_at`: 0 for no length, m - 1 for `max_length`, more beyond.
[[nodiscard]] double length_coordinate(LengthAxis axis, double max_length, int m, double length);

// Each of the following throws UsageError for n or m below 2, a range that is not low < high, or a
// length that is not positive.

/// How a table is filled. All ways integrate to 1e-9, below the rounding of a float entry. (The
/// algorithms themselves hold 1e-12, plus the rounding of the axis' samples relative to their
/// spacing.)
enum class TableMethod {
  incremental,  ///< from its neighbours: a constant number of operations per entry (full model:
                ///< lum2004, incremental subrange integration)
  brute_force,  ///< every entry on its own, over all cells of the axis between its ends, each
                ///< integrated numerically: proportional to their number, whatever the function
  exact,        ///< every entry on its own, split at the control points only: proportional to the
                ///< number of these between its ends
};

/// Emission per unit length (RGB) and mean extinction (A): times the length, the emission and the
/// optical depth of a segment. Modes `emission` and `absorption`.
[[nodiscard]] Table2D emission_table(const TransferFunction& tf, double low, double high, int n,
                                     TableMethod method = TableMethod::incremental);

/// Maximum intensity projection: the largest what?
enum class MipOf {
  field,     ///< the color of the largest value
  transfer,  ///< the channel-wise largest color of the values in between (weiler2002 section 5.1)
};

/// The color of the maximum between the two values (RGB); A = 1. That of the field is at one of the
/// ends, whatever the method.
[[nodiscard]] Table2D mip_table(const TransferFunction& tf, double low, double high, int n,
                                TableMethod method = TableMethod::incremental,
                                MipOf of = MipOf::transfer);

/// Color (RGB, associated) and opacity (A) of the isosurfaces crossed, composited nearest first; 0
/// where there is none (weiler2002 Fig. 10). Look it up without interpolation. A segment crosses a
/// surface as `crosses` says (isosurfaces.h), or with a positive `thickening` where it meets any
/// value within that distance of the isovalue: the paper's way to close gaps between cells that are
/// looked up separately (one step of the table, (high - low) / (n - 1), closes them).
[[nodiscard]] Table2D iso_table(const std::vector<Isosurface>& surfaces, double low, double high,
                                int n, double thickening = 0,
                                TableMethod method = TableMethod::incremental);

/// The full model of segments of one length (slabs between parallel slices, lum2004): associated
/// color (RGB) and opacity (A). Where front = back, the constant medium. In parallel.
[[nodiscard]] Table2D slab_table(const TransferFunction& tf, double low, double high, double length,
                                 int n, TableMethod method = TableMethod::incremental);

/// The full model of a segment: associated color (RGB) and opacity (A), n x n x m entries, in
/// parallel. Lengths beyond `max_length` are not covered: choose it as the longest cell edge.
[[nodiscard]] Table3D full_table(const TransferFunction& tf, double low, double high,
                                 double max_length, int n, int m,
                                 TableMethod method = TableMethod::incremental,
                                 LengthAxis axis = LengthAxis::linear);

}  // namespace tetraglass::preint
