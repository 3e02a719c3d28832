#include "preint/piece_light.h"

#include <array>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "preint/piece_light.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set
#include <hwy/highway.h>

#include "preint/gauss.h"
#include "preint/piece_light-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tetraglass::preint::HWY_NAMESPACE {

template <std::size_t kNodes>
void lights(const PieceBatch& batch, const std::array<GaussNode, kNodes>& rule, int parts,
            float reached) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::ScalableTag<float> d;
  const std::size_t lanes = hn::Lanes(d);
  const std::size_t count = batch.k_front.size();
  const std::size_t whole = count - count % lanes;
  for (std::size_t i = 0; i < whole; i += lanes) {
    const auto light = piece_light(d, hn::LoadU(d, &batch.k_front[i]),
                                   hn::LoadU(d, &batch.k_back[i]), rule, parts, reached);
    hn::StoreU(light.front, d, &batch.front[i]);
    hn::StoreU(light.back, d, &batch.back[i]);
    hn::StoreU(light.transmittance, d, &batch.transmittance[i]);
  }
  const hn::CappedTag<float, 1> single;
  for (std::size_t i = whole; i < count; ++i) {
    const auto light = piece_light(single, hn::Set(single, batch.k_front[i]),
                                   hn::Set(single, batch.k_back[i]), rule, parts, reached);
    batch.front[i] = hn::GetLane(light.front);
    batch.back[i] = hn::GetLane(light.back);
    batch.transmittance[i] = hn::GetLane(light.transmittance);
  }
}

// The bounds of the rules are those of the segment integral for 1e-6.
void lights4(const PieceBatch& batch) {
  lights(batch, kGauss4, 1, 0);
}
void lights6(const PieceBatch& batch) {
  lights(batch, kGauss6, 1, 0);
}
void lights10(const PieceBatch& batch) {
  lights(batch, kGauss10, 1, 0);
}

/// Behind a depth of 17 lies less than 5e-8.
void lights_deep(const PieceBatch& batch) {
  lights(batch, kGauss10, 2, 17);
}

}  // namespace tetraglass::preint::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tetraglass::preint {

HWY_EXPORT(lights4);
HWY_EXPORT(lights6);
HWY_EXPORT(lights10);
HWY_EXPORT(lights_deep);

void piece_lights(const PieceBatch& batch, float deepest) {
  if (deepest <= 0.28F) {
    HWY_DYNAMIC_DISPATCH(lights4)(batch);
  } else if (deepest <= 1.9F) {
    HWY_DYNAMIC_DISPATCH(lights6)(batch);
  } else if (deepest <= 8.8F) {
    HWY_DYNAMIC_DISPATCH(lights10)(batch);
  } else {
    HWY_DYNAMIC_DISPATCH(lights_deep)(batch);
  }
}

}  // namespace tetraglass::preint
#endif  // HWY_ONCE
