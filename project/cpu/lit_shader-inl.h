// A lit medium, front to back. Compiled for each instruction set: included only by tile_kernel.cpp,
// after highway.h.

#if defined(TETRAGLASS_PROJECT_CPU_LIT_SHADER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRAGLASS_PROJECT_CPU_LIT_SHADER_INL_H_
#undef TETRAGLASS_PROJECT_CPU_LIT_SHADER_INL_H_
#else
#define TETRAGLASS_PROJECT_CPU_LIT_SHADER_INL_H_
#endif

#include <array>
#include <cstdint>

#include <hwy/highway.h>

#include "project/cpu/lighting-inl.h"
#include "project/cpu/ordered_shader-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tetraglass::project::cpu::HWY_NAMESPACE {

/// What all ways to light a medium have in common.
class LitMediumShader : public MediumShader {
 public:
  LitMediumShader(const Picture& picture, int x, int y, OrderedBlocks& blocks)
      : MediumShader(picture),
        lighting_(picture, x, y),
        data_(*picture.lighting),
        blocks_(blocks) {}

  HWY_INLINE bool begin(std::uint32_t cell) {
    blocks_.begin(cell);
    lighting_.begin(cell);
    return MediumShader::begin(cell);
  }
  [[nodiscard]] HWY_INLINE bool wants(std::size_t block) const { return blocks_.wants(block); }

 protected:
  /// Calls visit(const MediumInterval&, const IntervalPart&, in_front) for the parts of the
  /// segments; `in_front`: the lanes in which the part lies before the ones visited so far.
  template <class Visit>
  HWY_INLINE void walk(const BlockSegments& s, Lanes covered, const Visit& visit) const {
    const FloatTag d;
    // In a cell seen in perspective the field may rise along one ray and fall along another.
    const Lanes falling = hn::And(covered, hn::Lt(s.back, s.front));
    const bool descend =
        !hn::AllFalse(d, falling) && hn::AllTrue(d, hn::Or(falling, hn::Not(covered)));
    const Lanes in_front = descend ? hn::Lt(set(1), set(0)) : falling;
    walk_intervals(medium_, range_, descend, s, length(s, covered),
                   [&](const MediumInterval& interval, const IntervalPart& part)
                       HWY_ATTR { visit(interval, part, in_front); });
  }

  /// At a position of an interval.
  [[nodiscard]] HWY_INLINE MaterialLanes material(const MediumInterval& interval,
                                                  Float position) const {
    const MaterialInterval& m =
        data_.materials[static_cast<std::size_t>(&interval - medium_.intervals().data())];
    const auto at = [&](std::size_t k)
                        HWY_ATTR { return hn::MulAdd(set(m.rise[k]), position, set(m.low[k])); };
    return {at(0), at(1), at(2), at(3)};
  }

  /// Sums of what parts of a segment add to the eye's light, associated, and their opacity.
  template <std::size_t kChannels>
  struct Sums {
    std::array<Float, kChannels> of;
    Float opacity = set(0);

    Sums() {
      for (Float& channel : of) channel = set(0);
    }
    HWY_INLINE void add(const std::array<Float, kChannels>& part, Float part_opacity,
                        Lanes in_front) {
      const Float of_part = hn::IfThenElse(in_front, set(1), hn::Sub(set(1), opacity));
      const Float of_sum = hn::IfThenElse(in_front, hn::Sub(set(1), part_opacity), set(1));
      for (std::size_t c = 0; c < kChannels; ++c) {
        of[c] = hn::MulAdd(of_part, part[c], hn::Mul(of_sum, of[c]));
      }
      opacity = hn::MulAdd(of_part, part_opacity, hn::Mul(of_sum, opacity));
    }
  };

  static HWY_INLINE SegmentLight<Float> light_of(const MediumInterval& interval,
                                                 const IntervalPart& part) {
    return segment_light(FloatTag(), hn::Mul(part.length, extinction(interval, part.front)),
                         hn::Mul(part.length, extinction(interval, part.back)));
  }

