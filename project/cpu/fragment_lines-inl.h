// Fragments of blocks of pixels in the order of their depth, whatever the order in which they come.
// Compiled for each instruction set: included only by tile_kernel.cpp, after highway.h.

#if defined(TETRAGLASS_PROJECT_CPU_FRAGMENT_LINES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRAGLASS_PROJECT_CPU_FRAGMENT_LINES_INL_H_
#undef TETRAGLASS_PROJECT_CPU_FRAGMENT_LINES_INL_H_
#else
#define TETRAGLASS_PROJECT_CPU_FRAGMENT_LINES_INL_H_
#endif

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include <hwy/highway.h>

#include "project/cpu/block_sums-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tetraglass::project::cpu::HWY_NAMESPACE {

/// What one cell adds to the rays of a block: premultiplied color and opacity, 0 in lanes that the
/// cell does not cover; and the depth by which fragments are ordered.
struct Fragment {
  static constexpr std::size_t kChannels = 5;
  std::array<Float, kChannels> channel;  ///< key, red, green, blue, opacity

  [[nodiscard]] Float key() const { return channel[0]; }
};

/// Color and transmittance of all rays of a tile, front to back.
class FrontToBack {
 public:
  /// `sums`: 4 * kTilePixels floats.
  explicit FrontToBack(float* sums) : sums_(sums, 0) {}

  HWY_INLINE void clear(std::size_t block) {
    for (std::size_t c = 0; c < 4; ++c) {
      hn::Store(set(c == 3 ? 1.0F : 0.0F), FloatTag(), sums_.at(block, c));
    }
  }

  /// Behind what is there. Returns the transmittance.
  HWY_INLINE Float add(std::size_t block, const Fragment& fragment) {
    const Float before = hn::Load(FloatTag(), sums_.at(block, 3));
    for (std::size_t c = 0; c < 3; ++c) {
      float* sum = sums_.at(block, c);
      hn::Store(hn::MulAdd(before, fragment.channel[1 + c], hn::Load(FloatTag(), sum)), FloatTag(),
                sum);
    }
    const Float after = hn::NegMulAdd(before, fragment.channel[4], before);
    hn::Store(after, FloatTag(), sums_.at(block, 3));
    return after;
  }

  /// Of a block that has been cleared.
  [[nodiscard]] std::array<float, 4> pixel(std::size_t i) const {
    return {sums_.pixel(i, 0), sums_.pixel(i, 1), sums_.pixel(i, 2), 1 - sums_.pixel(i, 3)};
  }

 private:
  BlockSums<4> sums_;  // red, green, blue, transmittance
};

/// A delay line per block: the last `window` fragments, in the order of their keys (without a
/// window fragments are composited as they come, whatever their keys). Each new fragment finds its
/// place among them; when the line is full its nearest fragment is composited. A fragment that
/// comes when one behind it has already been composited is told (`is_violated`), never lost
/// silently: the block is then to be drawn again with a wider window. A window of as many fragments
/// as come is always wide enough.
class FragmentLines {
 public:
  static constexpr std::size_t kRecord = Fragment::kChannels * kLanes;

  /// State of one line.
  struct Line {
    std::uint32_t head = 0;
    std::uint32_t count = 0;
    bool violated = false;
    bool opaque = false;
    float opaque_key = 0;  ///< the farthest composited key, once opaque
  };

  /// `records`: window * kRecord floats per line. `last_keys`: kLanes floats per line. `window`: a
  /// power of two, or 0. `opaque`: a line whose rays all let through less than this is not
  /// composited any further; 0: never.
  FragmentLines(FrontToBack& image, float* records, float* last_keys, Line* lines,
                std::size_t window, float opaque)
      : image_(image),
        records_(records),
        last_keys_(last_keys),
        lines_(lines),
        window_(window),
        opaque_(opaque) {}

  HWY_INLINE void clear(std::size_t line) {
    lines_[line] = {};
    if (window_ == 0) return;
    hn::Store(set(std::numeric_limits<float>::lowest()), FloatTag(), last_keys_ + line * kLanes);
  }

