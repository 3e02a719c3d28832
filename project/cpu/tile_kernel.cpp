#include "project/cpu/tile_kernel.h"

#include <algorithm>
#include <array>

#include <hwy/aligned_allocator.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "project/cpu/tile_kernel.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set
#include <hwy/highway.h>

#include "project/cpu/tile_raster-inl.h"
#include "project/cpu/tile_shaders-inl.h"

#if defined(TETRAGLASS_PROJECT_CPU_TILE_KERNEL_ONCE) == 0
#define TETRAGLASS_PROJECT_CPU_TILE_KERNEL_ONCE
namespace tetraglass::project::cpu {

/// Floats of whole tiles, block by block, each in the order of its lanes.
struct TileBuffers::Contents {
  static constexpr std::size_t kPixels = std::size_t{kTileSize} * kTileSize;
  hwy::AlignedFreeUniquePtr<float[]> accumulators =
      hwy::AllocateAligned<float>(4 * kPixels);  // [channel][pixel]
  hwy::AlignedFreeUniquePtr<float[]> stretch = hwy::AllocateAligned<float>(kPixels);
};

}  // namespace tetraglass::project::cpu
#endif

HWY_BEFORE_NAMESPACE();
namespace tetraglass::project::cpu::HWY_NAMESPACE {

/// Writes the pixels of the tile that lie in the image. `pixel` gives red, green, blue and alpha of
/// a place in the accumulators.
template <class F>
void write_pixels(Image& image, int tile_x, int tile_y, const F& pixel) {
  const int width = std::min(kTileSize, image.width - tile_x);
  const int height = std::min(kTileSize, image.height - tile_y);
  for (int y = 0; y < height; ++y) {
    float* out = image.pixel(tile_x, tile_y + y);
    for (int x = 0; x < width; ++x) {
      const int block = (y / kBlockHeight) * kBlocksX + x / kBlockWidth;
      const int lane = (y % kBlockHeight) * kBlockWidth + x % kBlockWidth;
      const std::array<float, 4> rgba =
          pixel(static_cast<std::size_t>(block) * kLanes + static_cast<std::size_t>(lane));
      std::copy(rgba.begin(), rgba.end(), out + 4 * x);
    }
  }
}

template <class Shader>
std::uint64_t shade_tile(const Picture& picture, int x, int y, std::span<const std::uint32_t> cells,
                         TileBuffers::Contents& buffers) {
  Shader shader(picture, buffers.accumulators.get());
  std::uint64_t segments = 0;
  if (picture.projection->perspective) {
    fill_stretch(*picture.projection, x, y, buffers.stretch.get());
    segments = TileRaster<true, Shader>(picture, x, y, buffers.stretch.get(), shader).draw(cells);
  } else {
    segments = TileRaster<false, Shader>(picture, x, y, nullptr, shader).draw(cells);
  }
  write_pixels(*picture.image, x, y, [&](std::size_t pixel) { return shader.pixel(pixel); });
  return segments;
}

std::uint64_t tile(const Picture& picture, int x, int y, std::span<const std::uint32_t> cells,
                   TileBuffers::Contents& buffers) {
  switch (picture.mode) {
    case Mode::thickness:
      return shade_tile<ThicknessShader>(picture, x, y, cells, buffers);
    default:
      return 0;
  }
}

}  // namespace tetraglass::project::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tetraglass::project::cpu {

HWY_EXPORT(tile);

TileBuffers::TileBuffers() : contents_(std::make_unique<Contents>()) {}
TileBuffers::~TileBuffers() = default;
TileBuffers::TileBuffers(TileBuffers&&) noexcept = default;
TileBuffers& TileBuffers::operator=(TileBuffers&&) noexcept = default;

std::uint64_t draw_tile(const Picture& picture, int x, int y, std::span<const std::uint32_t> cells,
                        TileBuffers& buffers) {
  return HWY_DYNAMIC_DISPATCH(tile)(picture, x, y, cells, *buffers);
}

}  // namespace tetraglass::project::cpu
#endif  // HWY_ONCE
