// The light of linear pieces in vectors of floats, to be compiled for each instruction set: include
// this only in .cpp files that are written for Highway's foreach_target (as piece_light.cpp is),
// after highway.h.

#if defined(TETRAGLASS_PREINT_PIECE_LIGHT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRAGLASS_PREINT_PIECE_LIGHT_INL_H_
#undef TETRAGLASS_PREINT_PIECE_LIGHT_INL_H_
#else
#define TETRAGLASS_PREINT_PIECE_LIGHT_INL_H_
#endif

#include <array>
#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

#include "preint/gauss.h"
#include "preint/piece_series.h"

HWY_BEFORE_NAMESPACE();
namespace tetraglass::preint::HWY_NAMESPACE {

/// A linear piece: its optical depth D = (k_front + k_back) / 2 and how much its extinction rises,
/// h = (k_back - k_front) / 2, both times the length of the piece; |h| <= D.
template <class V>
struct OpticalPiece {
  V depth;
  V rise;
};

template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE OpticalPiece<V> optical_piece(D d, V k_front, V k_back) {
  namespace hn = hwy::HWY_NAMESPACE;
  const V half = hn::Set(d, 0.5F);
  return {hn::Mul(half, hn::Add(k_front, k_back)), hn::Mul(half, hn::Sub(k_back, k_front))};
}

/// What reaches the front of a piece of a color that is linear on it: opacity times its mean over
/// both ends plus skew times half its difference, back minus front. So (opacity - skew) / 2 of the
/// color at the front and (opacity + skew) / 2 of that at the back.
template <class V>
struct PieceLight {
  V opacity;
  V skew;
  V transmittance;  ///< 1 - opacity
};

/// 2 (F - 1) up to the total degree.
template <std::size_t kDegree, class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE V piece_series(D d, const OpticalPiece<V>& piece) {
  namespace hn = hwy::HWY_NAMESPACE;
  static constexpr auto kC = piece_coefficients<kDegree>();
  const V square = hn::Mul(piece.depth, piece.depth);
  // Of h^k, as a polynomial in D^2 from its term `lowest` on.
  const auto factor = [&](std::size_t k, std::size_t lowest) HWY_ATTR {
    std::size_t j = (kDegree - k) / 2;
    V sum = hn::Set(d, 2 * kC[k][j]);
    while (j-- > lowest) sum = hn::MulAdd(sum, square, hn::Set(d, 2 * kC[k][j]));
    return sum;
  };
  V sum = factor(kDegree, 0);
  for (std::size_t k = kDegree; k-- > 1;) sum = hn::MulAdd(sum, piece.rise, factor(k, 0));
  return hn::MulAdd(sum, piece.rise, hn::Mul(square, factor(0, 1)));
}

/// 1 - exp(-y / kDivisor), kDivisor a power of 2, as a polynomial.
template <int kDegree, int kDivisor, class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE V polynomial_absorbed(D d, V y) {
  namespace hn = hwy::HWY_NAMESPACE;
  static constexpr auto kC = absorbed_coefficients<kDegree, kDivisor>();
  V sum = hn::Set(d, kC[kDegree]);
  for (std::size_t m = kDegree; m-- > 1;) sum = hn::MulAdd(sum, y, hn::Set(d, kC[m]));
  return hn::Mul(sum, y);
}

/// 1 - exp(-y) for y >= 0, to 2e-7 of itself: 1 - 2^-n exp(-r) with y = n log 2 + r,
/// |r| <= log(2) / 2, so that small y stay small. From y = 87 on that of 87.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE V absorbed(D d, V y) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::RebindToSigned<D> integers;
  const V one = hn::Set(d, 1.0F);
  y = hn::Min(y, hn::Set(d, 87.0F));
  const auto n = hn::NearestInt(hn::Mul(y, hn::Set(d, 1.44269504F)));
  const V whole = hn::ConvertTo(d, n);
  // log 2 in two parts, the first with zeros at its end: its product with n is exact.
  const V r = hn::NegMulAdd(whole, hn::Set(d, -2.12194440e-4F),
                            hn::NegMulAdd(whole, hn::Set(d, 0.693359375F), y));
  const V power = hn::BitCast(d, hn::ShiftLeft<23>(hn::Sub(hn::Set(integers, 127), n)));  // 2^-n
  return hn::MulAdd(power, polynomial_absorbed<7, 1>(d, r), hn::Sub(one, power));
}

/// Light from 1 - exp(-D / 2) and 2 (F - 1) (see piece_series.h), each with its own relative
/// accuracy, in a form that keeps it.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE PieceLight<V> light_of_series(D d, V half_absorbed, V rest) {
  namespace hn = hwy::HWY_NAMESPACE;
  const V e = hn::Sub(hn::Set(d, 1.0F), half_absorbed);
  return {hn::MulAdd(half_absorbed, e, half_absorbed),
          hn::NegMulAdd(half_absorbed, half_absorbed, hn::Mul(e, rest)), hn::Mul(e, e)};
}