  /// The light of a part from what is linear along it, by its values at both ends.
  template <std::size_t kChannels>
  static HWY_INLINE std::array<Float, kChannels> gather(const SegmentLight<Float>& light,
                                                        const std::array<Float, kChannels>& front,
                                                        const std::array<Float, kChannels>& back) {
    const Float of_front = hn::Mul(set(0.5F), hn::Sub(light.opacity, light.skew));
    const Float of_back = hn::Mul(set(0.5F), hn::Add(light.opacity, light.skew));
    std::array<Float, kChannels> result;
    for (std::size_t c = 0; c < kChannels; ++c) {
      result[c] = hn::MulAdd(of_front, front[c], hn::Mul(of_back, back[c]));
    }
    return result;
  }

  /// Adds a part under the light at its front and at its back; the lit color is linear in between.
  HWY_INLINE void add_part(const MediumInterval& interval, const IntervalPart& part,
                           const IlluminationLanes& front, const IlluminationLanes& back,
                           Lanes in_front, Sums<3>& sums) const {
    const auto lit = [&](const IlluminationLanes& light, Float position) HWY_ATTR {
      const Vector3 unlit = {color(interval, 0, position), color(interval, 1, position),
                             color(interval, 2, position)};
      return lighting_.shade(light, unlit, material(interval, position));
    };
    const SegmentLight<Float> light = light_of(interval, part);
    sums.add(gather(light, lit(front, part.front), lit(back, part.back)), light.opacity, in_front);
  }

  /// Of the material at scaled values of the cell in work.
  [[nodiscard]] HWY_INLINE Float shininess(Float value) const {
    Float result = set(0);
    for (std::uint32_t k = range_.first; k <= range_.last; ++k) {
      const MediumInterval& interval = medium_.intervals()[k];
      const Float at = material(interval, position(interval, value)).shininess;
      const Lanes here = hn::Le(set(interval.low), value);
      result = k == range_.first ? at : hn::IfThenElse(here, at, result);
    }
    return result;
  }

  HWY_INLINE void insert(std::size_t block, Lanes covered, const BlockSegments& s,
                         const Vector3& color, Float opacity) {
    Fragment f;
    f.channel = {hn::Add(s.near, s.far), color[0], color[1], color[2], opacity};
    blocks_.insert(block, covered, f);
  }

  CellLighting lighting_;
  const Lighting& data_;

 private:
  OrderedBlocks& blocks_;
};

/// Light along a segment by what it is at both ends and, of three nodes, in the middle.
template <std::size_t kNodes>
class LightAlongSegment {
 public:
  /// `light(t)`: an IlluminationLanes.
  template <class F>
  HWY_INLINE void find(const F& light) {
    for (std::size_t i = 0; i < kNodes; ++i) {
      nodes_[i] = light(set(static_cast<float>(i) / static_cast<float>(kNodes - 1)));
    }
  }

  /// Linear through two nodes, quadratic through three.
  [[nodiscard]] HWY_INLINE IlluminationLanes at(Float t) const {
    if constexpr (kNodes == 2) return mix(nodes_[0], nodes_[1], t);
    const Float s = hn::Sub(set(1), t);
    const Float first = hn::Mul(s, hn::Sub(s, t));  // (1 - t) (1 - 2 t)
    const Float last = hn::Mul(t, hn::Sub(t, s));   // t (2 t - 1)
    const Float middle = hn::Mul(set(4), hn::Mul(s, t));
    const auto channel = [&](Float a, Float b, Float c) HWY_ATTR {
      const Float sum = hn::MulAdd(first, a, hn::MulAdd(middle, b, hn::Mul(last, c)));
      return hn::Max(sum, set(0));  // the parabola may dip below what all three have
    };
    const IlluminationLanes& a = nodes_[0];
    const IlluminationLanes& b = nodes_[kNodes / 2];
    const IlluminationLanes& c = nodes_[kNodes - 1];
    IlluminationLanes result;
    for (std::size_t k = 0; k < 3; ++k) {
      result.diffuse[k] = channel(a.diffuse[k], b.diffuse[k], c.diffuse[k]);
      result.specular[k] = channel(a.specular[k], b.specular[k], c.specular[k]);
    }
    result.unlit = channel(a.unlit, b.unlit, c.unlit);
    return result;
  }

