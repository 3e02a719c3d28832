#pragma once

#include <cstddef>

namespace tetraglass::preint {

/// Light of a range of cells of a transfer function's axis, crossed upwards.
struct LightSpan {
  double red = 0, green = 0, blue = 0;
  double transmittance = 1;
};

/// The same with the light weighted by the distance from the front of the range, in cells, too;
/// `white` is that of a white medium, whose unweighted light is the opacity.
struct RampedSpan {
  double red = 0, green = 0, blue = 0;
  double opacity = 0;  ///< not the transmittance: thin ranges keep their relative accuracy
  double ramped_red = 0, ramped_green = 0, ramped_blue = 0;
  double ramped_white = 0;
};

/// The doubles of a span; what follows handles them in groups of four.
template <class Span>
inline constexpr std::size_t kSpanSize = sizeof(Span) / sizeof(double);

/// How many ranges the functions below handle at once, one in each lane of a vector of this
/// machine: at most kMostLanes.
[[nodiscard]] std::size_t run_lanes();
inline constexpr std::size_t kMostLanes = 8;

/// As many ranges of neighbouring widths (in cells) as a vector has lanes.
struct Run {
  std::size_t narrowest = 1;
  bool descending = false;  ///< lane 0 has the widest range, otherwise the narrowest
  std::size_t lanes = run_lanes();

  [[nodiscard]] std::size_t width(std::size_t lane) const {
    return narrowest + (descending ? lanes - 1 - lane : lane);
  }
};

/// Cells as power series in their optical depth (see CellSeries).
struct SeriesInput {
  const double* depth;    ///< [cell], of unit length
  const double* moments;  ///< [(cell * terms + m) * quantities + quantity]
  std::size_t count;      ///< cells
  std::size_t terms;      ///< stored per cell, 1 to 32
  /// [t]: to which depth t + 1 terms are enough; the last is infinite. Depths are cut to `deepest`:
  /// cells too deep for the series stay finite.
  const double* depth_of_terms;
  double deepest;
};

/// The spans of all single cells for each of the lengths ([lane], of a cell) as
/// cells[(cell * kSpanSize + quantity) * lanes + lane]: three quantities besides the transmittance
/// for `span_size` 4, seven besides the opacity for 8. quantity = length sum_m (-tau)^m moment[m],
/// opacity = -sum_{m > 0} (-tau)^m / m!, tau = length depth. Results differ between machines by
/// rounding only (fused multiply-add).
void evaluate_series(const SeriesInput& input, std::size_t span_size, const double* lengths,
                     double* cells);

/// Where the span of lane `lane` that ends with sample `end` stands in what compose_subranges
/// writes, its doubles from 4 * part on.
[[nodiscard]] inline std::size_t span_offset(std::size_t span_size, std::size_t lanes,
                                             std::size_t end, std::size_t lane,
                                             std::size_t part = 0) {
  return ((end * (span_size / 4) + part) * lanes + lane) * 4;
}

/// Incremental subrange integration (lum2004, "Efficient Computation of Traditional Lookup Tables",
/// Fig. 5): all ranges of the run's widths, each from a constant number of compositions. `cells` as
/// from evaluate_series, of `count` cells; `spans` as span_offset says, for the samples 0 to count.
/// Ranges that would begin before the first cell have no meaning. `tails` is working memory of
/// (narrowest + lanes) * span_size * lanes doubles.
///
/// Bins of `narrowest` cells begin at samples B = 0, narrowest, ... A range that ends in the bin
/// that begins at B is a tail (some cells before B, composited from B to the left) followed by a
/// head (cells from B on, composited to the right); both serve all the ranges that share them.
///
/// The ramp of the back part begins where the front part ends, so the number of cells in between is
/// added: all terms are positive. (lum2004 takes one ramp for the whole axis,
/// C_W = (C_G - i C_1) / (j - i), and loses the digits of i / (j - i) where a short range lies far
/// from the origin; a ramp per range cannot.)
void compose_subranges(const double* cells, std::size_t count, std::size_t span_size, Run run,
                       double* tails, double* spans);

/// The same for light, as the entries of a table: rgba[(end * lanes + lane) * 4], A the opacity.
void compose_entries(const double* cells, std::size_t count, Run run, double* tails, float* rgba);

}  // namespace tetraglass::preint
