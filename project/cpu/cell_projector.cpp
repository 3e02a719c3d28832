#include "project/cpu/cell_projector.h"

#include <atomic>

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include "base/stopwatch.h"
#include "project/cpu/tile_kernel.h"
#include "project/cpu/tile_order.h"

namespace tetraglass::project::cpu {

CellProjector::CellProjector(const Scene& scene, const Plan& plan)
    : scene_(scene), plan_(plan), cells_(scene) {
  // Halved before they are added or subtracted: numbers near the largest double must not overflow.
  const mesh::Box box = mesh::bounds(*scene.mesh);
  if (box.isEmpty()) return;
  middle_ = 0.5 * box.min() + 0.5 * box.max();
  const double half_diagonal = (0.5 * box.max() - 0.5 * box.min()).stableNorm();
  if (half_diagonal > 0) radius_ = half_diagonal;
  surfaces_ = surfaces(scene, cells_);
  if (scene.shading != Shading::none) lighting_.emplace(scene, cells_);
  if (scene.mode == Mode::thickness || scene.mode == Mode::iso) return;
  medium_.emplace(scene.transfer_function, cells_.scale, radius_);
  intervals_ = cell_intervals(*medium_, cells_);
}

Image CellProjector::draw(const Frame& frame, Stats& stats) {
  const base::Stopwatch clock;
  Image image(frame.width(), frame.height());
  const Projection projection(frame, radius_, middle_);
  points_.project(*scene_.mesh, cells_, frame, projection);
  const bool blends = scene_.mode == Mode::full || scene_.mode == Mode::iso;
  const int tile_size = blends ? kLargestTile / 2 : kLargestTile;
  bins_.assign(cells_, points_, frame.width(), frame.height(), tile_size);
  Picture picture;
  picture.mode = scene_.mode;
  picture.mip_of = scene_.mip_of;
  picture.tile_size = tile_size;
  picture.opaque = static_cast<float>(1 - plan_.opaque_at);
  picture.cells = &cells_;
  picture.points = &points_;
  picture.projection = &projection;
  picture.frame = &frame;
  picture.clip = scene_.clip;
  picture.medium = medium_ ? &*medium_ : nullptr;
  picture.intervals = intervals_;
  picture.surfaces = surfaces_;
  picture.lighting = lighting_ ? &*lighting_ : nullptr;
  const std::vector<ViewedLight> lights =
      lighting_ ? lighting_->view(frame, projection) : std::vector<ViewedLight>{};
  picture.lights = lights;
  picture.image = &image;
  const std::vector<std::uint32_t> tiles = bins_.largest_first();
  std::atomic<std::uint64_t> fragments{0};
  struct Worker {
    TileBuffers buffers;
    TileOrder order;
  };
  tbb::enumerable_thread_specific<Worker> workers;
  tbb::parallel_for(
      std::size_t{0}, tiles.size(),
      [&](std::size_t i) {
        const std::size_t tile = tiles[i];
        const int x = static_cast<int>(tile % bins_.tiles_x()) * tile_size;
        const int y = static_cast<int>(tile / bins_.tiles_x()) * tile_size;
        Worker& worker = workers.local();
        std::span<const std::uint32_t> cells = bins_.cells(tile);
        if (blends)
          cells = worker.order.front_to_back(cells, cells_, points_, {x, y, tile_size, tile_size});
        fragments += draw_tile(picture, x, y, cells, worker.buffers).fragments;
      },
      tbb::simple_partitioner());
  stats.fragments += fragments;
  if (blends) stats.sort_method = to_string(plan_.sort);
  stats.project_ms += clock.milliseconds();
  stats.threads = tbb::this_task_arena::max_concurrency();
  return image;
}

}  // namespace tetraglass::project::cpu
