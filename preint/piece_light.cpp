#include "preint/piece_light.h"

#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "preint/piece_light.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set
#include <hwy/highway.h>

#include "preint/piece_light-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tetraglass::preint::HWY_NAMESPACE {

/// `light(d, k_front, k_back)` of all pieces, the last ones one by one.
template <class Light>
HWY_INLINE void for_all_pieces(const PieceBatch& batch, const Light& light) {
  namespace hn = hwy::HWY_NAMESPACE;
  const auto pieces = [&](auto d, std::size_t begin, std::size_t end) HWY_ATTR {
    for (std::size_t i = begin; i < end; i += hn::Lanes(d)) {
      const auto l = light(d, hn::LoadU(d, &batch.k_front[i]), hn::LoadU(d, &batch.k_back[i]));
      hn::StoreU(l.front, d, &batch.front[i]);
      hn::StoreU(l.back, d, &batch.back[i]);
      hn::StoreU(l.transmittance, d, &batch.transmittance[i]);
    }
  };
  const hn::ScalableTag<float> d;
  const std::size_t count = batch.k_front.size();
  const std::size_t whole = count - count % hn::Lanes(d);
  pieces(d, 0, whole);
  pieces(hn::CappedTag<float, 1>(), whole, count);
}

void lights_thin(const PieceBatch& batch) {
  for_all_pieces(batch, [](auto d, auto k_front, auto k_back)
                            HWY_ATTR { return piece_light_thin(d, k_front, k_back); });
}
void lights_moderate(const PieceBatch& batch) {
  for_all_pieces(batch, [](auto d, auto k_front, auto k_back)
                            HWY_ATTR { return piece_light_moderate(d, k_front, k_back); });
}
void lights_dense(const PieceBatch& batch) {
  for_all_pieces(batch, [](auto d, auto k_front, auto k_back)
                            HWY_ATTR { return piece_light_dense(d, k_front, k_back); });
}
void lights_any(const PieceBatch& batch) {
  for_all_pieces(batch, [](auto d, auto k_front, auto k_back)
                            HWY_ATTR { return piece_light(d, k_front, k_back); });
}

}  // namespace tetraglass::preint::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tetraglass::preint {

HWY_EXPORT(lights_thin);
HWY_EXPORT(lights_moderate);
HWY_EXPORT(lights_dense);
HWY_EXPORT(lights_any);

void piece_lights(const PieceBatch& batch, float deepest) {
  if (deepest <= kThinPiece) {
    HWY_DYNAMIC_DISPATCH(lights_thin)(batch);
  } else if (deepest <= kModeratePiece) {
    HWY_DYNAMIC_DISPATCH(lights_moderate)(batch);
  } else if (deepest <= kDensePiece) {
    HWY_DYNAMIC_DISPATCH(lights_dense)(batch);
  } else {
    HWY_DYNAMIC_DISPATCH(lights_any)(batch);
  }
}

}  // namespace tetraglass::preint
#endif  // HWY_ONCE
