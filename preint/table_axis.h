#pragma once

#include <vector>

#include "preint/table.h"

namespace tetraglass::preint {

/// To what tables are integrated: far below the rounding of a float entry, 6e-8.
inline constexpr double kFloatTolerance = 1e-9;

/// Throws UsageError for fewer than two samples or a range that is not low < high and finite.
void check_axis(double low, double high, int n);

/// Throws UsageError for a length that is negative or not finite.
void check_length(double length);

/// All m lengths of an axis. Throws UsageError for fewer than two, or a longest one that is not
/// positive and finite.
[[nodiscard]] std::vector<double> table_lengths(LengthAxis axis, double max_length, int m);

}  // namespace tetraglass::preint
