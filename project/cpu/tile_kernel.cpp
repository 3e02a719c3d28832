#include "project/cpu/tile_kernel.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>
#include <vector>

#include <hwy/aligned_allocator.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "project/cpu/tile_kernel.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set
#include <hwy/highway.h>

#include "project/cpu/iso_shader-inl.h"
#include "project/cpu/lit_shader-inl.h"
#include "project/cpu/ordered_shader-inl.h"
#include "project/cpu/table_shaders-inl.h"
#include "project/cpu/tile_raster-inl.h"
#include "project/cpu/tile_shaders-inl.h"

#if defined(TETRAGLASS_PROJECT_CPU_TILE_KERNEL_ONCE) == 0
#define TETRAGLASS_PROJECT_CPU_TILE_KERNEL_ONCE
namespace tetraglass::project::cpu {

/// Floats of whole tiles, block by block, each in the order of its lanes.
struct TileBuffers::Contents {
  static constexpr std::size_t kPixels = std::size_t{kLargestTile} * kLargestTile;
  hwy::AlignedFreeUniquePtr<float[]> accumulators =
      hwy::AllocateAligned<float>(4 * kPixels);  // see BlockSums
  hwy::AlignedFreeUniquePtr<float[]> stretch;    // only in perspective
  hwy::AlignedFreeUniquePtr<float[]> clipped;    // near and far; only where rays are clipped

  /// Room for so many floats.
  float* records(std::size_t count) {
    if (count > record_count_) {
      records_ = hwy::AllocateAligned<float>(count);
      record_count_ = count;
    }
    return records_.get();
  }

  [[nodiscard]] std::size_t record_count() const { return record_count_; }

  hwy::AlignedFreeUniquePtr<float[]> last_keys;  // only where there are records
  /// Records of each delay line to begin with: wider once many blocks had to be drawn again.
  std::size_t window = kWindow;

  static constexpr std::size_t kWindow = 16;  // enough for nearly all blocks of most meshes
  static constexpr std::size_t kWide = 64;    // ... of slivers: all lines still fit into L2 caches

 private:
  hwy::AlignedFreeUniquePtr<float[]> records_;
  std::size_t record_count_ = 0;
};

}  // namespace tetraglass::project::cpu
#endif

HWY_BEFORE_NAMESPACE();
namespace tetraglass::project::cpu::HWY_NAMESPACE {

/// Writes the pixels of the tile that lie in the image. `pixel` gives red, green, blue and alpha of
/// a place in the accumulators.
template <class F>
void write_pixels(const Picture& picture, int tile_x, int tile_y, const F& pixel) {
  Image& image = *picture.image;
  const int width = std::min(picture.tile_size, image.width - tile_x);
  const int height = std::min(picture.tile_size, image.height - tile_y);
  for (int y = 0; y < height; ++y) {
    float* out = image.pixel(tile_x, tile_y + y);
    for (int x = 0; x < width; ++x) {
      const PixelPlace place = place_of(picture.tile_size, x, y);
      const std::array<float, 4> rgba = pixel(place.block * kLanes + place.lane);
      std::copy(rgba.begin(), rgba.end(), out + 4 * x);
    }
  }
}

/// Whether rays have less of the mesh than all that they meet.
bool is_clipped(const Picture& picture) {
  return !picture.clip.empty() || !picture.ends.empty();
}

/// Feeds the shader with the segments of the cells; returns their number.
template <class Shader>
std::uint64_t rasterize(const Picture& picture, int x, int y, std::span<const std::uint32_t> cells,
                        const TileBuffers::Contents& buffers, Shader& shader) {
  const float* stretch = buffers.stretch.get();
  const float* clipped = !is_clipped(picture) ? nullptr : buffers.clipped.get();
  if (picture.projection->perspective) {
    return TileRaster<true, Shader>(picture, x, y, stretch, clipped, shader).draw(cells);
  }
  return TileRaster<false, Shader>(picture, x, y, stretch, clipped, shader).draw(cells);
}

/// Modes that add up.
template <class Shader>
TileStats shade_tile(const Picture& picture, int x, int y, std::span<const std::uint32_t> cells,
                     TileBuffers::Contents& buffers) {
  Shader shader(picture, x, y, buffers.accumulators.get());
  const std::uint64_t segments = rasterize(picture, x, y, cells, buffers, shader);
  write_pixels(picture, x, y, [&](std::size_t pixel) { return shader.pixel(pixel); });
  return {segments, 0};
}

/// Draws blocks of the tile with delay lines of `window` records each, and returns those blocks for
/// which the window was too short.
template <class Shader>
std::vector<std::uint16_t> blend_blocks(const Picture& picture, int x, int y,
                                        std::span<const std::uint32_t> cells,
                                        std::span<const std::uint16_t> blocks, std::size_t window,
                                        TileBuffers::Contents& buffers, FrontToBack& image,
                                        std::uint64_t& segments) {
  std::vector<std::uint16_t> lines_of_blocks(kTilePixels / kLanes, kNoLine);
  std::vector<FragmentLines::Line> states(blocks.size());
  FragmentLines lines(image, buffers.records(blocks.size() * window * FragmentLines::kRecord),
                      buffers.last_keys.get(), states.data(), window, picture.opaque);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    lines_of_blocks[blocks[i]] = static_cast<std::uint16_t>(i);
    lines.clear(i);
    image.clear(blocks[i]);
  }
  OrderedBlocks ordered(picture, lines, lines_of_blocks);
  Shader shader(picture, x, y, ordered);
  segments += rasterize(picture, x, y, cells, buffers, shader);
  std::vector<std::uint16_t> violated;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    lines.flush(i, blocks[i]);
    if (lines.line(i).violated) violated.push_back(blocks[i]);
  }
  return violated;
}

