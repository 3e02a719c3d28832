#pragma once

#include <vector>

namespace tetraglass::base {

/// The middle of the values in their order, of an even number the upper one; 0 of none. Linear.
[[nodiscard]] double median(std::vector<double> values);

}  // namespace tetraglass::base
