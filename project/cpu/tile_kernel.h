#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "project/cpu/drawn_cells.h"
#include "project/cpu/view_points.h"
#include "project/image.h"

namespace tetraglass::project::cpu {

/// The side of the square tiles in which pictures are drawn, in pixels: what they accumulate stays
/// in the cache.
inline constexpr int kTileSize = 64;

/// What all tiles of a picture have in common. Everything that is pointed to outlives the drawing.
struct Picture {
  Mode mode = Mode::thickness;
  const DrawnCells* cells = nullptr;
  const ViewPoints* points = nullptr;
  const Projection* projection = nullptr;
  Image* image = nullptr;
};

/// Buffers of one thread, kept from tile to tile.
class TileBuffers {
 public:
  TileBuffers();
  ~TileBuffers();
  TileBuffers(TileBuffers&&) noexcept;
  TileBuffers& operator=(TileBuffers&&) noexcept;
  TileBuffers(const TileBuffers&) = delete;
  TileBuffers& operator=(const TileBuffers&) = delete;

  struct Contents;
  [[nodiscard]] Contents& operator*() const { return *contents_; }

 private:
  std::unique_ptr<Contents> contents_;
};

/// Draws the tile whose first pixel is (x, y): the cells (numbers of drawn cells), by the widest
/// vectors of the machine. Writes the tile's pixels of the image. Returns the number of fragments.
/// Tiles do not touch each other's pixels and may be drawn at once.
///
/// Rays that run within a face are decided as the reference decides them: as if moved by a tiny
/// step to the right and up.
std::uint64_t draw_tile(const Picture& picture, int x, int y, std::span<const std::uint32_t> cells,
                        TileBuffers& buffers);

}  // namespace tetraglass::project::cpu