/// The cells, in their order, with pixels in the rectangle around the blocks of a tile.
std::vector<std::uint32_t> cells_over(const Picture& picture, int tile_x, int tile_y,
                                      std::span<const std::uint32_t> cells,
                                      std::span<const std::uint16_t> blocks) {
  const int columns = picture.tile_size / kBlockWidth;
  int left = columns;
  int right = -1;
  int top = columns * kBlockWidth;
  int bottom = -1;
  for (const int block : blocks) {
    left = std::min(left, block % columns);
    right = std::max(right, block % columns);
    top = std::min(top, block / columns);
    bottom = std::max(bottom, block / columns);
  }
  const int first_x = tile_x + left * kBlockWidth;
  const int last_x = tile_x + (right + 1) * kBlockWidth - 1;
  const int first_y = tile_y + top * kBlockHeight;
  const int last_y = tile_y + (bottom + 1) * kBlockHeight - 1;
  std::vector<std::uint32_t> result;
  for (const std::uint32_t cell : cells) {
    const PixelBounds& bounds = picture.cells->cells[cell].bounds;
    if (bounds.first_x <= last_x && bounds.last_x >= first_x && bounds.first_y <= last_y &&
        bounds.last_y >= first_y) {
      result.push_back(cell);
    }
  }
  return result;
}

/// Modes that blend.
template <class Shader>
TileStats blend_tile(const Picture& picture, int x, int y, std::span<const std::uint32_t> cells,
                     TileBuffers::Contents& buffers) {
  constexpr std::size_t kWider = 4;         // times, where the window was too short
  constexpr std::size_t kMany = 16;         // one of so many blocks
  constexpr std::size_t kMemory = 1 << 22;  // floats of all delay lines of one pass
  if (!picture.cells_in_order && !buffers.last_keys) {
    buffers.last_keys = hwy::AllocateAligned<float>(TileBuffers::Contents::kPixels);
  }
  FrontToBack image(buffers.accumulators.get());
  const auto side = static_cast<std::size_t>(picture.tile_size);
  std::vector<std::uint16_t> blocks(side * side / kLanes);
  std::iota(blocks.begin(), blocks.end(), std::uint16_t{0});
  const std::size_t lines = blocks.size();
  const std::size_t first_window = picture.cells_in_order ? 0 : buffers.window;
  TileStats stats;
  blocks = blend_blocks<Shader>(picture, x, y, cells, blocks, first_window, buffers, image,
                                stats.fragments);
  stats.redone = blocks.size();
  if (kMany * stats.redone > lines) buffers.window = TileBuffers::Contents::kWide;
  for (std::size_t window = first_window * kWider; !blocks.empty(); window *= kWider) {
    const std::vector<std::uint32_t> covering = cells_over(picture, x, y, cells, blocks);
    const std::size_t at_once =
        std::max<std::size_t>(1, kMemory / (window * FragmentLines::kRecord));
    std::vector<std::uint16_t> violated;
    for (std::size_t first = 0; first < blocks.size(); first += at_once) {
      const auto part = std::span<const std::uint16_t>(blocks).subspan(
          first, std::min(at_once, blocks.size() - first));
      std::uint64_t again = 0;
      const std::vector<std::uint16_t> left =
          blend_blocks<Shader>(picture, x, y, covering, part, window, buffers, image, again);
      violated.insert(violated.end(), left.begin(), left.end());
    }
    blocks = std::move(violated);
  }
  write_pixels(picture, x, y, [&](std::size_t pixel) { return image.pixel(pixel); });
  return stats;
}

