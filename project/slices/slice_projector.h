#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "project/camera.h"
#include "project/gl/light_texels.h"
#include "project/gl/medium_buffers.h"
#include "project/gl/program.h"
#include "project/gl/view_uniforms.h"
#include "project/image.h"
#include "project/plan.h"
#include "project/slices/bricks.h"
#include "project/slices/grid_texture.h"
#include "project/slices/shown_blocks.h"
#include "project/slices/slab_tables.h"
#include "project/slices/slabs.h"
#include "project/stats.h"

namespace tetraglass::project::slices {

/// Draws the grid of one scene by slabs from any number of views: textures, transfer function and
/// shaders stay on the context. Refers to the context and the scene; both outlive it.
class SliceProjector {
 public:
  /// The largest picture that is drawn at once: 256 MB of RGBA32F. Larger ones are drawn in tiles.
  static constexpr int kLargestTile = 4096;

  /// The scene has a grid with values that are all finite. Adds the time for tables to `stats`.
  /// Throws UnavailableError where the grid or the tables do not fit.
  SliceProjector(const gl::Context& context, const Scene& scene, const Plan& plan, Stats& stats,
                 int largest_tile = kLargestTile);

  /// The picture from one view; adds times and fragments to `stats`. The scene's camera and size do
  /// not matter.
  [[nodiscard]] Image draw(const Frame& frame, Stats& stats);

  /// What the grid takes on the context.
  [[nodiscard]] std::size_t bytes() const;

 private:
  /// The axis of the 2D textures that a view needs; none for a 3D texture.
  [[nodiscard]] std::optional<int> layers(const GridView& view) const;
  /// Of the slabs, in units of the normalization.
  [[nodiscard]] double nominal_length(std::optional<int> layers) const;
  [[nodiscard]] const GridTexture& texture(std::optional<int> layers);
  [[nodiscard]] const gl::Program& program(bool parallel, std::optional<int> layers, bool blocks);
  /// How far from the middle of a slab, in points along each axis, its values are looked up; none:
  /// anywhere.
  [[nodiscard]] std::optional<Eigen::Vector3i> reach(const GridView& view) const;
  [[nodiscard]] std::vector<Brick> bricks(const GridView& view,
                                          const std::optional<Eigen::Vector3i>& reach) const;
  [[nodiscard]] std::vector<Block> shown(const Block& voxels,
                                         const std::optional<Eigen::Vector3i>& reach) const;
  /// The blocks that show something, and the points of their texture.
  struct DrawnBrick {
    Block points;
    std::vector<Block> blocks;
  };
  /// For any of them, one at a time.
  [[nodiscard]] GridTexture& brick_texture(const std::vector<DrawnBrick>& bricks);
  void draw_tile(const GridView& view, const std::vector<Slab>& slabs,
                 const std::vector<DrawnBrick>& bricks, const gl::ViewUniforms& uniforms,
                 const gl::Tile& tile);
  void set_blending() const;

  const gl::Context& context_;
  const Scene& scene_;
  Plan plan_;
  int largest_tile_;
  gl::Normalization normalization_;
  BlockRanges ranges_;
  SlabTables tables_;
  gl::LightTexels lights_;
  gl::FragmentCounter counter_;
  std::map<std::string, gl::Program> programs_;  // by the purpose that they were made for
  std::map<int, GridTexture> textures_;          // by the axis of the layers; -1: 3D
  std::optional<GridTexture> brick_texture_;
  std::optional<gl::MediumBuffers> medium_;
  std::optional<gl::TextureBuffer> surfaces_;
  std::optional<gl::TextureBuffer> points_;  // of uneven axes
};

}  // namespace tetraglass::project::slices
