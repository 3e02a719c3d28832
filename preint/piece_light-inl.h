// The light of linear pieces in vectors of floats, to be compiled for each instruction set: include
// this only in .cpp files that are written for Highway's foreach_target (as piece_light.cpp is),
// after highway.h.

#if defined(TETRAGLASS_PREINT_PIECE_LIGHT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRAGLASS_PREINT_PIECE_LIGHT_INL_H_
#undef TETRAGLASS_PREINT_PIECE_LIGHT_INL_H_
#else
#define TETRAGLASS_PREINT_PIECE_LIGHT_INL_H_
#endif

#include <cstddef>

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include "preint/gauss.h"

HWY_BEFORE_NAMESPACE();
namespace tetraglass::preint::HWY_NAMESPACE {

/// How much of the colors at both ends of a piece reaches its front, and what passes through it.
template <class V>
struct PieceLight {
  V front;
  V back;
  V transmittance;
};

/// Pieces of optical extinction (extinction times length, >= 0) `k_front` and `k_back`, linear in
/// between: light = front color_front + back color_back. Gauss-Legendre with the nodes of `rule` on
/// the part of the piece where the optical depth lies between depth j / parts and depth (j + 1) /
/// parts, j = 0 ... parts - 1, of `reached` (what lies deeper is left out).
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>, std::size_t kNodes>
HWY_INLINE PieceLight<V> piece_light(D d, V k_front, V k_back,
                                     const std::array<GaussNode, kNodes>& rule, int parts,
                                     float reached) {
  namespace hn = hwy::HWY_NAMESPACE;
  const V half = hn::Set(d, 0.5F);
  const V one = hn::Set(d, 1.0F);
  const V slope = hn::Sub(k_back, k_front);
  const V half_slope = hn::Mul(half, slope);
  const V depth = hn::Mul(half, hn::Add(k_front, k_back));
  V from = hn::Zero(d);
  PieceLight<V> sum{from, from, hn::Exp(d, hn::Neg(depth))};
  for (int part = 1; part <= parts; ++part) {
    // Where the optical depth is u: x = 2 u / (k_front + sqrt(k_front^2 + 2 slope u)), see
    // segment_integral.cpp.
    V to = one;
    if (parts > 1) {
      const float share = static_cast<float>(part) / static_cast<float>(parts);
      const V visible = hn::Min(depth, hn::Set(d, reached));
      const V u = hn::Mul(hn::Set(d, share), visible);
      const V square = hn::MulAdd(hn::Add(slope, slope), u, hn::Mul(k_front, k_front));
      const V root = hn::Sqrt(hn::Max(square, hn::Zero(d)));
      const V below = hn::Max(hn::Add(k_front, root), hn::Set(d, 1e-30F));
      to = hn::Min(one, hn::Div(hn::Add(u, u), below));
      // The last part ends with the piece where that is visible: the quotient is rounded.
      if (part == parts) to = hn::IfThenElse(hn::Lt(visible, depth), to, one);
    }
    const V width = hn::Sub(to, from);
    for (const GaussNode& node : rule) {
      const V x = hn::MulAdd(width, hn::Set(d, static_cast<float>(node.x)), from);
      const V tau = hn::Mul(x, hn::MulAdd(half_slope, x, k_front));
      const V k = hn::Mul(hn::MulAdd(slope, x, k_front),
                          hn::Mul(width, hn::Set(d, static_cast<float>(node.weight))));
      const V light = hn::Mul(k, hn::Exp(d, hn::Neg(tau)));
      sum.back = hn::MulAdd(x, light, sum.back);
      sum.front = hn::MulAdd(hn::Sub(one, x), light, sum.front);
    }
    from = to;
  }
  return sum;
}

}  // namespace tetraglass::preint::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
