// Isosurfaces, nearest first. Compiled for each instruction set: included only by tile_kernel.cpp,
// after highway.h.

#if defined(TETRAGLASS_PROJECT_CPU_ISO_SHADER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRAGLASS_PROJECT_CPU_ISO_SHADER_INL_H_
#undef TETRAGLASS_PROJECT_CPU_ISO_SHADER_INL_H_
#else
#define TETRAGLASS_PROJECT_CPU_ISO_SHADER_INL_H_
#endif

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include <hwy/highway.h>

#include "project/cpu/lighting-inl.h"
#include "project/cpu/ordered_shader-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tetraglass::project::cpu::HWY_NAMESPACE {

/// Where the rays of a block cross an isosurface (weiler2002 section 5.2).
struct Crossing {
  Lanes crossed;
  Float depth;  ///< as BlockSegments::near
};

HWY_INLINE Crossing crossing(const Surface& surface, Lanes covered, const BlockSegments& s) {
  // Half open, as preint::crosses: of two segments with a common end exactly one is crossed.
  const Lanes front_below = hn::Lt(s.front, set(surface.threshold));
  const Lanes back_below = hn::Lt(s.back, set(surface.threshold));
  const Lanes crossed = hn::And(covered, hn::Xor(front_below, back_below));
  const Float span = hn::IfThenElse(crossed, hn::Sub(s.back, s.front), set(1));
  const Float t = hn::Div(hn::Sub(set(surface.value), s.front), span);
  return {crossed, hn::MulAdd(hn::Min(hn::Max(t, set(0)), set(1)), hn::Sub(s.far, s.near), s.near)};
}

/// The colors of isosurfaces, lit where the picture has light.
class SurfaceColors {
 public:
  SurfaceColors(const Picture& picture, int x, int y) {
    if (picture.lighting != nullptr) lighting_.emplace(picture, x, y);
  }

  HWY_INLINE void begin(std::uint32_t cell) {
    cell_ = cell;
    is_lighting_set_ = false;
  }

  /// In the cell in work, whose light is set up once a surface is met there.
  HWY_INLINE Vector3 at(const Surface& surface, std::size_t block, Float depth) {
    const Vector3 color = {set(surface.color[0]), set(surface.color[1]), set(surface.color[2])};
    if (!lighting_) return color;
    if (!is_lighting_set_) lighting_->begin(cell_);
    is_lighting_set_ = true;
    const preint::Material& m = surface.material;
    const MaterialLanes material = {
        set(static_cast<float>(m.ambient)), set(static_cast<float>(m.diffuse)),
        set(static_cast<float>(m.specular)), set(static_cast<float>(m.shininess))};
    const CellLighting::Rays rays = lighting_->rays(block);
    const Vector3 gradient = lighting_->gradient(rays, depth);
    return lighting_->shade(lighting_->illuminate(rays, depth, gradient, material.shininess), color,
                            material);
  }

 private:
  std::optional<CellLighting> lighting_;
  std::uint32_t cell_ = 0;
  bool is_lighting_set_ = false;
};

/// Translucent surfaces: their crossings go to the delay line of their block.
class IsoShader {
 public:
  static constexpr bool kValues = true;
  static constexpr bool kKeys = true;

  IsoShader(const Picture& picture, int x, int y, OrderedBlocks& blocks)
      : surfaces_(picture.surfaces), colors_(picture, x, y), blocks_(blocks) {}

  HWY_INLINE void prefetch(std::uint32_t) const {}
  HWY_INLINE bool begin(std::uint32_t cell) {
    blocks_.begin(cell);
    colors_.begin(cell);
    return true;
  }
  [[nodiscard]] HWY_INLINE bool wants(std::size_t block) const { return blocks_.wants(block); }

  HWY_INLINE void add(std::size_t block, Lanes covered, const BlockSegments& s) {
    if (!blocks_.in_order()) {
      for (const Surface& surface : surfaces_) meet(surface, block, covered, s);
      return;
    }
    // The nearest first: of rising fields the lowest surface, of falling ones the highest.
    const Lanes rising = hn::And(covered, hn::Lt(s.front, s.back));
    const Lanes falling = hn::AndNot(rising, covered);
    for (const Surface& surface : surfaces_) meet(surface, block, rising, s);
    for (std::size_t i = surfaces_.size(); i-- > 0;) meet(surfaces_[i], block, falling, s);
  }

 private:
  HWY_INLINE void meet(const Surface& surface, std::size_t block, Lanes covered,
                       const BlockSegments& s) {
    const Crossing met = crossing(surface, covered, s);
    if (hn::AllFalse(FloatTag(), met.crossed)) return;
    const Vector3 color = colors_.at(surface, block, met.depth);
    const Float opacity = hn::IfThenElseZero(met.crossed, set(surface.opacity));
    Fragment f;
    f.channel[0] = hn::Add(met.depth, met.depth);
    for (std::size_t c = 0; c < 3; ++c) f.channel[1 + c] = hn::Mul(opacity, color[c]);
    f.channel[4] = opacity;
    blocks_.insert(block, met.crossed, f);
  }

  std::span<const Surface> surfaces_;
  SurfaceColors colors_;
  OrderedBlocks& blocks_;
};

/// Opaque surfaces: of each ray the nearest crossing, in any order of the cells.
class NearestSurfaceShader {
 public:
  static constexpr bool kValues = true;
  static constexpr bool kKeys = true;

  NearestSurfaceShader(const Picture& picture, int x, int y, float* nearest)
      : surfaces_(picture.surfaces), colors_(picture, x, y), nearest_(nearest, kNone) {}

  HWY_INLINE void prefetch(std::uint32_t) const {}
  HWY_INLINE bool begin(std::uint32_t cell) {
    colors_.begin(cell);
    return true;
  }
  [[nodiscard]] HWY_INLINE bool wants(std::size_t) const { return true; }

  HWY_INLINE void add(std::size_t block, Lanes covered, const BlockSegments& s) {
    const FloatTag d;
    for (const Surface& surface : surfaces_) {
      const Crossing met = crossing(surface, covered, s);
      if (hn::AllFalse(d, met.crossed)) continue;
      float* nearest = nearest_.at(block, 0);
      const Float before = hn::Load(d, nearest);
      const Lanes nearer = hn::And(met.crossed, hn::Lt(met.depth, before));
      if (hn::AllFalse(d, nearer)) continue;
      hn::Store(hn::IfThenElse(nearer, met.depth, before), d, nearest);
      const Vector3 color = colors_.at(surface, block, met.depth);
      for (std::size_t c = 0; c < 3; ++c) {
        hn::BlendedStore(color[c], nearer, d, nearest_.at(block, 1 + c));
      }
    }
  }

  [[nodiscard]] std::array<float, 4> pixel(std::size_t i) const {
    if (nearest_.pixel(i, 0) == kNone) return {};
    return {nearest_.pixel(i, 1), nearest_.pixel(i, 2), nearest_.pixel(i, 3), 1};
  }

 private:
  static constexpr float kNone = std::numeric_limits<float>::max();
  std::span<const Surface> surfaces_;
  SurfaceColors colors_;
  BlockSums<4> nearest_;  // depth, red, green, blue
};

}  // namespace tetraglass::project::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
