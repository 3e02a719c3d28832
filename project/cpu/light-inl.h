// The light of segments with a linear extinction, by the cheapest form that serves all lanes.
// Compiled for each instruction set: included only by .cpp files that are written for Highway's
// foreach_target, after highway.h.

#if defined(TETRAGLASS_PROJECT_CPU_LIGHT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRAGLASS_PROJECT_CPU_LIGHT_INL_H_
#undef TETRAGLASS_PROJECT_CPU_LIGHT_INL_H_
#else
#define TETRAGLASS_PROJECT_CPU_LIGHT_INL_H_
#endif

#include <hwy/highway.h>

#include "preint/piece_light-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tetraglass::project::cpu::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class V>
using SegmentLight = preint::HWY_NAMESPACE::PieceLight<V>;

/// What is deeper is black, whatever its depth.
inline constexpr float kDeepest = 1e15F;

/// Out of the way of the others, which take nearly all segments.
template <class D, class V = hn::Vec<D>>
HWY_NOINLINE SegmentLight<V> deep_light(D d, V a, V b) {
  const V most = hn::Set(d, kDeepest);
  return preint::HWY_NAMESPACE::piece_light(d, hn::Min(a, most), hn::Min(b, most));
}

/// The light of a segment of optical extinction (extinction times length) a at the front and b at
/// the back, linear in between: front c_front + back c_back for a color that is linear, too. Its
/// absolute error is that of the forms of piece_light-inl.h, 1e-6.
template <class D, class V = hn::Vec<D>>
HWY_INLINE SegmentLight<V> segment_light(D d, V a, V b) {
  const V depth = hn::Mul(hn::Set(d, 0.5F), hn::Add(a, b));
  const auto at_most = [&](float limit)
                           HWY_ATTR { return hn::AllTrue(d, hn::Le(depth, hn::Set(d, limit))); };
  if (HWY_LIKELY(at_most(preint::kThinPiece))) {
    return preint::HWY_NAMESPACE::piece_light_thin(d, a, b);
  }
  if (at_most(preint::kModeratePiece)) {
    return preint::HWY_NAMESPACE::piece_light_moderate(d, a, b);
  }
  return deep_light(d, a, b);
}

}  // namespace tetraglass::project::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
