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
#include <cmath>
#include <cstdint>
#include <limits>

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "project/cpu/block_sums-inl.h"
#include "project/cpu/interval_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tetraglass::project::cpu::HWY_NAMESPACE {

/// The length of the ray inside the mesh (weiler2002 Fig. 7).
class ThicknessShader {
 public:
  static constexpr bool kValues = false;
  static constexpr bool kKeys = false;

  ThicknessShader(const Picture& picture, int, int, float* sums)
      : unit_(static_cast<float>(picture.projection->radius)), sums_(sums, 0) {}

  HWY_INLINE void prefetch(std::uint32_t) const {}
  HWY_INLINE bool begin(std::uint32_t) { return true; }
  [[nodiscard]] HWY_INLINE bool wants(std::size_t) const { return true; }

  HWY_INLINE void add(std::size_t block, Lanes covered, const BlockSegments& s) {
    sums_.add(block, 0, hn::IfThenElseZero(covered, s.length));
  }

  [[nodiscard]] std::array<float, 4> pixel(std::size_t i) const {
    const float length = sums_.pixel(i, 0) * unit_;
    return {length, length, length, length > 0 ? 1.0F : 0.0F};
  }

 private:
  float unit_;
  BlockSums<1> sums_;
};

/// What shaders of a medium have in common: the cell in work, and its intervals.
class MediumShader {
 public:
  static constexpr bool kValues = true;
  static constexpr bool kKeys = true;

  explicit MediumShader(const Picture& picture)
      : cells_(*picture.cells),
        medium_(*picture.medium),
        ranges_(picture.intervals.data()),
        of_cells_(!cells_.cell_values.empty()) {}

  HWY_INLINE void prefetch(std::uint32_t cell) const { hwy::Prefetch(ranges_ + cell); }
  HWY_INLINE bool begin(std::uint32_t cell) {
    cell_ = cell;
    range_ = ranges_[cell];
    return true;
  }
  [[nodiscard]] HWY_INLINE bool wants(std::size_t) const { return true; }

 protected:
  HWY_INLINE BlockSegments with_cell_value(const BlockSegments& s) const {
    BlockSegments result = s;
    if (of_cells_) take_cell_value(cells_, cell_, result);
    return result;
  }

  /// The length of the segments, as the medium has it: 0 in lanes that are not covered.
  [[nodiscard]] HWY_INLINE Float length(const BlockSegments& s, Lanes covered) const {
    const Float length = hn::IfThenElseZero(covered, s.length);
    return cells_.densities.empty() ? length : hn::Mul(length, set(cells_.densities[cell_]));
  }

  const DrawnCells& cells_;
  const Medium& medium_;
  const IntervalRange* ranges_;
  bool of_cells_;
  std::uint32_t cell_ = 0;
  IntervalRange range_;
};

/// int kappa c dl.
class EmissionShader : public MediumShader {
 public:
  EmissionShader(const Picture& picture, int, int, float* sums)
      : MediumShader(picture), sums_(sums, 0) {}

  HWY_INLINE void add(std::size_t block, Lanes covered, const BlockSegments& segments) {
    const BlockSegments s = with_cell_value(segments);
    Float sum[3] = {set(0), set(0), set(0)};
    walk_intervals(medium_, range_, false, s, length(s, covered),
                   [&](const MediumInterval& interval, const IntervalPart& part)
                       HWY_ATTR { add_part(interval, part, sum); });
    for (std::size_t c = 0; c < 3; ++c) sums_.add(block, c, sum[c]);
  }

  [[nodiscard]] std::array<float, 4> pixel(std::size_t i) const {
    return {sums_.pixel(i, 0), sums_.pixel(i, 1), sums_.pixel(i, 2), 0};
  }

 private:
  /// The mean of a product of two linear functions is the product of the values in the middle and
  /// the twelfth part of the product of the rises.
  static HWY_INLINE void add_part(const MediumInterval& interval, const IntervalPart& part,
                                  Float* sum) {
    const Float middle = hn::Mul(set(0.5F), hn::Add(part.front, part.back));
    const Float rise = hn::Sub(part.back, part.front);
    const Float light = hn::Mul(part.length, extinction(interval, middle));
    const Float bend = hn::Mul(hn::Mul(part.length, hn::Mul(rise, rise)),
                               set(interval.extinction_rise * (1.0F / 12)));
    for (std::size_t c = 0; c < 3; ++c) {
      sum[c] = hn::MulAdd(light, color(interval, c, middle), sum[c]);
      sum[c] = hn::MulAdd(bend, set(interval.color_rise[c]), sum[c]);
    }
  }

  BlockSums<3> sums_;
};

/// int kappa dl.
class AbsorptionShader : public MediumShader {
 public:
  AbsorptionShader(const Picture& picture, int, int, float* sums)
      : MediumShader(picture), sums_(sums, 0) {}

