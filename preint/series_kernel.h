#pragma once

#include <cstddef>

namespace tetraglass::preint {

/// Integrals per cell beside the transmittance (see CellSeries).
inline constexpr std::size_t kLightQuantities = 3;
inline constexpr std::size_t kRampedQuantities = 7;

/// The power series of all cells of an axis, structure of arrays.
struct SeriesInput {
  const double* depth;    ///< [cell], per unit length
  const double* moments;  ///< [(m * quantities + quantity) * count + cell]
  std::size_t count;      ///< cells, a multiple of what padded_to_vectors gives
  double length;          ///< of each cell
  double deepest;         ///< depths are cut to this: cells too deep for the series stay finite
  int terms;              ///< of the series, 1 to 32
};

/// The number of cells rounded up to whole vectors of any machine.
[[nodiscard]] inline std::size_t padded_to_vectors(std::size_t cells) {
  return (cells + 7) / 8 * 8;
}

/// Per cell the doubles of a LightSpan or, with seven quantities, of a RampedSpan:
/// quantity = length * sum_m (-tau)^m moment[m], opacity = -sum_{m > 0} (-tau)^m / m!,
/// tau = length * depth. Uses the widest vectors of the machine it runs on; results differ between
/// machines by rounding only (fused multiply-add).
void evaluate_series(const SeriesInput& input, std::size_t quantities, double* spans);

}  // namespace tetraglass::preint
