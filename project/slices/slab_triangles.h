#pragma once

#include <optional>
#include <vector>

#include "project/gl/program.h"
#include "project/gl/view_uniforms.h"
#include "project/slices/grid_view.h"
#include "project/slices/shown_blocks.h"
#include "project/slices/slabs.h"

namespace tetraglass::project::slices {

/// Draws what a tile sees of some blocks of the grid, slab by slab in their order, with the program
/// (slab.vert.glsl) and the texture that are bound. Of several blocks each segment of a ray is
/// drawn by the one that holds its middle, so their order within a slab does not matter. `layers`:
/// the axis across which slabs lie in the grid's own planes, if they do.
void draw_slabs(const gl::Context& context, const gl::Program& program, const GridView& view,
                const mesh::RectilinearGrid& grid, const std::vector<Slab>& slabs,
                const std::vector<Block>& blocks, std::optional<int> layers, const gl::Tile& tile);

}  // namespace tetraglass::project::slices
