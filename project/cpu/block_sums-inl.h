// What the pixels of a tile hold while it is drawn. Compiled for each instruction set: included
// only by tile_kernel.cpp, after highway.h.

#if defined(TETRAGLASS_PROJECT_CPU_BLOCK_SUMS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRAGLASS_PROJECT_CPU_BLOCK_SUMS_INL_H_
#undef TETRAGLASS_PROJECT_CPU_BLOCK_SUMS_INL_H_
#else
#define TETRAGLASS_PROJECT_CPU_BLOCK_SUMS_INL_H_
#endif

#include <algorithm>
#include <cstddef>

#include <hwy/highway.h>

#include "project/cpu/tile_raster-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tetraglass::project::cpu::HWY_NAMESPACE {

/// Some channels of a tile's pixels, [block][channel][lane]: the channels of a block are
/// neighbours. Were they planes, their distance would be a multiple of 4096 bytes, and each load
/// would wait for the store to the channel before.
template <std::size_t kChannels>
class BlockSums {
 public:
  /// `floats`: kChannels * kTilePixels of them, which are filled with `start`.
  BlockSums(float* floats, float start) : floats_(floats) {
    std::fill_n(floats, kChannels * kTilePixels, start);
  }

  [[nodiscard]] HWY_INLINE float* at(std::size_t block, std::size_t channel) const {
    return floats_ + (block * kChannels + channel) * kLanes;
  }
  HWY_INLINE void add(std::size_t block, std::size_t channel, Float amount) const {
    float* sum = at(block, channel);
    hn::Store(hn::Add(hn::Load(FloatTag(), sum), amount), FloatTag(), sum);
  }
  HWY_INLINE void raise(std::size_t block, std::size_t channel, Float value) const {
    float* largest = at(block, channel);
    hn::Store(hn::Max(hn::Load(FloatTag(), largest), value), FloatTag(), largest);
  }

  /// Of a pixel, counted block by block.
  [[nodiscard]] float pixel(std::size_t i, std::size_t channel) const {
    return at(i / kLanes, channel)[i % kLanes];
  }

 private:
  float* floats_;
};

}  // namespace tetraglass::project::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
