#include "preint/segment_light.h"

#include <algorithm>
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

/// Segments of one vector.
template <class V, class M>
struct Segments {
  V low, high;  ///< values
  V per_value;  ///< length per difference of values
  V length;
  M rising;    ///< the front is the low end
  M constant;  ///< both ends are the same
};

/// The interval that holds `value` and values just above it, searched from `guess` on.
HWY_INLINE std::size_t find_interval(const std::vector<FloatTransferFunction::Interval>& intervals,
                                     std::size_t guess, float value) {
  while (guess > 0 && value < intervals[guess].low) --guess;
  while (guess + 1 < intervals.size() && intervals[guess + 1].low <= value) ++guess;
  return guess;
}

/// Light gathered from some intervals, in the order of the values.
template <class V>
struct Gathered {
  V color[3];
  V transmittance;
};

/// The form for the deepest of the pieces.
template <class D, class V = hn::Vec<D>>
HWY_INLINE PieceLight<V> cheapest_light(D d, V k_front, V k_back) {
  const V depth = hn::Mul(hn::Set(d, 0.5F), hn::Add(k_front, k_back));
  if (hn::AllTrue(d, hn::Le(depth, hn::Set(d, kThinPiece)))) {
    return piece_light_thin(d, k_front, k_back);
  }
  if (hn::AllTrue(d, hn::Le(depth, hn::Set(d, kModeratePiece)))) {
    return piece_light_moderate(d, k_front, k_back);
  }
  return piece_light(d, k_front, k_back);
}

template <class D, class V, class M>
HWY_INLINE void add_interval(D d, const FloatTransferFunction::Interval& interval,
                             const Segments<V, M>& s, Gathered<V>& sum) {
  const V one = hn::Set(d, 1.0F);
  const V bottom = hn::Set(d, interval.low), top = hn::Set(d, interval.high);
  const V low = hn::Min(hn::Max(s.low, bottom), top);
  const V high = hn::Min(hn::Max(s.high, bottom), top);
  // A segment of one value lies in the interval that begins at it or below it.
  const auto inside = hn::And(s.constant, hn::And(hn::Ge(s.low, bottom), hn::Lt(s.low, top)));
  const V length = hn::IfThenElse(inside, s.length, hn::Mul(hn::Sub(high, low), s.per_value));
  // Weights of both ends of the interval, not one end plus a slope: an extinction that falls to 0
  // keeps its relative accuracy there.
  const V inverse = hn::Set(d, interval.inverse_width);
  const V low_up = hn::Mul(hn::Sub(low, bottom), inverse);
  const V high_up = hn::Mul(hn::Sub(high, bottom), inverse);
  V low_down = one, high_down = one;
  if (interval.inverse_width > 0) {
    low_down = hn::Mul(hn::Sub(top, low), inverse);
    high_down = hn::Mul(hn::Sub(top, high), inverse);
  }
  const auto between = [&](V down, V up, float at_low, float at_high) HWY_ATTR {
    return hn::MulAdd(down, hn::Set(d, at_low), hn::Mul(up, hn::Set(d, at_high)));
  };
  const V most = hn::Set(d, 1e15F);
  const auto optical = [&](V down, V up) HWY_ATTR {
    return hn::Min(hn::Mul(between(down, up, interval.k_low, interval.k_high), length), most);
  };
  const V k_low = optical(low_down, low_up), k_high = optical(high_down, high_up);
  const auto light = cheapest_light(d, hn::IfThenElse(s.rising, k_low, k_high),
                                    hn::IfThenElse(s.rising, k_high, k_low));
  const V at_low = hn::IfThenElse(s.rising, light.front, light.back);
  const V at_high = hn::IfThenElse(s.rising, light.back, light.front);
  // What comes later lies behind where the values rise, in front where they fall.
  const V dim_new = hn::IfThenElse(s.rising, sum.transmittance, one);
  const V dim_old = hn::IfThenElse(s.rising, one, light.transmittance);
  // Shares of the colors at both ends of the interval.
  const V share_low = hn::Mul(dim_new, hn::MulAdd(at_low, low_down, hn::Mul(at_high, high_down)));
  const V share_high = hn::Mul(dim_new, hn::MulAdd(at_low, low_up, hn::Mul(at_high, high_up)));
  for (std::size_t c = 0; c < 3; ++c) {
    const V old = hn::Mul(dim_old, sum.color[c]);
    sum.color[c] = hn::MulAdd(share_low, hn::Set(d, interval.color_low[c]),
                              hn::MulAdd(share_high, hn::Set(d, interval.color_high[c]), old));
  }
  sum.transmittance = hn::Mul(sum.transmittance, light.transmittance);
}