  [[nodiscard]] const Line& line(std::size_t line) const { return lines_[line]; }
  [[nodiscard]] bool in_order() const { return window_ == 0; }

  HWY_INLINE void insert(std::size_t line, std::size_t block, Lanes covered, Fragment fragment) {
    Line& state = lines_[line];
    if (window_ == 0) {
      state.opaque = is_opaque(image_.add(block, fragment));
      state.opaque_key = std::numeric_limits<float>::lowest();
      return;
    }
    if (state.count == window_ && !state.opaque) composite_first(line, block);
    if (HWY_UNLIKELY(state.opaque)) {
      const Float last = hn::Load(FloatTag(), last_keys_ + line * kLanes);
      note_violation(state, hn::And(covered, hn::Lt(fragment.key(), last)));
      return;
    }
    // Lanes that are not covered take the key before: they are in order wherever they are.
    std::size_t i = state.count;
    const Float before = i > 0 ? hn::Load(FloatTag(), record(line, i - 1))
                               : hn::Load(FloatTag(), last_keys_ + line * kLanes);
    fragment.channel[0] = hn::IfThenElse(covered, fragment.key(), before);
    for (; i > 0; --i) {
      float* nearer = record(line, i - 1);
      const Lanes exchange = hn::Lt(fragment.key(), hn::Load(FloatTag(), nearer));
      if (hn::AllFalse(FloatTag(), exchange)) break;
      float* place = record(line, i);
      for (std::size_t c = 0; c < Fragment::kChannels; ++c) {
        const Float other = hn::Load(FloatTag(), nearer + c * kLanes);
        hn::Store(hn::IfThenElse(exchange, other, fragment.channel[c]), FloatTag(),
                  place + c * kLanes);
        fragment.channel[c] = hn::IfThenElse(exchange, fragment.channel[c], other);
      }
    }
    float* place = record(line, i);
    for (std::size_t c = 0; c < Fragment::kChannels; ++c) {
      hn::Store(fragment.channel[c], FloatTag(), place + c * kLanes);
    }
    if (i == 0) {
      note_violation(state,
                     hn::Lt(fragment.key(), hn::Load(FloatTag(), last_keys_ + line * kLanes)));
    }
    ++state.count;
  }

  /// Composites what is left.
  void flush(std::size_t line, std::size_t block) {
    while (lines_[line].count > 0 && !lines_[line].opaque) composite_first(line, block);
  }

 private:
  [[nodiscard]] HWY_INLINE float* record(std::size_t line, std::size_t i) const {
    const std::size_t slot = (lines_[line].head + i) & (window_ - 1);
    return records_ + (line * window_ + slot) * kRecord;
  }

  static HWY_INLINE void note_violation(Line& state, Lanes lanes) {
    if (!hn::AllFalse(FloatTag(), lanes)) state.violated = true;
  }

  [[nodiscard]] HWY_INLINE bool is_opaque(Float transmittance) const {
    return hn::AllTrue(FloatTag(), hn::Lt(transmittance, set(opaque_)));
  }

  HWY_INLINE void composite_first(std::size_t line, std::size_t block) {
    Line& state = lines_[line];
    const float* first = record(line, 0);
    Fragment fragment;
    for (std::size_t c = 0; c < Fragment::kChannels; ++c) {
      fragment.channel[c] = hn::Load(FloatTag(), first + c * kLanes);
    }
    const Float left = image_.add(block, fragment);
    hn::Store(fragment.key(), FloatTag(), last_keys_ + line * kLanes);
    state.head = static_cast<std::uint32_t>((state.head + 1) & (window_ - 1));
    --state.count;
    if (is_opaque(left)) {
      state.opaque = true;
      state.opaque_key = hn::GetLane(hn::MaxOfLanes(FloatTag(), fragment.key()));
    }
  }

  FrontToBack& image_;
  float* records_;
  float* last_keys_;
  Line* lines_;
  std::size_t window_;
  float opaque_;
};

}  // namespace tetraglass::project::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
