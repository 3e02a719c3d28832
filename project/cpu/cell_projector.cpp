#include "project/cpu/cell_projector.h"

#include <atomic>

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include "base/stopwatch.h"
#include "project/cpu/tile_kernel.h"

namespace tetraglass::project::cpu {

CellProjector::CellProjector(const Scene& scene, const Plan& plan)
    : scene_(scene), plan_(plan), cells_(scene) {
  // Halved before they are added or subtracted: numbers near the largest double must not overflow.
  const mesh::Box box = mesh::bounds(*scene.mesh);
  if (box.isEmpty()) return;
  middle_ = 0.5 * box.min() + 0.5 * box.max();
  const double half_diagonal = (0.5 * box.max() - 0.5 * box.min()).stableNorm();
  if (half_diagonal > 0) radius_ = half_diagonal;
}

Image CellProjector::draw(const Frame& frame, Stats& stats) {
  const base::Stopwatch clock;
  Image image(frame.width(), frame.height());
  const Projection projection(frame, radius_, middle_);
  points_.project(*scene_.mesh, cells_, frame, projection);
  bins_.assign(cells_, points_, frame.width(), frame.height(), kTileSize);
  const Picture picture = {scene_.mode, &cells_, &points_, &projection, &image};
  const std::vector<std::uint32_t> tiles = bins_.largest_first();
  std::atomic<std::uint64_t> fragments{0};
  tbb::enumerable_thread_specific<TileBuffers> buffers;
  tbb::parallel_for(
      std::size_t{0}, tiles.size(),
      [&](std::size_t i) {
        const std::size_t tile = tiles[i];
        const int x = static_cast<int>(tile % bins_.tiles_x()) * kTileSize;
        const int y = static_cast<int>(tile / bins_.tiles_x()) * kTileSize;
        fragments += draw_tile(picture, x, y, bins_.cells(tile), buffers.local());
      },
      tbb::simple_partitioner());
  stats.fragments += fragments;
  stats.project_ms += clock.milliseconds();
  stats.threads = tbb::this_task_arena::max_concurrency();
  return image;
}

}  // namespace tetraglass::project::cpu