/// The segments from the i-th on; `first` is the interval of the smallest value, and was that of
/// the vector before.
template <class D>
HWY_INLINE void add_segments(D d, const std::vector<FloatTransferFunction::Interval>& intervals,
                             const SegmentBatch& batch, std::size_t i, std::size_t& first) {
  using V = hn::Vec<D>;
  const V front = hn::LoadU(d, &batch.front[i]), back = hn::LoadU(d, &batch.back[i]);
  const V one = hn::Set(d, 1.0F), zero = hn::Zero(d);
  Segments<V, hn::Mask<D>> s{
      hn::Min(front, back),           hn::Max(front, back), zero,
      hn::LoadU(d, &batch.length[i]), hn::Lt(front, back),  hn::Eq(front, back)};
  const V difference = hn::IfThenElse(s.constant, one, hn::Sub(s.high, s.low));
  s.per_value = hn::IfThenElse(s.constant, zero, hn::Div(s.length, difference));
  Gathered<V> sum{{zero, zero, zero}, one};
  first = find_interval(intervals, first, hn::GetLane(hn::MinOfLanes(d, s.low)));
  const float highest = hn::GetLane(hn::MaxOfLanes(d, s.high));
  std::size_t k = first;
  do {
    add_interval(d, intervals[k], s, sum);
    ++k;
  } while (k < intervals.size() && intervals[k].low <= highest);
  hn::StoreU(sum.color[0], d, &batch.red[i]);
  hn::StoreU(sum.color[1], d, &batch.green[i]);
  hn::StoreU(sum.color[2], d, &batch.blue[i]);
  hn::StoreU(sum.transmittance, d, &batch.transmittance[i]);
}

void lights(const FloatTransferFunction& tf, const SegmentBatch& batch) {
  const hn::ScalableTag<float> d;
  const std::size_t count = batch.front.size();
  const std::size_t whole = count - count % hn::Lanes(d);
  std::size_t first = 0;
  for (std::size_t i = 0; i < whole; i += hn::Lanes(d)) {
    add_segments(d, tf.intervals(), batch, i, first);
  }
  const hn::CappedTag<float, 1> single;
  for (std::size_t i = whole; i < count; ++i) {
    add_segments(single, tf.intervals(), batch, i, first);
  }
}

}  // namespace tetraglass::preint::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tetraglass::preint {

HWY_EXPORT(lights);

FloatTransferFunction::FloatTransferFunction(const TransferFunction& tf) {
  constexpr float kLowest = std::numeric_limits<float>::lowest();
  constexpr float kMost = std::numeric_limits<float>::max();
  const auto rounded = [](double x) {
    return static_cast<float>(std::clamp<double>(x, kLowest, kMost));
  };
  const auto add = [&](float low, float high, const ControlPoint& a, const ControlPoint& b,
                       float inverse_width) {
    if (!(low < high)) return;
    Interval interval{low,
                      high,
                      inverse_width,
                      static_cast<float>(std::min(a.extinction, 1e30)),
                      static_cast<float>(std::min(b.extinction, 1e30)),
                      {},
                      {}};
    for (int c = 0; c < 3; ++c) {
      interval.color_low[c] = rounded(a.color[c]);
      interval.color_high[c] = rounded(b.color[c]);
    }
    intervals_.push_back(interval);
  };
  const auto& points = tf.points();
  add(kLowest, rounded(points.front().value), points.front(), points.front(), 0);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const float low = rounded(points[i].value), high = rounded(points[i + 1].value);
    add(low, high, points[i], points[i + 1], 1 / (high - low));
  }
  add(rounded(points.back().value), kMost, points.back(), points.back(), 0);
}

void segment_lights(const FloatTransferFunction& tf, const SegmentBatch& batch) {
  HWY_DYNAMIC_DISPATCH(lights)(tf, batch);
}

}  // namespace tetraglass::preint
#endif  // HWY_ONCE