 private:
  std::array<IlluminationLanes, kNodes> nodes_;
};

/// Lights each linear part of the medium on its own: short ones, of shells, by the normal in their
/// middle; the others by the light along their segment.
class SmoothShader : public LitMediumShader {
 public:
  using LitMediumShader::LitMediumShader;

  HWY_INLINE void add(std::size_t block, Lanes covered, const BlockSegments& segments) {
    const BlockSegments s = with_cell_value(segments);
    const CellLighting::Rays rays = lighting_.rays(block);
    const Vector3 front = lighting_.gradient(rays, s.near);
    const Vector3 back = lighting_.gradient(rays, s.far);
    const auto light_at = [&](Float t) HWY_ATTR {
      return lighting_.illuminate(rays, mix(s.near, s.far, t), mix(front, back, t),
                                  shininess(mix(s.front, s.back, t)));
    };
    LightAlongSegment<3> lights;
    bool are_lights_found = false;
    Sums<3> sums;
    walk(s, covered,
         [&](const MediumInterval& interval, const IntervalPart& part, Lanes in_front) HWY_ATTR {
           const Lanes seen = hn::And(covered, hn::Lt(set(0), part.length));
           const Float share = hn::IfThenElseZero(seen, hn::Sub(part.end, part.start));
           if (hn::AllTrue(FloatTag(), hn::Lt(share, set(kShort)))) {
             const Float middle = mix(part.start, part.end, set(0.5F));
             const IlluminationLanes light = light_at(middle);
             add_part(interval, part, light, light, in_front, sums);
             return;
           }
           if (!are_lights_found) lights.find(light_at);
           are_lights_found = true;
           // By halves: what is linear in between is the lit color.
           const auto light_of_part = [&](float t) HWY_ATTR {
             return lights.at(mix(part.start, part.end, set(t)));
           };
           const IlluminationLanes middle = light_of_part(0.5F);
           const Lanes behind = hn::Lt(set(1), set(0));
           Sums<3> halves;
           add_part(interval, share_of(part, 0, 0.5F), light_of_part(0), middle, behind, halves);
           add_part(interval, share_of(part, 0.5F, 1), middle, light_of_part(1), behind, halves);
           sums.add(halves.of, halves.opacity, in_front);
         });
    insert(block, covered, s, sums.of, sums.opacity);
  }

 private:
  /// Of the segment: the light at three places of a segment does for longer parts.
  static constexpr float kShort = 0.25F;

  /// From one place of a part to another.
  static HWY_INLINE IntervalPart share_of(const IntervalPart& part, float from, float to) {
    return {mix(part.front, part.back, set(from)), mix(part.front, part.back, set(to)),
            hn::Mul(part.length, set(to - from)), mix(part.start, part.end, set(from)),
            mix(part.start, part.end, set(to))};
  }
};

/// Light found at the ends of each segment and linear in between (lum2004, "Interpolated
/// Pre-Integrated Lighting").
class InterpolatedShader : public LitMediumShader {
 public:
  using LitMediumShader::LitMediumShader;

  HWY_INLINE void add(std::size_t block, Lanes covered, const BlockSegments& segments) {
    const BlockSegments s = with_cell_value(segments);
    const CellLighting::Rays rays = lighting_.rays(block);
    const Vector3 front = lighting_.gradient(rays, s.near);
    const Vector3 back = lighting_.gradient(rays, s.far);
    LightAlongSegment<2> lights;
    lights.find([&](Float t) HWY_ATTR {
      return lighting_.illuminate(rays, mix(s.near, s.far, t), mix(front, back, t),
                                  shininess(mix(s.front, s.back, t)));
    });
    Sums<3> sums;
    walk(s, covered,
         [&](const MediumInterval& interval, const IntervalPart& part, Lanes in_front) HWY_ATTR {
           add_part(interval, part, lights.at(part.start), lights.at(part.end), in_front, sums);
         });
    insert(block, covered, s, sums.of, sums.opacity);
  }
};

