// What becomes of the segments of a tile where light is taken on the way: front to back. Compiled
// for each instruction set: included only by tile_kernel.cpp, after highway.h.

#if defined(TETRAGLASS_PROJECT_CPU_ORDERED_SHADER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRAGLASS_PROJECT_CPU_ORDERED_SHADER_INL_H_
#undef TETRAGLASS_PROJECT_CPU_ORDERED_SHADER_INL_H_
#else
#define TETRAGLASS_PROJECT_CPU_ORDERED_SHADER_INL_H_
#endif

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>

#include <hwy/highway.h>

#include "project/cpu/fragment_lines-inl.h"
#include "project/cpu/light-inl.h"
#include "project/cpu/table_shaders-inl.h"
#include "project/cpu/tile_shaders-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tetraglass::project::cpu::HWY_NAMESPACE {

/// Blocks that take no part in a pass.
inline constexpr std::uint16_t kNoLine = 0xffff;

/// The delay lines of a tile's blocks, and which cells still matter to them.
class OrderedBlocks {
 public:
  /// `lines_of_blocks`: the delay line of each block of the tile or kNoLine.
  OrderedBlocks(const Picture& picture, FragmentLines& lines,
                std::span<const std::uint16_t> lines_of_blocks)
      : cells_(picture.cells->cells.data()),
        points_(picture.points->exact.data()),
        projection_(*picture.projection),
        lines_(lines),
        lines_of_blocks_(lines_of_blocks) {}

  HWY_INLINE void begin(std::uint32_t cell) { cell_ = cell; }

  /// Behind an opaque block only what comes too late matters: it has to be told.
  [[nodiscard]] HWY_INLINE bool wants(std::size_t block) const {
    const std::uint16_t line = lines_of_blocks_[block];
    if (line == kNoLine) return false;
    const FragmentLines::Line& state = lines_.line(line);
    return HWY_LIKELY(!state.opaque) || least_key() < state.opaque_key;
  }

  /// Fragments have to come in order.
  [[nodiscard]] HWY_INLINE bool in_order() const { return lines_.in_order(); }

  HWY_INLINE void insert(std::size_t block, Lanes covered, const Fragment& fragment) {
    lines_.insert(lines_of_blocks_[block], block, covered, fragment);
  }

 private:
  /// No fragment of the cell in work has a key below this.
  [[nodiscard]] float least_key() const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::uint32_t v : cells_[cell_].vertices) nearest = std::min(nearest, points_[v].z);
    return static_cast<float>(projection_.perspective ? 2 * (nearest / projection_.middle_depth - 1)
                                                      : 2 * nearest);
  }

  const DrawnCell* cells_;
  const ViewPoint* points_;
  const Projection& projection_;
  FragmentLines& lines_;
  std::span<const std::uint16_t> lines_of_blocks_;
  std::uint32_t cell_ = 0;  // in work
};

/// Pieces with linear extinction and color, integrated in closed form.
class ExactPieces {
 public:
  explicit ExactPieces(const Picture&) {}

  [[nodiscard]] HWY_INLINE SegmentLight<Float> light(Float a, Float b) const {
    return segment_light(FloatTag(), a, b);
  }
};

/// ... by the table of their mean transmittances (preint/psi_table.h).
class PsiPieces {
 public:
  explicit PsiPieces(const Picture& picture) : lookup_(*picture.table) {}

  [[nodiscard]] HWY_INLINE SegmentLight<Float> light(Float a, Float b) const {
    const FloatTag d;
    const auto coordinate = [&](Float k) HWY_ATTR { return hn::Div(k, hn::Add(k, set(1))); };
    const Float opacity = preint::HWY_NAMESPACE::absorbed(d, hn::Mul(set(0.5F), hn::Add(a, b)));
    const Float transmittance = hn::Sub(set(1), opacity);
    // The mean lies between the ends, however the table was rounded.
    const Float psi =
        hn::Min(hn::Max(lookup_.at(coordinate(a), coordinate(b), 0), transmittance), set(1));
    // color_front (1 - psi) + color_back (psi - transmittance)
    return {opacity, hn::Sub(hn::Add(psi, psi), hn::Add(set(1), transmittance)), transmittance};
  }

 private:
  TableLookup lookup_;
};

/// int kappa c exp(-tau) dl: the segments of each cell, shaded, go to the delay line of their
/// block.
template <class Pieces>
class FullShader : public MediumShader {
 public:
  FullShader(const Picture& picture, int, int, OrderedBlocks& blocks)
      : MediumShader(picture), pieces_(picture), blocks_(blocks) {}

  HWY_INLINE bool begin(std::uint32_t cell) {
    blocks_.begin(cell);
    return MediumShader::begin(cell);
  }
  [[nodiscard]] HWY_INLINE bool wants(std::size_t block) const { return blocks_.wants(block); }