/// The light of pieces of a depth of at most PieceBounds::thin: no exponential, and nothing gives
/// nothing (0, 0 and a transmittance of exactly 1).
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE PieceLight<V> piece_light_thin(D d, const OpticalPiece<V>& piece) {
  return light_of_series(d, polynomial_absorbed<5, 2>(d, piece.depth), piece_series<4>(d, piece));
}

/// The same to PieceBounds::moderate.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE PieceLight<V> piece_light_moderate(D d, const OpticalPiece<V>& piece) {
  return light_of_series(d, polynomial_absorbed<7, 2>(d, piece.depth), piece_series<6>(d, piece));
}

/// The same to PieceBounds::dense; one exponential.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE PieceLight<V> piece_light_dense(D d, const OpticalPiece<V>& piece) {
  namespace hn = hwy::HWY_NAMESPACE;
  const V half_depth = hn::Mul(hn::Set(d, 0.5F), piece.depth);
  return light_of_series(d, absorbed(d, half_depth), piece_series<12>(d, piece));
}

/// The same for any depth (extinctions to 1e15): Gauss-Legendre with ten nodes on the half where
/// the front part of the depth of at most 17 lies, and on the other; behind lies less than 5e-8.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE PieceLight<V> piece_light_deep(D d, const OpticalPiece<V>& piece) {
  namespace hn = hwy::HWY_NAMESPACE;
  const V one = hn::Set(d, 1.0F);
  const V most = hn::Set(d, 1e15F);
  const V depth = hn::Min(piece.depth, most);
  const V half_slope = hn::Min(hn::Max(piece.rise, hn::Neg(depth)), depth);
  const V slope = hn::Add(half_slope, half_slope);
  const V k_front = hn::Sub(depth, half_slope);
  const V visible = hn::Min(depth, hn::Set(d, 17.0F));
  V from = hn::Zero(d);
  V front_share = from, back_share = from;
  for (const float share : {0.5F, 1.0F}) {
    // Where the optical depth is u: x = 2 u / (k_front + sqrt(k_front^2 + 2 slope u)), see
    // segment_integral.cpp.
    const V u = hn::Mul(hn::Set(d, share), visible);
    const V square = hn::MulAdd(hn::Add(slope, slope), u, hn::Mul(k_front, k_front));
    const V root = hn::Sqrt(hn::Max(square, hn::Zero(d)));
    const V below = hn::Max(hn::Add(k_front, root), hn::Set(d, 1e-30F));
    V to = hn::Min(one, hn::Div(hn::Add(u, u), below));
    // The last part ends with the piece where that is visible: the quotient is rounded.
    if (share == 1.0F) to = hn::IfThenElse(hn::Lt(visible, depth), to, one);
    const V width = hn::Sub(to, from);
    for (const GaussNode& node : kGauss10) {
      const V x = hn::MulAdd(width, hn::Set(d, static_cast<float>(node.x)), from);
      const V tau = hn::Mul(x, hn::MulAdd(half_slope, x, k_front));
      const V k = hn::Mul(hn::MulAdd(slope, x, k_front),
                          hn::Mul(width, hn::Set(d, static_cast<float>(node.weight))));
      const V light = hn::NegMulAdd(k, absorbed(d, tau), k);
      back_share = hn::MulAdd(x, light, back_share);
      front_share = hn::MulAdd(hn::Sub(one, x), light, front_share);
    }
    from = to;
  }
  const V opacity = absorbed(d, depth);
  return {hn::Add(front_share, back_share), hn::Sub(back_share, front_share),
          hn::Sub(one, opacity)};
}

/// Out of the way of the others, which take nearly all pieces.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_NOINLINE PieceLight<V> piece_light_any(D d, OpticalPiece<V> piece, float dense_bound) {
  namespace hn = hwy::HWY_NAMESPACE;
  const auto dense = hn::Le(piece.depth, hn::Set(d, dense_bound));
  const PieceLight<V> deep = piece_light_deep(d, piece);
  const PieceLight<V> light = piece_light_dense(d, piece);
  return {hn::IfThenElse(dense, light.opacity, deep.opacity),
          hn::IfThenElse(dense, light.skew, deep.skew),
          hn::IfThenElse(dense, light.transmittance, deep.transmittance)};
}

/// The light of pieces of any depth, by the cheapest form that serves all lanes within the bounds.
/// Error of the light: their tolerance times the opacity.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE PieceLight<V> piece_light(D d, const OpticalPiece<V>& piece, const PieceBounds& bounds) {
  namespace hn = hwy::HWY_NAMESPACE;
  const auto at_most = [&](float limit) HWY_ATTR {
    return hn::AllTrue(d, hn::Le(piece.depth, hn::Set(d, limit)));
  };
  if (HWY_LIKELY(at_most(bounds.thin))) return piece_light_thin(d, piece);
  if (at_most(bounds.moderate)) return piece_light_moderate(d, piece);
  if (at_most(bounds.dense)) return piece_light_dense(d, piece);
  return piece_light_any(d, piece, bounds.dense);
}

}  // namespace tetraglass::preint::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