/// One normal for all of a segment, at the middle (single), where most of its light comes from
/// (weighted), or where the field has the value of largest extinction (surface). The material is
/// averaged with the light (meissner2002 section 4).
template <Shading kShading>
class LitOnceShader : public LitMediumShader {
 public:
  using LitMediumShader::LitMediumShader;

  HWY_INLINE void add(std::size_t block, Lanes covered, const BlockSegments& segments) {
    const BlockSegments s = with_cell_value(segments);
    Sums<kTerms> sums;
    walk(s, covered,
         [&](const MediumInterval& interval, const IntervalPart& part, Lanes in_front) HWY_ATTR {
           const SegmentLight<Float> light = light_of(interval, part);
           sums.add(gather(light, terms(interval, part.front, part.start),
                           terms(interval, part.back, part.end)),
                    light.opacity, in_front);
         });
    const Lanes seen = hn::Lt(set(1e-20F), sums.opacity);
    const Float inverse = hn::Div(set(1), hn::IfThenElse(seen, sums.opacity, set(1)));
    const Float t = place_of_normal(s, sums, seen, inverse);
    const CellLighting::Rays rays = lighting_.rays(block);
    const Vector3 gradient =
        mix(lighting_.gradient(rays, s.near), lighting_.gradient(rays, s.far), t);
    const IlluminationLanes light = lighting_.illuminate(rays, mix(s.near, s.far, t), gradient,
                                                         hn::Mul(sums.of[kShininess], inverse));
    Vector3 color;
    for (std::size_t c = 0; c < 3; ++c) {
      const Float factor = hn::Mul(hn::Sub(set(1), light.unlit), set(data_.ambient[c]));
      color[c] = hn::Mul(light.unlit, sums.of[c]);
      color[c] = hn::MulAdd(factor, sums.of[kAmbient + c], color[c]);
      color[c] = hn::MulAdd(light.diffuse[c], sums.of[kDiffuse + c], color[c]);
      color[c] = hn::MulAdd(light.specular[c], sums.of[kSpecular], color[c]);
    }
    insert(block, covered, s, color, sums.opacity);
  }

 private:
  // What is summed: the color, the color times the ambient and times the diffuse coefficient, the
  // specular coefficient, the shininess, and the place on the segment.
  static constexpr std::size_t kAmbient = 3;
  static constexpr std::size_t kDiffuse = 6;
  static constexpr std::size_t kSpecular = 9;
  static constexpr std::size_t kShininess = 10;
  static constexpr std::size_t kPlace = 11;
  static constexpr std::size_t kTerms = 12;

  [[nodiscard]] HWY_INLINE std::array<Float, kTerms> terms(const MediumInterval& interval,
                                                           Float position, Float t) const {
    const MaterialLanes m = material(interval, position);
    std::array<Float, kTerms> result;
    for (std::size_t c = 0; c < 3; ++c) {
      result[c] = color(interval, c, position);
      result[kAmbient + c] = hn::Mul(m.ambient, result[c]);
      result[kDiffuse + c] = hn::Mul(m.diffuse, result[c]);
    }
    result[kSpecular] = m.specular;
    result[kShininess] = m.shininess;
    result[kPlace] = t;
    return result;
  }

  [[nodiscard]] HWY_INLINE Float place_of_normal(const BlockSegments& s, const Sums<kTerms>& sums,
                                                 Lanes seen, Float inverse) const {
    if constexpr (kShading == Shading::single) return set(0.5F);
    if constexpr (kShading == Shading::weighted) {
      return hn::IfThenElse(seen, hn::Min(hn::Mul(sums.of[kPlace], inverse), set(1)), set(0.5F));
    }
    const Float difference = hn::Sub(s.back, s.front);
    const Lanes flat = hn::Lt(hn::Abs(difference), set(kLeastDifference));
    const Float t = hn::Div(hn::Sub(set(data_.surface_value), s.front),
                            hn::IfThenElse(flat, set(1), difference));
    return hn::IfThenElse(flat, set(0.5F), hn::Min(hn::Max(t, set(0)), set(1)));
  }
};

}  // namespace tetraglass::project::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
