// Isosurfaces, nearest first. Compiled for each instruction set: included only by tile_kernel.cpp,
// after highway.h.

#if defined(TETRAGLASS_PROJECT_CPU_ISO_SHADER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRAGLASS_PROJECT_CPU_ISO_SHADER_INL_H_
#undef TETRAGLASS_PROJECT_CPU_ISO_SHADER_INL_H_
#else
#define TETRAGLASS_PROJECT_CPU_ISO_SHADER_INL_H_
#endif

#include <cstdint>
#include <optional>
#include <span>

#include <hwy/highway.h>

#include "project/cpu/lighting-inl.h"
#include "project/cpu/ordered_shader-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tetraglass::project::cpu::HWY_NAMESPACE {

/// The crossings of rays with isosurfaces (weiler2002 section 5.2), lit, go to the delay line of
/// their block.
class IsoShader {
 public:
  static constexpr bool kValues = true;
  static constexpr bool kKeys = true;

  IsoShader(const Picture& picture, int x, int y, OrderedBlocks& blocks)
      : surfaces_(picture.surfaces), blocks_(blocks) {
    if (picture.lighting != nullptr) lighting_.emplace(picture, x, y);
  }

  HWY_INLINE void prefetch(std::uint32_t) const {}
  HWY_INLINE bool begin(std::uint32_t cell) {
    blocks_.begin(cell);
    if (lighting_) lighting_->begin(cell);
    return true;
  }
  [[nodiscard]] HWY_INLINE bool wants(std::size_t block) const { return blocks_.wants(block); }

  HWY_INLINE void add(std::size_t block, Lanes covered, const BlockSegments& s) {
    for (const Surface& surface : surfaces_) {
      const Float value = set(surface.value);
      // Half open, as preint::crosses: of two segments with a common end exactly one is crossed.
      const Lanes front_below = hn::Lt(s.front, set(surface.threshold));
      const Lanes back_below = hn::Lt(s.back, set(surface.threshold));
      const Lanes crossed = hn::And(covered, hn::Xor(front_below, back_below));
      if (hn::AllFalse(FloatTag(), crossed)) continue;
      const Float span = hn::IfThenElse(crossed, hn::Sub(s.back, s.front), set(1));
      const Float t = hn::Min(hn::Max(hn::Div(hn::Sub(value, s.front), span), set(0)), set(1));
      const Float depth = hn::MulAdd(t, hn::Sub(s.far, s.near), s.near);
      Fragment f;
      f.channel[0] = hn::Add(depth, depth);
      const Float opacity = hn::IfThenElseZero(crossed, set(surface.opacity));
      shade(surface, block, depth, opacity, f);
      f.channel[4] = opacity;
      blocks_.insert(block, crossed, f);
    }
  }

 private:
  HWY_INLINE void shade(const Surface& surface, std::size_t block, Float depth, Float opacity,
                        Fragment& f) const {
    Vector3 color = {set(surface.color[0]), set(surface.color[1]), set(surface.color[2])};
    if (lighting_) {
      const preint::Material& m = surface.material;
      const MaterialLanes material = {
          set(static_cast<float>(m.ambient)), set(static_cast<float>(m.diffuse)),
          set(static_cast<float>(m.specular)), set(static_cast<float>(m.shininess))};
      const CellLighting::Rays rays = lighting_->rays(block);
      const Vector3 gradient = lighting_->gradient(rays, depth);
      color = lighting_->shade(lighting_->illuminate(rays, depth, gradient, material.shininess),
                               color, material);
    }
    for (std::size_t c = 0; c < 3; ++c) f.channel[1 + c] = hn::Mul(opacity, color[c]);
  }

  std::span<const Surface> surfaces_;
  OrderedBlocks& blocks_;
  std::optional<CellLighting> lighting_;
};

}  // namespace tetraglass::project::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
