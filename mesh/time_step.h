#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace tetraglass::mesh {

/// The index of the time step that `wanted` names: "" or "last", "index:N" counted from 0, or a
/// time value, of which the nearest step is taken. `times` is not empty. Throws UsageError for
/// anything else, and for an index beyond the last.
[[nodiscard]] std::size_t find_time_step(const std::string& wanted, std::span<const double> times);

}  // namespace tetraglass::mesh
