#pragma once

#include <span>
#include <vector>

#include "preint/piece_series.h"
#include "preint/transfer_function.h"

namespace tetraglass::preint {

/// A transfer function in float, cut into its linear intervals.
class FloatTransferFunction {
 public:
  /// Values, colors and extinctions are rounded to the nearest float, values and colors beyond 1e38
  /// and extinctions beyond 1e18 to these, values below 1e-30 to 0; points that fall together make
  /// a jump.
  explicit FloatTransferFunction(const TransferFunction& tf);

  /// A linear medium, from one end of an interval to the other.
  struct Ramp {
    float origin;
    float half_inverse;                 ///< 1 / (2 (other end - origin)); 0: constant
    float extinction, extinction_rise;  ///< at the origin, and what is added up to the other end
    float color[3], color_rise[3];
  };

  /// Between two values; media are limits from inside. The first and the last interval reach to the
  /// ends of the floats and are constant.
  struct Interval {
    float low, high;
    Ramp up, down;  ///< from the low end, from the high end

    /// From where all terms are positive: an extinction that falls to 0 keeps its relative
    /// accuracy.
    [[nodiscard]] const Ramp& from_least() const { return up.extinction_rise >= 0 ? up : down; }
  };
  [[nodiscard]] const std::vector<Interval>& intervals() const { return intervals_; }

 private:
  std::vector<Interval> intervals_;  ///< none of them empty
};

/// Segments in float, many at once (structure of arrays, all of one length): values at the front
/// and the back, of at most 1e38, and lengths >= 0 (beyond 1e18: that).
struct SegmentBatch {
  std::span<const float> front, back, length;
  std::span<float> red, green, blue;  ///< result: int kappa c exp(-tau) dl
  std::span<float> transmittance;     ///< result: exp(-tau)
};

/// The volume rendering integral of all segments in the widest vectors of the machine: like
/// `integrate_full`, split at the control points, with the light of each piece by the cheapest form
/// that its depth allows for the tolerance (piece_light.h). Absolute error at most the tolerance
/// (1e-6 or more) for segments of up to eight pieces and colors in [0, 1]; the rounding of each
/// further piece adds at most 1e-7. A vector of segments costs as many pieces as there are
/// intervals between the smallest and the largest of their values: neighbours should have similar
/// values.
void segment_lights(const FloatTransferFunction& tf, const SegmentBatch& batch,
                    double tolerance = kFinestPiece);

}  // namespace tetraglass::preint
