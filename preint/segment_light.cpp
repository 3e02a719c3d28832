#include "preint/segment_light.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "preint/segment_light.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set
#include <hwy/highway.h>

#include "preint/piece_light-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tetraglass::preint::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Segments whose values differ by less count as of one value: inverses stay finite.
inline constexpr float kLeastDifference = 1e-37F;

/// Longer ones count as this: optical depths stay finite.
inline constexpr float kMostLength = 1e18F;

/// A part of each segment of a vector, in one interval: where its middle lies, as a fraction of the
/// interval from the origin of a ramp on, and half of what it crosses, from front to back.
template <class V>
struct Part {
  V middle;
  V half_crossed;
  V length;
};

/// Light that leaves the front.
template <class V>
struct Light {
  V color[3];
  V transmittance;
};

/// Segments of one vector.
template <class V>
struct Segments {
  V front, back, length;
};

using Interval = FloatTransferFunction::Interval;
using Ramp = FloatTransferFunction::Ramp;
using Intervals = std::vector<Interval>;

/// Neighbouring intervals.
struct Range {
  std::size_t first = 0;
  std::size_t last = 0;
};

template <class D, class V>
HWY_INLINE PieceLight<V> light_of_part(D d, const Ramp& ramp, const Part<V>& part,
                                       const PieceBounds& bounds) {
  const V rise = hn::Mul(part.length, hn::Set(d, ramp.extinction_rise));
  const V least = hn::Mul(part.length, hn::Set(d, ramp.extinction));
  return piece_light(
      d, OpticalPiece<V>{hn::MulAdd(rise, part.middle, least), hn::Mul(rise, part.half_crossed)},
      bounds);
}

/// Adds the light of a part of this opacity and skew (PieceLight).
template <class D, class V>
HWY_INLINE void add_color(D d, const Ramp& ramp, const Part<V>& part, V opacity, V skew,
                          V (&color)[3]) {
  const V rise = hn::MulAdd(opacity, part.middle, hn::Mul(skew, part.half_crossed));
  for (std::size_t c = 0; c < 3; ++c) {
    color[c] = hn::MulAdd(opacity, hn::Set(d, ramp.color[c]),
                          hn::MulAdd(rise, hn::Set(d, ramp.color_rise[c]), color[c]));
  }
}

/// Adds a part of greater values: it lies behind what there is where the values rise, in front of
/// it where they fall.
template <class D, class V, class M>
HWY_INLINE void add_part(D d, const Ramp& ramp, const Part<V>& part, const PieceLight<V>& light,
                         M falling, Light<V>& sum) {
  const V one = hn::Set(d, 1.0F);
  const V of_part = hn::IfThenElse(falling, one, sum.transmittance);
  const V of_sum = hn::IfThenElse(falling, light.transmittance, one);
  for (V& color : sum.color) color = hn::Mul(color, of_sum);
  add_color(d, ramp, part, hn::Mul(of_part, light.opacity), hn::Mul(of_part, light.skew),
            sum.color);
  sum.transmittance = hn::Mul(sum.transmittance, light.transmittance);
}

/// From `from` to `to` in an interval.
template <class D, class V>
HWY_INLINE Part<V> part_between(D d, const Ramp& ramp, V from, V to, V length) {
  const V origin = hn::Set(d, ramp.origin);
  const V half_inverse = hn::Set(d, ramp.half_inverse);
  const V both = hn::Add(hn::Sub(from, origin), hn::Sub(to, origin));
  return {hn::Mul(both, half_inverse), hn::Mul(hn::Sub(to, from), half_inverse), length};
}

/// All lie in this interval.
template <class D, class V>
HWY_INLINE Light<V> light_in_one(D d, const Ramp& ramp, const Segments<V>& s,
                                 const PieceBounds& bounds) {
  const Part<V> part = part_between(d, ramp, s.front, s.back, s.length);
  const auto light = light_of_part(d, ramp, part, bounds);
  const V zero = hn::Zero(d);
  Light<V> sum{{zero, zero, zero}, light.transmittance};
  add_color(d, ramp, part, light.opacity, light.skew, sum.color);
  return sum;
}

