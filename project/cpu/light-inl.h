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

/// The light of a segment of optical extinction (extinction times length) a at the front and b at
/// the back, linear in between. Error: that of piece_light-inl.h at its finest, 1e-6 of the
/// opacity.
template <class D, class V = hn::Vec<D>>
HWY_INLINE SegmentLight<V> segment_light(D d, V a, V b) {
  namespace light = preint::HWY_NAMESPACE;
  return light::piece_light(d, light::optical_piece(d, a, b),
                            preint::piece_bounds(preint::kFinestPiece));
}

}  // namespace tetraglass::project::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