  HWY_INLINE void add(std::size_t block, Lanes covered, const BlockSegments& segments) {
    const BlockSegments s = with_cell_value(segments);
    Float depth = set(0);
    walk_intervals(medium_, range_, false, s, length(s, covered),
                   [&](const MediumInterval& interval, const IntervalPart& part) HWY_ATTR {
                     const Float middle = hn::Mul(set(0.5F), hn::Add(part.front, part.back));
                     depth = hn::MulAdd(part.length, extinction(interval, middle), depth);
                   });
    sums_.add(block, 0, depth);
  }

  [[nodiscard]] std::array<float, 4> pixel(std::size_t i) const { return {0, 0, 0, opacity(i)}; }

 protected:
  [[nodiscard]] float opacity(std::size_t i) const { return -std::expm1(-sums_.pixel(i, 0)); }

 private:
  BlockSums<1> sums_;
};

/// int kappa c exp(-tau) dl where c is one color: what is absorbed, in that color.
class SingleColorShader : public AbsorptionShader {
 public:
  SingleColorShader(const Picture& picture, int x, int y, float* sums)
      : AbsorptionShader(picture, x, y, sums), color_(*picture.single_color) {}

  [[nodiscard]] std::array<float, 4> pixel(std::size_t i) const {
    const float a = opacity(i);
    return {a * color_[0], a * color_[1], a * color_[2], a};
  }

 private:
  std::array<float, 3> color_;
};

/// The color of the largest value. Where all rays of a block have met as much as a cell holds, the
/// cell is passed over: cells that hold the most come first (see CellProjector).
class FieldMaximumShader : public MediumShader {
 public:
  FieldMaximumShader(const Picture& picture, int, int, float* largest)
      : MediumShader(picture), points_(picture.points->exact.data()), largest_(largest, kNone) {}

  HWY_INLINE void prefetch(std::uint32_t) const {}
  HWY_INLINE bool begin(std::uint32_t cell) {
    cell_ = cell;
    float most = kNone;
    if (of_cells_) {
      most = cells_.cell_values[cell];
    } else {
      for (const std::uint32_t v : cells_.cells[cell].vertices) {
        most = std::max(most, static_cast<float>(points_[v].value));
      }
    }
    most_ = set(most);
    return true;
  }
  [[nodiscard]] HWY_INLINE bool wants(std::size_t block) const {
    const Float before = hn::Load(FloatTag(), largest_.at(block, 0));
    return !hn::AllTrue(FloatTag(), hn::Le(most_, before));
  }

  HWY_INLINE void add(std::size_t block, Lanes covered, const BlockSegments& segments) {
    const BlockSegments s = with_cell_value(segments);
    largest_.raise(block, 0, hn::IfThenElse(covered, hn::Max(s.front, s.back), set(kNone)));
  }

  [[nodiscard]] std::array<float, 4> pixel(std::size_t i) const {
    const float largest = largest_.pixel(i, 0);
    if (largest == kNone) return {};
    const std::array<float, 3> rgb = medium_.color(largest);
    return {rgb[0], rgb[1], rgb[2], 1};
  }

 private:
  static constexpr float kNone = -16;  // below every scaled value
  const ViewPoint* points_;
  BlockSums<1> largest_;
  Float most_ = set(kNone);  // in the cell in work
};

/// The largest color of each channel (weiler2002 section 5.1): at one end of a segment's part in an
/// interval.
class ColorMaximumShader : public MediumShader {
 public:
  ColorMaximumShader(const Picture& picture, int, int, float* largest)
      : MediumShader(picture), largest_(largest, kNone) {}

  HWY_INLINE void add(std::size_t block, Lanes covered, const BlockSegments& segments) {
    const BlockSegments s = with_cell_value(segments);
    const Float low = hn::Min(s.front, s.back);
    const Float high = hn::Max(s.front, s.back);
    Float most[3] = {set(kNone), set(kNone), set(kNone)};
    for (std::uint32_t k = range_.first; k <= range_.last; ++k) {
      const MediumInterval& interval = medium_.intervals()[k];
      const Float from = position(interval, hn::Max(low, set(interval.low)));
      const Float to = position(interval, hn::Min(high, set(interval.high)));
      const Lanes meets = hn::And(covered, hn::Le(from, to));
      for (std::size_t c = 0; c < 3; ++c) {
        const Float channel = hn::Max(color(interval, c, from), color(interval, c, to));
        most[c] = hn::Max(most[c], hn::IfThenElse(meets, channel, set(kNone)));
      }
    }
    for (std::size_t c = 0; c < 3; ++c) largest_.raise(block, c, most[c]);
  }

  [[nodiscard]] std::array<float, 4> pixel(std::size_t i) const {
    if (largest_.pixel(i, 0) == kNone) return {};
    // As in the reference, whose maximum starts from black.
    const auto channel = [&](std::size_t c) { return std::max(0.0F, largest_.pixel(i, c)); };
    return {channel(0), channel(1), channel(2), 1};
  }

 private:
  static constexpr float kNone = std::numeric_limits<float>::lowest();
  BlockSums<3> largest_;
};

}  // namespace tetraglass::project::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
