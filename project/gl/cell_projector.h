#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "project/camera.h"
#include "project/gl/cell_layout.h"
#include "project/gl/fragment_lists.h"
#include "project/gl/light_texels.h"
#include "project/gl/medium_buffers.h"
#include "project/gl/mesh_buffers.h"
#include "project/gl/segment_tables.h"
#include "project/gl/view_uniforms.h"
#include "project/image.h"
#include "project/opaque_layers.h"
#include "project/plan.h"
#include "project/stats.h"
#include "sort/cell_sorter.h"

namespace tetraglass::project::gl {

/// Draws one scene from any number of views: the mesh, the transfer function, tables and shaders
/// stay on the context. Refers to the context and the scene; both outlive it.
class CellProjector {
 public:
  /// The largest picture that is drawn at once: 256 MB of RGBA32F. Larger ones are drawn in tiles.
  static constexpr int kLargestTile = 4096;

  /// What gradients between the vertices are made of, where they light.
  enum class Gradients {
    normalized,       ///< those at the vertices, interpolated, then normalized
    of_unit_vertices  ///< normalized at the vertices only: too short, hence dark, where they
                      ///< differ. A bad example, to be measured
  };

  /// The scene has a drawable cell. Adds the time for tables to `stats`. Throws UnavailableError
  /// where the mesh or the tables do not fit. `most_fragments` are gathered at once for the order
  /// `fragments`.
  CellProjector(const Context& context, const Scene& scene, const Plan& plan, Stats& stats,
                int largest_tile = kLargestTile, std::size_t most_fragments = FragmentLists::kMost,
                Gradients gradients = Gradients::normalized);

  /// The picture from one view; adds times, fragments and the order to `stats`. The scene's camera
  /// and size do not matter. Its opaque geometry may have changed since the last one (but for the
  /// layouts faces12, where there is some or none from the beginning).
  [[nodiscard]] Image draw(const Frame& frame, Stats& stats);

  /// What the cells take on the context.
  [[nodiscard]] std::size_t bytes() const { return cells_->bytes().sum(); }

 private:
  /// `pass`: a `#define` of FragmentLists, or empty.
  [[nodiscard]] const Program& program(bool parallel, const std::string& pass = "");
  void add_cell_bytes(Stats& stats) const;
  /// Whether the cells are in exact order, or need none.
  bool order_cells(const Frame& frame, Stats& stats);
  void bind() const;
  void set_blending() const;
  /// Rays end where they are told, if they are told.
  [[nodiscard]] Image draw_rays(const Frame& frame, const ViewUniforms& view, RayEnds ends,
                                Stats& stats);
  /// Hands the tile's part of the ends to the shaders; false where none of its pixels is wanted.
  bool place_ends(const Frame& frame, const ViewUniforms& view, const Tile& tile);
  void draw_tile(bool parallel, const ViewUniforms& view, const Tile& tile, const Target& target,
                 Image& image, Stats& stats);
  void draw_fragments(bool parallel, const ViewUniforms& view, const Tile& tile, Stats& stats);

  const Context& context_;
  const Scene& scene_;
  Plan plan_;
  int largest_tile_;
  std::size_t most_fragments_;
  Gradients gradients_;
  Normalization normalization_;
  std::vector<std::uint32_t> drawn_;
  std::unique_ptr<CellLayout> cells_;
  std::optional<MediumBuffers> medium_;
  std::optional<TextureBuffer> surfaces_;
  LightTexels lights_;
  SegmentTables tables_;
  bool cells_told_ = false;  // of cells in parts, by the first frame
  FragmentCounter counter_;
  std::map<std::string, Program> programs_;  // by the purpose that they were made for
  bool by_fragments_ = false;                // the frame
  RayEnds ends_;                             // of the frame's rays, while they are drawn
  std::optional<Table> tile_ends_;
  std::vector<float>
      unwanted_;  // depths of the tile's pixels that keep the others from being drawn
  std::optional<FragmentLists> lists_;
  std::optional<sort::CellSorter> sorter_;
};

}  // namespace tetraglass::project::gl
