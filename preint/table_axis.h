#pragma once

namespace tetraglass::preint {

/// Throws UsageError for fewer than two samples or a range that is not low < high and finite.
void check_axis(double low, double high, int n);

}  // namespace tetraglass::preint
