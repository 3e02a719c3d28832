#pragma once

#include <algorithm>
#include <cmath>

#include "preint/segment_integral.h"

namespace tetraglass::preint {

/// A part of a segment on which extinction and color are linear.
struct Piece {
  double length = 0;
  Medium front;
  Medium back;
};

/// Calls `visit(const Piece&)` for the linear pieces of the segment, from front to back: at least
/// one, at most one per interval of the transfer function. A segment of equal ends is one constant
/// piece of the medium `tf.at(front)`.
///
/// The length of a piece is the segment's times a quotient of two differences of values, never a
/// difference of two positions along the ray: so short pieces of long segments keep their relative
/// accuracy, which matters where the extinction is large (an error in the optical depth shows
/// whole).
template <class Visit>
void for_each_piece(const TransferFunction& tf, const Segment& segment, Visit&& visit) {
  const double front = segment.front;
  const double back = segment.back;
  if (front == back) {
    const Medium medium = tf.at(front);
    visit(Piece{segment.length, medium, medium});
    return;
  }
  // Halved where the difference of the ends overflows.
  const double scale = std::isfinite(back - front) ? 1 : 0.5;
  const double span = std::abs(scale * back - scale * front);
  const auto piece = [&](std::size_t interval, double from, double to) {
    const double fraction = std::abs(scale * to - scale * from) / span;
    visit(Piece{segment.length * fraction, tf.in_interval(interval, from),
                tf.in_interval(interval, to)});
  };
  const auto& points = tf.points();
  double from = front;
  if (front < back) {
    std::size_t interval = tf.interval_above(front);
    for (; interval < points.size() && points[interval].value < back; ++interval) {
      const double to = points[interval].value;
      if (to > from) piece(interval, from, to);
      from = to;
    }
    piece(interval, from, back);
  } else {
    std::size_t interval = tf.interval_below(front);
    for (; interval > 0 && points[interval - 1].value > back; --interval) {
      const double to = points[interval - 1].value;
      if (to < from) piece(interval, from, to);
      from = to;
    }
    piece(interval, from, back);
  }
}

/// Extinction times the length of the piece, at its two ends; the optical depth from the front to
/// the fraction x of the piece is x (front + x (back - front) / 2).
struct OpticalExtinction {
  double front = 0;
  double back = 0;

  /// Of the whole piece. Halves first: the sum of two large ones stays finite.
  [[nodiscard]] double depth() const { return 0.5 * front + 0.5 * back; }
};

/// Bounded, so that sums and products stay finite; light does not tell 1e300 from infinity.
[[nodiscard]] inline OpticalExtinction optical_extinction(const Piece& piece) {
  constexpr double kMost = 1e300;
  return {std::min(piece.length * piece.front.extinction, kMost),
          std::min(piece.length * piece.back.extinction, kMost)};
}

}  // namespace tetraglass::preint