  HWY_INLINE void add(std::size_t block, Lanes covered, const BlockSegments& segments) {
    const BlockSegments s = with_cell_value(segments);
    Fragment f;
    f.channel = {hn::Add(s.near, s.far), set(0), set(0), set(0), set(0)};
    // In a cell seen in perspective the field may rise along one ray and fall along another.
    const Lanes falling = hn::And(covered, hn::Lt(s.back, s.front));
    const bool descend = !hn::AllFalse(FloatTag(), falling);
    if (HWY_LIKELY(!descend || range_.first == range_.last ||
                   hn::AllTrue(FloatTag(), hn::Or(falling, hn::Not(covered))))) {
      walk_intervals(medium_, range_, descend, s, length(s, covered),
                     [&](const MediumInterval& interval, const IntervalPart& part)
                         HWY_ATTR { add_behind(shade(interval, part), f); });
    } else {
      walk_intervals(medium_, range_, false, s, length(s, covered),
                     [&](const MediumInterval& interval, const IntervalPart& part)
                         HWY_ATTR { add_beside(shade(interval, part), falling, f); });
    }
    blocks_.insert(block, covered, f);
  }

 private:
  /// Light of one part, and its opacity.
  struct Shaded {
    Float color[3];
    Float opacity;
  };

  HWY_INLINE Shaded shade(const MediumInterval& interval, const IntervalPart& part) const {
    const Float a = hn::Mul(part.length, extinction(interval, part.front));
    const Float b = hn::Mul(part.length, extinction(interval, part.back));
    const SegmentLight<Float> light = pieces_.light(a, b);
    // The color at both ends is that of the interval's low end and a part of the rise.
    const Float middle = hn::Mul(set(0.5F), hn::Add(part.front, part.back));
    const Float half_crossed = hn::Mul(set(0.5F), hn::Sub(part.back, part.front));
    const Float rise = hn::MulAdd(light.opacity, middle, hn::Mul(light.skew, half_crossed));
    Shaded result;
    result.opacity = light.opacity;
    for (std::size_t c = 0; c < 3; ++c) {
      result.color[c] = hn::MulAdd(set(interval.color_rise[c]), rise,
                                   hn::Mul(set(interval.color[c]), result.opacity));
    }
    return result;
  }

  static HWY_INLINE void add_behind(const Shaded& part, Fragment& f) {
    const Float left = hn::Sub(set(1), f.channel[4]);
    for (std::size_t c = 0; c < 3; ++c) {
      f.channel[1 + c] = hn::MulAdd(left, part.color[c], f.channel[1 + c]);
    }
    f.channel[4] = hn::MulAdd(left, part.opacity, f.channel[4]);
  }

  /// Behind, or in front in the lanes of `in_front`.
  static HWY_INLINE void add_beside(const Shaded& part, Lanes in_front, Fragment& f) {
    const Float through_sum = hn::Sub(set(1), f.channel[4]);
    const Float through_part = hn::Sub(set(1), part.opacity);
    const Float of_part = hn::IfThenElse(in_front, set(1), through_sum);
    const Float of_sum = hn::IfThenElse(in_front, through_part, set(1));
    for (std::size_t c = 0; c < 3; ++c) {
      f.channel[1 + c] = hn::MulAdd(of_part, part.color[c], hn::Mul(of_sum, f.channel[1 + c]));
    }
    f.channel[4] = hn::MulAdd(of_part, part.opacity, hn::Mul(of_sum, f.channel[4]));
  }

  Pieces pieces_;
  OrderedBlocks& blocks_;
};

/// The same by a table of whole segments, or from the medium at their ends alone.
class ApproximateFullShader : public ApproximateMedium {
 public:
  ApproximateFullShader(const Picture& picture, int, int, OrderedBlocks& blocks)
      : ApproximateMedium(picture), blocks_(blocks) {}

  HWY_INLINE bool begin(std::uint32_t cell) {
    blocks_.begin(cell);
    return ApproximateMedium::begin(cell);
  }
  [[nodiscard]] HWY_INLINE bool wants(std::size_t block) const { return blocks_.wants(block); }

  HWY_INLINE void add(std::size_t block, Lanes covered, const BlockSegments& segments) {
    const BlockSegments s = with_cell_value(segments);
    const Float through = length(s, covered);
    std::array<Float, 4> light = mean(s, through, covered);
    if (!is_tabled()) {
      light[3] = preint::HWY_NAMESPACE::absorbed(FloatTag(), hn::Mul(through, light[3]));
      for (std::size_t c = 0; c < 3; ++c) light[c] = hn::Mul(light[c], light[3]);
    }
    Fragment f;
    f.channel[0] = hn::Add(s.near, s.far);
    for (std::size_t c = 0; c < 4; ++c) f.channel[1 + c] = hn::IfThenElseZero(covered, light[c]);
    blocks_.insert(block, covered, f);
  }

 private:
  OrderedBlocks& blocks_;
};

}  // namespace tetraglass::project::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
