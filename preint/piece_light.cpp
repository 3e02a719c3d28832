#include "preint/piece_light.h"

#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "preint/piece_light.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set
#include <hwy/highway.h>

#include "preint/piece_light-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tetraglass::preint::HWY_NAMESPACE {

/// All pieces by one form, the last ones one by one.
template <class Form>
HWY_INLINE void for_all_pieces(const PieceBatch& batch, const Form& light_of) {
  namespace hn = hwy::HWY_NAMESPACE;
  const auto pieces = [&](auto d, std::size_t begin, std::size_t end) HWY_ATTR {
    const auto half = hn::Set(d, 0.5F);
    for (std::size_t i = begin; i < end; i += hn::Lanes(d)) {
      const auto light = light_of(
          d, optical_piece(d, hn::LoadU(d, &batch.k_front[i]), hn::LoadU(d, &batch.k_back[i])));
      hn::StoreU(hn::Mul(half, hn::Sub(light.opacity, light.skew)), d, &batch.front[i]);
      hn::StoreU(hn::Mul(half, hn::Add(light.opacity, light.skew)), d, &batch.back[i]);
      hn::StoreU(light.transmittance, d, &batch.transmittance[i]);
    }
  };
  const hn::ScalableTag<float> d;
  const std::size_t count = batch.k_front.size();
  const std::size_t whole = count - count % hn::Lanes(d);
  pieces(d, 0, whole);
  pieces(hn::CappedTag<float, 1>(), whole, count);
}

void lights(const PieceBatch& batch, const PieceBounds& bounds) {
  for_all_pieces(batch, [&](auto d, auto piece) HWY_ATTR { return piece_light(d, piece, bounds); });
}

}  // namespace tetraglass::preint::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tetraglass::preint {

HWY_EXPORT(lights);

void piece_lights(const PieceBatch& batch, double tolerance) {
  HWY_DYNAMIC_DISPATCH(lights)(batch, piece_bounds(tolerance));
}

}  // namespace tetraglass::preint
#endif  // HWY_ONCE
