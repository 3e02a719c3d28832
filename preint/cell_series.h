#pragma once

#include <cstddef>
#include <vector>

#include "preint/segment_integral.h"
#include "preint/subranges.h"

namespace tetraglass::preint {

/// A whole segment as a span of one cell; tolerance as in `integrate_full`.
template <class Span>
[[nodiscard]] Span exact_span(const TransferFunction& tf, const Segment& segment, double tolerance);
template <>
LightSpan exact_span<LightSpan>(const TransferFunction& tf, const Segment& segment,
                                double tolerance);
template <>
RampedSpan exact_span<RampedSpan>(const TransferFunction& tf, const Segment& segment,
                                  double tolerance);

/// The cells between neighbouring nodes of a table's axis, crossed upwards, for any length: a
/// series in the optical depth of the cell where that is at most 4, the segment integral where it
/// is more.
///
/// With t(x) the optical depth from the front of the cell to x in [0, 1] divided by that of the
/// whole cell, tau, the light is int kappa c exp(-tau t) dl = l sum_m (-tau)^m M_m,
/// M_m = int kappa c t^m / m! dx. The moments M_m do not depend on the length, so that a table's
/// many lengths per cell cost a short polynomial each. The series alternates: cutting it off at
/// tau^n / n! < tolerance leaves an error of less than that part of the light that the cell emits.
template <class Span>
class CellSeries {
 public:
  /// `nodes` ascending. Both outlive this.
  CellSeries(const TransferFunction& tf, const std::vector<double>& nodes, double tolerance);

  [[nodiscard]] std::size_t size() const { return depth_.size(); }

  /// All cells for each of run_lanes() lengths of a cell, as evaluate_series lays them out.
  void evaluate(const double* lengths, double* cells) const;

 private:
  const TransferFunction& tf_;
  const std::vector<double>& nodes_;
  double tolerance_;
  std::vector<double> depth_;           ///< of a cell of unit length
  std::vector<double> moments_;         ///< [(cell * terms + m) * quantities + quantity]
  std::vector<double> depth_of_terms_;  ///< [terms - 1]: how deep that many terms reach
};

extern template class CellSeries<LightSpan>;
extern template class CellSeries<RampedSpan>;

}  // namespace tetraglass::preint
