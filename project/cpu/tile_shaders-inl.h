// What becomes of the segments of a tile in each mode whose picture does not depend on the order of
// the cells. Compiled for each instruction set: included only by tile_kernel.cpp, after highway.h.

#if defined(TETRAGLASS_PROJECT_CPU_TILE_SHADERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRAGLASS_PROJECT_CPU_TILE_SHADERS_INL_H_
#undef TETRAGLASS_PROJECT_CPU_TILE_SHADERS_INL_H_
#else
#define TETRAGLASS_PROJECT_CPU_TILE_SHADERS_INL_H_
#endif

#include <algorithm>
#include <array>
#include <cstdint>

#include <hwy/highway.h>

#include "project/cpu/tile_raster-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tetraglass::project::cpu::HWY_NAMESPACE {

/// The length of the ray inside the mesh (weiler2002 Fig. 7).
class ThicknessShader {
 public:
  static constexpr bool kValues = false;

  ThicknessShader(const Picture& picture, float* sums)
      : unit_(static_cast<float>(picture.projection->radius)), sums_(sums) {
    std::fill_n(sums, kTilePixels, 0.0F);
  }

  HWY_INLINE bool begin(std::uint32_t) { return true; }

  HWY_INLINE void add(std::size_t block, Lanes covered, const BlockSegments& s) {
    float* sum = sums_ + block * kLanes;
    const Float length = hn::IfThenElseZero(covered, s.length);
    hn::Store(hn::Add(hn::Load(FloatTag(), sum), length), FloatTag(), sum);
  }

  [[nodiscard]] std::array<float, 4> pixel(std::size_t i) const {
    const float length = sums_[i] * unit_;
    return {length, length, length, length > 0 ? 1.0F : 0.0F};
  }

 private:
  float unit_;
  float* sums_;
};

}  // namespace tetraglass::project::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