/// All lie in the range.
template <class D, class V>
HWY_INLINE Light<V> light_in_several(D d, const Intervals& intervals, const Range& range,
                                     const Segments<V>& s, const PieceBounds& bounds) {
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0F);
  const V low = hn::Min(s.front, s.back), high = hn::Max(s.front, s.back);
  const V difference = hn::Sub(high, low);
  const auto falling = hn::Lt(s.back, s.front);
  const auto constant = hn::Lt(difference, hn::Set(d, kLeastDifference));
  const V inverse = hn::Div(one, hn::IfThenElse(constant, one, difference));
  const bool some_constant = !hn::AllFalse(d, constant);
  Light<V> sum{{zero, zero, zero}, one};
  for (std::size_t k = range.first; k <= range.last; ++k) {
    const Interval& interval = intervals[k];
    const Ramp& ramp = interval.from_least();
    const V bottom = hn::Set(d, interval.low), top = hn::Set(d, interval.high);
    const V from = hn::Min(hn::Max(low, bottom), top);
    const V to = hn::Min(hn::Max(high, bottom), top);
    V share = hn::Mul(hn::Sub(to, from), inverse);
    if (some_constant) {
      // In the interval that begins at the value or below it.
      const auto here = hn::And(hn::Ge(low, bottom), hn::Lt(low, top));
      share = hn::IfThenElse(constant, hn::IfThenElseZero(here, one), share);
    }
    Part<V> part = part_between(d, ramp, from, to, hn::Mul(share, s.length));
    part.half_crossed = hn::IfThenElse(falling, hn::Neg(part.half_crossed), part.half_crossed);
    const auto light = light_of_part(d, ramp, part, bounds);
    add_part(d, ramp, part, light, falling, sum);
  }
  return sum;
}

/// All begin in interval `first`, end in `last` and cross what lies between them, up or down.
template <class D, class V>
HWY_INLINE Light<V> light_across(D d, const Intervals& intervals, const Range& range,
                                 const Segments<V>& s, const PieceBounds& bounds) {
  const V zero = hn::Zero(d), half = hn::Set(d, 0.5F);
  const V low = hn::Min(s.front, s.back), high = hn::Max(s.front, s.back);
  const auto falling = hn::Lt(s.back, s.front);
  const V inverse = hn::Div(hn::Set(d, 1.0F), hn::Sub(high, low));
  const auto downwards = [&](auto mask, V x)
                             HWY_ATTR { return hn::IfThenElse(mask, hn::Neg(x), x); };
  // From the control point at the origin of a ramp to the end of the segment.
  const auto outer = [&](const Ramp& ramp, V end, auto inwards) HWY_ATTR {
    const V extent = hn::Sub(end, hn::Set(d, ramp.origin));
    const V middle = hn::Mul(extent, hn::Set(d, ramp.half_inverse));
    const V share = hn::Mul(hn::Abs(extent), inverse);
    return Part<V>{middle, downwards(inwards, middle), hn::Mul(share, s.length)};
  };
  const Ramp& lowest = intervals[range.first].down;
  const Ramp& highest = intervals[range.last].up;
  const Part<V> low_part = outer(lowest, low, hn::Not(falling));
  const Part<V> high_part = outer(highest, high, falling);
  const auto low_light = light_of_part(d, lowest, low_part, bounds);
  Light<V> sum{{zero, zero, zero}, low_light.transmittance};
  add_color(d, lowest, low_part, low_light.opacity, low_light.skew, sum.color);
  for (std::size_t k = range.first + 1; k < range.last; ++k) {
    const Interval& interval = intervals[k];
    const V share = hn::Mul(hn::Set(d, interval.high - interval.low), inverse);
    const Part<V> part{half, downwards(falling, half), hn::Mul(share, s.length)};
    add_part(d, interval.up, part, light_of_part(d, interval.up, part, bounds), falling, sum);
  }
  add_part(d, highest, high_part, light_of_part(d, highest, high_part, bounds), falling, sum);
  return sum;
}

/// Whether all segments lie in one interval, or cross the same control points.
template <class D, class V>
HWY_INLINE bool fits(D d, const Intervals& intervals, const Range& range, V low, V high) {
  const Interval& first = intervals[range.first];
  const Interval& last = intervals[range.last];
  auto inside = hn::And(hn::Ge(low, hn::Set(d, first.low)), hn::Lt(high, hn::Set(d, last.high)));
  if (range.first < range.last) {
    inside = hn::And(
        inside, hn::And(hn::Lt(low, hn::Set(d, first.high)), hn::Ge(high, hn::Set(d, last.low))));
  }
  return hn::AllTrue(d, inside);
}

/// The smallest range that holds all segments, searched from `guess` on.
template <class D, class V>
HWY_INLINE Range find_range(D d, const Intervals& intervals, std::size_t guess, V low, V high) {
  // The outermost intervals reach to the ends of the floats.
  std::size_t first = guess;
  while (first + 1 < intervals.size() &&
         hn::AllTrue(d, hn::Ge(low, hn::Set(d, intervals[first].high)))) {
    ++first;
  }
  while (first > 0 && !hn::AllTrue(d, hn::Ge(low, hn::Set(d, intervals[first].low)))) --first;
  std::size_t last = first;
  while (last + 1 < intervals.size() &&
         !hn::AllTrue(d, hn::Lt(high, hn::Set(d, intervals[last].high)))) {
    ++last;
  }
  return {first, last};
}