TileStats draw_medium(const Picture& picture, int x, int y, std::span<const std::uint32_t> cells,
                      TileBuffers::Contents& buffers) {
  if (picture.single_color) return shade_tile<SingleColorShader>(picture, x, y, cells, buffers);
  if (picture.integrator == Integrator::psi) {
    return blend_tile<FullShader<PsiPieces>>(picture, x, y, cells, buffers);
  }
  if (picture.integrator != Integrator::exact) {
    return blend_tile<ApproximateFullShader>(picture, x, y, cells, buffers);
  }
  if (picture.lighting == nullptr) {
    return blend_tile<FullShader<ExactPieces>>(picture, x, y, cells, buffers);
  }
  switch (picture.lighting->shading) {
    case Shading::single:
      return blend_tile<LitOnceShader<Shading::single>>(picture, x, y, cells, buffers);
    case Shading::weighted:
      return blend_tile<LitOnceShader<Shading::weighted>>(picture, x, y, cells, buffers);
    case Shading::surface:
      return blend_tile<LitOnceShader<Shading::surface>>(picture, x, y, cells, buffers);
    case Shading::interpolated:
      return blend_tile<InterpolatedShader>(picture, x, y, cells, buffers);
    case Shading::none:
    case Shading::flat:
    case Shading::smooth:
      break;
  }
  return blend_tile<SmoothShader>(picture, x, y, cells, buffers);
}

TileStats tile(const Picture& picture, int x, int y, std::span<const std::uint32_t> cells,
               TileBuffers::Contents& buffers) {
  if (picture.projection->perspective) {
    if (!buffers.stretch) {
      buffers.stretch = hwy::AllocateAligned<float>(TileBuffers::Contents::kPixels);
    }
    fill_stretch(*picture.projection, x, y, picture.tile_size, buffers.stretch.get());
  }
  if (is_clipped(picture)) {
    if (!buffers.clipped) {
      buffers.clipped = hwy::AllocateAligned<float>(2 * TileBuffers::Contents::kPixels);
    }
    fill_clipped(picture, x, y, buffers.clipped.get());
  }
  const bool exact = picture.integrator == Integrator::exact;
  switch (picture.mode) {
    case Mode::thickness:
      return shade_tile<ThicknessShader>(picture, x, y, cells, buffers);
    case Mode::emission:
      return exact ? shade_tile<EmissionShader>(picture, x, y, cells, buffers)
                   : shade_tile<ApproximateEmissionShader>(picture, x, y, cells, buffers);
    case Mode::absorption:
      return exact ? shade_tile<AbsorptionShader>(picture, x, y, cells, buffers)
                   : shade_tile<ApproximateAbsorptionShader>(picture, x, y, cells, buffers);
    case Mode::mip:
      if (picture.mip_of == MipOf::field) {
        return shade_tile<FieldMaximumShader>(picture, x, y, cells, buffers);
      }
      return exact ? shade_tile<ColorMaximumShader>(picture, x, y, cells, buffers)
                   : shade_tile<TabledMaximumShader>(picture, x, y, cells, buffers);
    case Mode::full:
      return draw_medium(picture, x, y, cells, buffers);
    case Mode::iso:
      return picture.nearest_only ? shade_tile<NearestSurfaceShader>(picture, x, y, cells, buffers)
                                  : blend_tile<IsoShader>(picture, x, y, cells, buffers);
  }
  return {};
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

std::size_t TileBuffers::ray_bytes() const {
  return contents_->stretch ? Contents::kPixels * sizeof(float) : 0;
}
std::size_t TileBuffers::clip_bytes() const {
  return contents_->clipped ? 2 * Contents::kPixels * sizeof(float) : 0;
}
std::size_t TileBuffers::order_bytes() const {
  const std::size_t keys = contents_->last_keys ? Contents::kPixels : 0;
  return (contents_->record_count() + keys) * sizeof(float);
}

TileStats draw_tile(const Picture& picture, int x, int y, std::span<const std::uint32_t> cells,
                    TileBuffers& buffers) {
  return HWY_DYNAMIC_DISPATCH(tile)(picture, x, y, cells, *buffers);
}

}  // namespace tetraglass::project::cpu
#endif  // HWY_ONCE
