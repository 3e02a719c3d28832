// Parts the segments of a block at the control points of the transfer function. Compiled for each
// instruction set: included only by tile_kernel.cpp, after highway.h.

#if defined(TETRAGLASS_PROJECT_CPU_INTERVAL_WALK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRAGLASS_PROJECT_CPU_INTERVAL_WALK_INL_H_
#undef TETRAGLASS_PROJECT_CPU_INTERVAL_WALK_INL_H_
#else
#define TETRAGLASS_PROJECT_CPU_INTERVAL_WALK_INL_H_
#endif

#include <hwy/highway.h>

#include "project/cpu/medium.h"
#include "project/cpu/tile_raster-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tetraglass::project::cpu::HWY_NAMESPACE {

/// The part of segments in one interval of the medium. `front` and `back` are positions in the
/// interval, from 0 to 1; the length is 0 in lanes without such a part.
struct IntervalPart {
  Float front;
  Float back;
  Float length;
  Float start;  ///< where the part begins on its segment, from 0 to 1
  Float end;    ///< ... and where it ends
};

HWY_INLINE Float position(const MediumInterval& interval, Float value) {
  return hn::Mul(hn::Sub(value, set(interval.low)), set(interval.inverse_width));
}

/// Where values differ by less, a segment counts as one of so different ends: 4 roundings of the
/// largest values. Then it has a direction, and its part in each interval a share of the length.
inline constexpr float kLeastDifference = 0x1p-22F;

/// Calls visit(const MediumInterval&, const IntervalPart&) for the intervals of the
/// cell, ascending, or descending where `descend`. `length` is 0 in lanes that are not covered.
template <class Visit>
HWY_INLINE void walk_intervals(const Medium& medium, const IntervalRange& range, bool descend,
                               const BlockSegments& s, Float length, const Visit& visit) {
  const MediumInterval* intervals = medium.intervals().data();
  if (range.first == range.last) {
    const MediumInterval& only = intervals[range.first];
    visit(only,
          IntervalPart{position(only, s.front), position(only, s.back), length, set(0), set(1)});
    return;
  }
  const Float difference = hn::Sub(s.back, s.front);
  const Lanes flat = hn::Lt(hn::Abs(difference), set(kLeastDifference));
  const Float back = hn::IfThenElse(flat, hn::Add(s.front, set(kLeastDifference)), s.back);
  const Float span = hn::Abs(hn::Sub(back, s.front));
  const Float share_of_value = reciprocal(span);
  const Float length_of_value = hn::Mul(length, share_of_value);
  for (std::uint32_t k = range.first; k <= range.last; ++k) {
    const MediumInterval& interval = intervals[descend ? range.last - (k - range.first) : k];
    if (interval.clear()) continue;
    // The outermost intervals take what lies beyond them, too: rounding, and flat segments.
    const Float low = set(&interval == intervals ? -4.0F : interval.low);
    const Float high =
        set(&interval == intervals + medium.intervals().size() - 1 ? 4.0F : interval.high);
    const Float from = hn::Min(hn::Max(s.front, low), high);
    const Float to = hn::Min(hn::Max(back, low), high);
    const Float part = hn::Mul(length_of_value, hn::Abs(hn::Sub(to, from)));
    visit(interval, IntervalPart{position(interval, from), position(interval, to), part,
                                 hn::Mul(share_of_value, hn::Abs(hn::Sub(from, s.front))),
                                 hn::Mul(share_of_value, hn::Abs(hn::Sub(to, s.front)))});
  }
}

/// Extinction at a position of an interval.
HWY_INLINE Float extinction(const MediumInterval& interval, Float position) {
  return hn::MulAdd(set(interval.extinction_rise), position, set(interval.extinction));
}

HWY_INLINE Float color(const MediumInterval& interval, std::size_t channel, Float position) {
  return hn::MulAdd(set(interval.color_rise[channel]), position, set(interval.color[channel]));
}

/// The values of a cell field take the place of the points'.
HWY_INLINE void take_cell_value(const DrawnCells& cells, std::uint32_t cell, BlockSegments& s) {
  s.front = s.back = set(cells.cell_values[cell]);
}

}  // namespace tetraglass::project::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
