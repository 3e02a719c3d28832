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

/// How much of the colors at both ends of a piece reaches its front, and what passes through it:
/// light = front color_front + back color_back. front + back = 1 - transmittance.
template <class V>
struct PieceLight {
  V front;
  V back;
  V transmittance;
};

/// What the series of a piece (piece_series.h) takes.
template <class V>
struct SeriesArguments {
  V depth;       ///< D, the optical depth
  V half_depth;  ///< D / 2
  V square;      ///< D^2
  V rise;        ///< h
};

template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE SeriesArguments<V> series_arguments(D d, V k_front, V k_back) {
  namespace hn = hwy::HWY_NAMESPACE;
  const V half = hn::Set(d, 0.5F);
  const V depth = hn::Mul(half, hn::Add(k_front, k_back));
  return {depth, hn::Mul(half, depth), hn::Mul(depth, depth),
          hn::Mul(half, hn::Sub(k_back, k_front))};
}

/// F - 1 up to the total degree.
template <std::size_t kDegree, class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE V piece_series(D d, const SeriesArguments<V>& x) {
  namespace hn = hwy::HWY_NAMESPACE;
  static constexpr auto kC = piece_coefficients<kDegree>();
  // Of h^k, as a polynomial in D^2 from its term `lowest` on.
  const auto factor = [&](std::size_t k, std::size_t lowest) HWY_ATTR {
    std::size_t j = (kDegree - k) / 2;
    V sum = hn::Set(d, kC[k][j]);
    while (j-- > lowest) sum = hn::MulAdd(sum, x.square, hn::Set(d, kC[k][j]));
    return sum;
  };
  V sum = factor(kDegree, 0);
  for (std::size_t k = kDegree; k-- > 1;) sum = hn::MulAdd(sum, x.rise, factor(k, 0));
  return hn::MulAdd(sum, x.rise, hn::Mul(x.square, factor(0, 1)));
}

/// 1 - exp(-y) as a polynomial.
template <int kDegree, class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE V polynomial_absorbed(D d, V y) {
  namespace hn = hwy::HWY_NAMESPACE;
  static constexpr auto kC = absorbed_coefficients<kDegree>();
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
  return hn::MulAdd(power, polynomial_absorbed<7>(d, r), hn::Sub(one, power));
}

/// Light from 1 - exp(-depth / 2) and F - 1 (see piece_series.h), each with its own relative
/// accuracy, in a form that keeps it.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE PieceLight<V> light_of_series(D d, V half_absorbed, V rest) {
  namespace hn = hwy::HWY_NAMESPACE;
  const V e = hn::Sub(hn::Set(d, 1.0F), half_absorbed);
  return {hn::NegMulAdd(rest, e, half_absorbed), hn::Mul(e, hn::Add(rest, half_absorbed)),
          hn::Mul(e, e)};
}

/// Pieces of optical extinction (extinction times length, >= 0) `k_front` and `k_back`, linear in
/// between, of an optical depth (k_front + k_back) / 2 of at most kThinPiece: no exponential, and
/// nothing gives nothing (0, 0 and a transmittance of exactly 1). Error of each result: at most
/// 1e-6, of the shares of light also relative to the opacity.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE PieceLight<V> piece_light_thin(D d, V k_front, V k_back) {
  const auto x = series_arguments(d, k_front, k_back);
  return light_of_series(d, polynomial_absorbed<5>(d, x.half_depth), piece_series<4>(d, x));
}

/// The same to a depth of kModeratePiece.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE PieceLight<V> piece_light_moderate(D d, V k_front, V k_back) {
  const auto x = series_arguments(d, k_front, k_back);
  return light_of_series(d, polynomial_absorbed<7>(d, x.half_depth), piece_series<6>(d, x));
}

/// The same to a depth of kDensePiece; one exponential.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE PieceLight<V> piece_light_dense(D d, V k_front, V k_back) {
  const auto x = series_arguments(d, k_front, k_back);
  return light_of_series(d, absorbed(d, x.half_depth), piece_series<12>(d, x));
}

/// The same for any depth (extinctions to 1e15): Gauss-Legendre with ten nodes on the half where
/// the front part of the depth of at most 17 lies, and on the other; behind lies less than 5e-8.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE PieceLight<V> piece_light_deep(D d, V k_front, V k_back) {
  namespace hn = hwy::HWY_NAMESPACE;
  const V half = hn::Set(d, 0.5F);
  const V one = hn::Set(d, 1.0F);
  const V slope = hn::Sub(k_back, k_front);
  const V half_slope = hn::Mul(half, slope);
  const V depth = hn::Mul(half, hn::Add(k_front, k_back));
  const V visible = hn::Min(depth, hn::Set(d, 17.0F));
  V from = hn::Zero(d);
  PieceLight<V> sum{from, from, hn::Sub(one, absorbed(d, depth))};
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
      sum.back = hn::MulAdd(x, light, sum.back);
      sum.front = hn::MulAdd(hn::Sub(one, x), light, sum.front);
    }
    from = to;
  }
  return sum;
}

/// The same for any depth; deep pieces cost only where a vector has one.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE PieceLight<V> piece_light(D d, V k_front, V k_back) {
  namespace hn = hwy::HWY_NAMESPACE;
  const auto x = series_arguments(d, k_front, k_back);
  const auto dense = hn::Le(x.depth, hn::Set(d, kDensePiece));
  PieceLight<V> light = light_of_series(d, absorbed(d, x.half_depth), piece_series<12>(d, x));
  if (HWY_LIKELY(hn::AllTrue(d, dense))) return light;
  const PieceLight<V> deep = piece_light_deep(d, k_front, k_back);
  return {hn::IfThenElse(dense, light.front, deep.front),
          hn::IfThenElse(dense, light.back, deep.back),
          hn::IfThenElse(dense, light.transmittance, deep.transmittance)};
}

}  // namespace tetraglass::preint::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
