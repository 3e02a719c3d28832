#pragma once

#include <cstddef>
#include <vector>

#include "preint/segment_integral.h"

namespace tetraglass::preint {

/// Light of a range of cells of a transfer function's axis, crossed upwards.
struct LightSpan {
  double red = 0, green = 0, blue = 0;
  double transmittance = 1;
};

/// Front over back.
inline LightSpan composite(const LightSpan& front, double /*front_cells*/, const LightSpan& back) {
  const double t = front.transmittance;
  return {front.red + t * back.red, front.green + t * back.green, front.blue + t * back.blue,
          t * back.transmittance};
}

/// The same with the light weighted by the distance from the front of the range, in cells, too;
/// `white` is that of a white medium, whose unweighted light is the opacity.
struct RampedSpan {
  double red = 0, green = 0, blue = 0;
  double opacity = 0;  ///< not the transmittance: thin ranges keep their relative accuracy
  double ramped_red = 0, ramped_green = 0, ramped_blue = 0;
  double ramped_white = 0;
};

/// Front over back. The ramp of the back part begins where the front part ends, so the number of
/// cells in between is added: all terms are positive. (lum2004 takes one ramp for the whole axis,
/// C_W = (C_G - i C_1) / (j - i), and loses the digits of i / (j - i) where a short range lies far
/// from the origin; a ramp per range cannot.)
inline RampedSpan composite(const RampedSpan& front, double front_cells, const RampedSpan& back) {
  const double t = 1 - front.opacity;
  const double shift = t * front_cells;
  return {front.red + t * back.red,
          front.green + t * back.green,
          front.blue + t * back.blue,
          front.opacity + t * back.opacity,
          front.ramped_red + t * back.ramped_red + shift * back.red,
          front.ramped_green + t * back.ramped_green + shift * back.green,
          front.ramped_blue + t * back.ramped_blue + shift * back.blue,
          front.ramped_white + t * back.ramped_white + shift * back.opacity};
}

/// Incremental subrange integration (lum2004, "Efficient Computation of Traditional Lookup Tables",
/// Fig. 5): `emit(i, span)` for every range of `width` neighbours among the first `count` cells (i
/// is its first cell), each from three compositions.
///
/// The cells are cut into bins of `width`. A range that begins at cell r > 0 of a bin is the rest
/// of that bin followed by the first r cells of the next one. So each bin needs all its tails,
/// built from right to left, and the heads of the next bin, built from left to right while they are
/// used. `tails` is working memory, at least `width` long.
template <class Span, class Emit>
void for_each_subrange(const std::vector<Span>& cells, std::size_t count, std::size_t width,
                       std::vector<Span>& tails, Emit&& emit) {
  for (std::size_t bin = 0; bin + width <= count; bin += width) {
    tails[width - 1] = cells[bin + width - 1];
    for (std::size_t r = width - 1; r-- > 0;) {
      tails[r] = composite(cells[bin + r], 1, tails[r + 1]);
    }
    emit(bin, tails[0]);
    Span head;
    for (std::size_t r = 1; r < width && bin + r + width <= count; ++r) {
      head = composite(head, static_cast<double>(r - 1), cells[bin + width + r - 1]);
      emit(bin + r, composite(tails[r], static_cast<double>(width - r), head));
    }
  }
}

}  // namespace tetraglass::preint
