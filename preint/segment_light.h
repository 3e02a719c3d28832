#pragma once

#include <span>
#include <vector>

#include "preint/transfer_function.h"

namespace tetraglass::preint {

/// A transfer function in float, cut into its linear intervals.
class FloatTransferFunction {
 public:
  /// Values, colors and extinctions are rounded to the nearest float (extinctions beyond 1e30 to
  /// that); points that fall together make a jump.
  explicit FloatTransferFunction(const TransferFunction& tf);

  /// Between two values, with the medium at both (its limits from inside). The first and the last
  /// interval reach to the ends of the floats and are constant.
  struct Interval {
    float low, high;
    float inverse_width;  ///< 0: constant
    float k_low, k_high;  ///< extinction
    float color_low[3], color_high[3];
  };
  [[nodiscard]] const std::vector<Interval>& intervals() const { return intervals_; }

 private:
  std::vector<Interval> intervals_;  ///< none of them empty
};

/// Segments in float, many at once (structure of arrays, all of one length): values at the front
/// and the back, finite and less than 3e38 apart, and lengths >= 0.
struct SegmentBatch {
  std::span<const float> front, back, length;
  std::span<float> red, green, blue;  ///< result: int kappa c exp(-tau) dl
  std::span<float> transmittance;     ///< result: exp(-tau)
};

/// The volume rendering integral of all segments in the widest vectors of the machine: like
/// `integrate_full`, split at the control points, with the light of each piece by the cheapest form
/// that its depth allows (piece_light.h). Absolute error at most 1e-6 for segments of up to eight
/// pieces and colors in [0, 1]; the rounding of each further piece adds at most 1e-7. A vector of
/// segments costs as many pieces as there are intervals between the smallest and the largest of
/// their values: neighbours should have similar values.
void segment_lights(const FloatTransferFunction& tf, const SegmentBatch& batch);

}  // namespace tetraglass::preint
