#include "project/slices/slab_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <oneapi/tbb/parallel_for.h>

namespace tetraglass::project::slices {
namespace {

/// The slabs' outlines as triangles, the farthest first.
struct Triangles {
  std::vector<std::array<float, 2>> position;
  std::vector<std::array<float, 2>> slab;
  std::vector<std::array<float, 3>> low;
  std::vector<std::array<float, 3>> high;
};

std::array<float, 3> owned_from(const Block& block) {
  std::array<float, 3> result{};
  for (int k = 0; k < 3; ++k) {
    result[static_cast<std::size_t>(k)] =
        block.low[k] == 0 ? -1.0F : static_cast<float>(block.low[k]);
  }
  return result;
}

/// A place at the very end of the grid belongs to the last block.
std::array<float, 3> owned_to(const Block& block, const Block& all) {
  std::array<float, 3> result{};
  for (int k = 0; k < 3; ++k) {
    result[static_cast<std::size_t>(k)] =
        static_cast<float>(block.high[k] + (block.high[k] == all.high[k] ? 1 : 0));
  }
  return result;
}

struct PlacedBlock {
  Block block;
  GridBox box;
  std::array<Eigen::Vector3d, 8> corners;
};

/// The triangles of one slab.
void add_slab(const GridView& view, const Slab& slab, std::optional<int> layers,
              const std::vector<PlacedBlock>& blocks, const Block& all, const gl::Tile& tile,
              double margin, Triangles& triangles) {
  for (const PlacedBlock& placed : blocks) {
    std::vector<Eigen::Vector2d> polygon;
    if (layers) {
      GridBox box = placed.box;
      box.low[*layers] = std::max(box.low[*layers], slab.low);
      box.high[*layers] = std::min(box.high[*layers], slab.high);
      if (!(box.low[*layers] <= box.high[*layers])) continue;
      polygon = outline(view, view.corners(box), slab.depths, tile, margin);
    } else {
      polygon = outline(view, placed.corners, slab.depths, tile, margin);
    }
    const auto add = [&](const Eigen::Vector2d& at) {
      triangles.position.push_back({static_cast<float>(2 * at.x() / tile.width - 1),
                                    static_cast<float>(2 * at.y() / tile.height - 1)});
      triangles.slab.push_back(slab.bounds);
      triangles.low.push_back(owned_from(placed.block));
      triangles.high.push_back(owned_to(placed.block, all));
    };
    for (std::size_t i = 2; i < polygon.size(); ++i) {
      add(polygon[0]);
      add(polygon[i - 1]);
      add(polygon[i]);
    }
  }
}

void append(const Triangles& part, Triangles& whole) {
  whole.position.insert(whole.position.end(), part.position.begin(), part.position.end());
  whole.slab.insert(whole.slab.end(), part.slab.begin(), part.slab.end());
  whole.low.insert(whole.low.end(), part.low.begin(), part.low.end());
  whole.high.insert(whole.high.end(), part.high.begin(), part.high.end());
}

void draw(const gl::Context& context, const gl::Program& program, const Triangles& triangles) {
  if (triangles.position.empty()) return;
  gl::VertexArrays arrays(context);
  arrays.add(0, triangles.position);
  arrays.add(1, triangles.slab);
  arrays.add(2, triangles.low);
  arrays.add(3, triangles.high);
  program.use();
  arrays.draw(triangles.position.size());
}

}  // namespace

void draw_slabs(const gl::Context& context, const gl::Program& program, const GridView& view,
                const mesh::RectilinearGrid& grid, const std::vector<Slab>& slabs,
                const std::vector<Block>& blocks, std::optional<int> layers, const gl::Tile& tile) {
  const Block all = whole_grid(grid);
  std::vector<PlacedBlock> placed;
  for (const Block& block : blocks) {
    const GridBox box = box_of(block, grid);
    placed.push_back({block, box, view.corners(box)});
  }
  // What the rasterizer rounds: to half a subpixel each way; before that to floats.
  const double margin = std::ldexp(1, -context.limits().subpixel_bits) +
                        std::ldexp(std::max(tile.width, tile.height), -19);
  // In runs, so that the outlines of very many slabs do not take very much memory.
  constexpr std::size_t kRun = 4096;
  for (std::size_t first = 0; first < slabs.size(); first += kRun) {
    std::vector<Triangles> parts(std::min(kRun, slabs.size() - first));
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
      add_slab(view, slabs[first + i], layers, placed, all, tile, margin, parts[i]);
    });
    Triangles run;
    for (const Triangles& part : parts) append(part, run);
    draw(context, program, run);
  }
}

}  // namespace tetraglass::project::slices