/// The segments from the i-th on; `range` was that of the vector before.
template <class D>
HWY_INLINE void add_segments(D d, const Intervals& intervals, const SegmentBatch& batch,
                             const PieceBounds& bounds, std::size_t i, Range& range) {
  using V = hn::Vec<D>;
  const Segments<V> s{hn::LoadU(d, &batch.front[i]), hn::LoadU(d, &batch.back[i]),
                      hn::Min(hn::LoadU(d, &batch.length[i]), hn::Set(d, kMostLength))};
  const V low = hn::Min(s.front, s.back), high = hn::Max(s.front, s.back);
  bool same = fits(d, intervals, range, low, high);
  if (!same) {
    range = find_range(d, intervals, range.first, low, high);
    same = fits(d, intervals, range, low, high);
  }
  Light<V> light;
  if (!same) {
    light = light_in_several(d, intervals, range, s, bounds);
  } else if (range.first < range.last) {
    light = light_across(d, intervals, range, s, bounds);
  } else {
    light = light_in_one(d, intervals[range.first].from_least(), s, bounds);
  }
  hn::StoreU(light.color[0], d, &batch.red[i]);
  hn::StoreU(light.color[1], d, &batch.green[i]);
  hn::StoreU(light.color[2], d, &batch.blue[i]);
  hn::StoreU(light.transmittance, d, &batch.transmittance[i]);
}

void lights(const FloatTransferFunction& tf, const SegmentBatch& batch, const PieceBounds& bounds) {
  const hn::ScalableTag<float> d;
  const std::size_t count = batch.front.size();
  const std::size_t whole = count - count % hn::Lanes(d);
  Range range;
  for (std::size_t i = 0; i < whole; i += hn::Lanes(d)) {
    add_segments(d, tf.intervals(), batch, bounds, i, range);
  }
  const hn::CappedTag<float, 1> single;
  for (std::size_t i = whole; i < count; ++i) {
    add_segments(single, tf.intervals(), batch, bounds, i, range);
  }
}

}  // namespace tetraglass::preint::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tetraglass::preint {

HWY_EXPORT(lights);

namespace {

constexpr float kMostValue = 1e38F;
constexpr float kMostExtinction = 1e18F;

/// Differences of values are normal floats or 0, so that their inverses are finite.
float rounded(double x) {
  if (std::abs(x) < 1e-30) return 0;
  return static_cast<float>(std::clamp<double>(x, -kMostValue, kMostValue));
}

FloatTransferFunction::Ramp ramp(float low, float high, const ControlPoint& a,
                                 const ControlPoint& b) {
  const auto extinction = [](const ControlPoint& p) {
    return static_cast<float>(std::min<double>(p.extinction, kMostExtinction));
  };
  FloatTransferFunction::Ramp result{};
  result.origin = low;
  result.half_inverse = 0.5F / (high - low);
  result.extinction = extinction(a);
  result.extinction_rise = extinction(b) - extinction(a);
  for (int c = 0; c < 3; ++c) {
    result.color[c] = rounded(a.color[c]);
    result.color_rise[c] = rounded(b.color[c]) - result.color[c];
  }
  return result;
}

}  // namespace

FloatTransferFunction::FloatTransferFunction(const TransferFunction& tf) {
  constexpr float kEnd = std::numeric_limits<float>::max();
  const auto& points = tf.points();
  const auto constant = [](const ControlPoint& p) {
    Ramp result = ramp(0, 1, p, p);
    result.origin = rounded(p.value);
    result.half_inverse = 0;
    return result;
  };
  const Ramp below = constant(points.front()), above = constant(points.back());
  intervals_.push_back({-kEnd, below.origin, below, below});
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const float low = rounded(points[i].value), high = rounded(points[i + 1].value);
    if (!(low < high)) continue;
    intervals_.push_back({low, high, ramp(low, high, points[i], points[i + 1]),
                          ramp(high, low, points[i + 1], points[i])});
  }
  intervals_.push_back({above.origin, kEnd, above, above});
}

void segment_lights(const FloatTransferFunction& tf, const SegmentBatch& batch, double tolerance) {
  HWY_DYNAMIC_DISPATCH(lights)(tf, batch, piece_bounds(tolerance));
}

}  // namespace tetraglass::preint
#endif  // HWY_ONCE
