#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "project/cpu/drawn_cells.h"
#include "project/cpu/lighting.h"
#include "project/cpu/lookup_table.h"
#include "project/cpu/medium.h"
#include "project/cpu/surfaces.h"
#include "project/cpu/view_points.h"
#include "project/image.h"
#include "project/opaque_layers.h"

namespace tetraglass::project::cpu {

/// The most pixels each way of a tile, which is square.
inline constexpr int kLargestTile = 64;

/// What all tiles of a picture have in common. Everything that is pointed to outlives the drawing.
struct Picture {
  Mode mode = Mode::thickness;
  MipOf mip_of = MipOf::field;
  /// Modes that add up: the largest, for the least set-up. Modes that blend keep the last fragments
  /// of each pixel, which have to stay in the cache.
  int tile_size = kLargestTile;
  /// Rays that let through less than this are opaque; 0: none (mode full).
  float opaque = 0;
  std::optional<std::array<float, 3>> single_color;  ///< of all light (mode full)
  bool nearest_only = false;                         ///< all surfaces are opaque (mode iso)
  bool cells_in_order = false;  ///< modes that blend: what comes later lies behind
  Integrator integrator = Integrator::exact;
  const LookupTable* table = nullptr;  ///< null where the integrator has none
  const DrawnCells* cells = nullptr;
  const ViewPoints* points = nullptr;
  const Projection* projection = nullptr;
  const Frame* frame = nullptr;
  std::span<const ClipPlane> clip;
  RayEnds ends;                    ///< of the image's pixels; none where no ray ends in the mesh
  const Medium* medium = nullptr;  ///< null in modes that have no use for it
  std::span<const IntervalRange> intervals;  ///< of each drawn cell, where segments are integrated
  std::span<const Surface> surfaces;         ///< mode iso
  const Lighting* lighting = nullptr;        ///< null without shading
  std::span<const ViewedLight> lights;       ///< of the lighting; none for a headlight
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

  /// What effects took so far.
  [[nodiscard]] std::size_t ray_bytes() const;
  [[nodiscard]] std::size_t clip_bytes() const;
  [[nodiscard]] std::size_t order_bytes() const;

  struct Contents;
  [[nodiscard]] Contents& operator*() const { return *contents_; }

 private:
  std::unique_ptr<Contents> contents_;
};

/// What drawing a tile took.
struct TileStats {
  std::uint64_t fragments = 0;
  std::uint64_t redone = 0;  ///< blocks of pixels that were drawn again with a wider window
};

/// Draws the tile whose first pixel is (x, y): the cells (numbers of drawn cells), by the widest
/// vectors of the machine. Writes the tile's pixels of the image.
///
/// In modes that blend the cells come roughly front to back. The segments of each pixel are then
/// put in exact order: in a window of 16 segments, or of 64 where that was often too short; blocks
/// of pixels where it was not enough are drawn again, with wider windows, until it is. Cells in an
/// order of their own are blended as they come.
///
/// Tiles do not touch each other's pixels and may be drawn at once.
///
/// Rays that run within a face are decided as the reference decides them: as if moved by a tiny
/// step to the right and up.
TileStats draw_tile(const Picture& picture, int x, int y, std::span<const std::uint32_t> cells,
                    TileBuffers& buffers);

}  // namespace tetraglass::project::cpu
