#include "project/cpu/cell_projector.h"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include "base/interrupt.h"
#include "base/stopwatch.h"
#include "project/cpu/tile_order.h"
#include "project/opaque_layers.h"
#include "project/single_color.h"

namespace tetraglass::project::cpu {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What the ends of rays say of a tile.
struct TileEnds {
  Region wanted;  ///< the pixels that are wanted lie in here; none: of no width
  double nearest = kInfinity;
};

TileEnds tile_ends(RayEnds ends, const Image& image, const Region& tile) {
  TileEnds result;
  Eigen::AlignedBox2i box;
  for (int y = tile.y; y < std::min(tile.y + tile.height, image.height); ++y) {
    for (int x = tile.x; x < std::min(tile.x + tile.width, image.width); ++x) {
      const double end = ends[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                              static_cast<std::size_t>(x)];
      if (end == -kInfinity) continue;
      result.nearest = std::min(result.nearest, end);
      box.extend(Eigen::Vector2i(x, y));
    }
  }
  if (!box.isEmpty()) {
    result.wanted = {box.min().x(), box.min().y(), box.sizes().x() + 1, box.sizes().y() + 1};
  }
  return result;
}

/// The cells, in their order, with pixels in the region.
void keep_cells_in(const Region& region, const DrawnCells& drawn,
                   std::span<const std::uint32_t> cells, std::vector<std::uint32_t>& kept) {
  kept.clear();
  for (const std::uint32_t cell : cells) {
    const PixelBounds& bounds = drawn.cells[cell].bounds;
    if (bounds.first_x < region.x + region.width && bounds.last_x >= region.x &&
        bounds.first_y < region.y + region.height && bounds.last_y >= region.y) {
      kept.push_back(cell);
    }
  }
}

template <class T>
std::size_t bytes_of(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

}  // namespace

CellProjector::CellProjector(const Scene& scene, const Plan& plan)
    : scene_(scene), plan_(plan), cells_(scene) {
  // Halved before they are added or subtracted: numbers near the largest double must not overflow.
  const mesh::Box box = mesh::bounds(*scene.mesh);
  if (!box.isEmpty()) {
    middle_ = 0.5 * box.min() + 0.5 * box.max();
    const double half_diagonal = (0.5 * box.max() - 0.5 * box.min()).stableNorm();
    if (half_diagonal > 0) radius_ = half_diagonal;
  }
  set_up();
}

void CellProjector::update() {
  cells_.update(scene_);
  drawn_of_cell_.clear();
  set_up();
}

void CellProjector::set_up() {
  set_up_.add(Effect::cells, bytes_of(cells_.cells) + bytes_of(cells_.numbers) +
                                 bytes_of(cells_.point_values) + bytes_of(cells_.cell_values));
  if (scene_.modulation) set_up_.add(Effect::modulation, bytes_of(cells_.densities));
  if (cells_.size() == 0) return;
  surfaces_ = surfaces(scene_, cells_);
  if (scene_.shading != Shading::none) set_up_light();
  if (scene_.mode != Mode::thickness && scene_.mode != Mode::iso) set_up_medium();
  if (plan_.table_n > 0) set_up_table();
  if (is_field_maximum(scene_)) {
    order_ = highest_first(cells_);
    set_up_.add(Effect::cells, bytes_of(order_));
  }
}

void CellProjector::set_up_light() {
  const base::Stopwatch clock;
  lighting_.emplace(scene_, cells_);
  set_up_.add(Effect::gradients, bytes_of(lighting_->gradients), clock.milliseconds());
  if (scene_.lights) set_up_.add(Effect::lights, bytes_of(lighting_->sources));
  if (scene_.mode == Mode::full) {
    set_up_.add(Effect::materials, bytes_of(lighting_->materials));
  }
}

void CellProjector::set_up_medium() {
  const base::Stopwatch clock;
  medium_.emplace(scene_.transfer_function, cells_.scale, radius_);
  if (!is_field_maximum(scene_)) intervals_ = cell_intervals(*medium_, cells_);
  set_up_.add(Effect::medium, bytes_of(medium_->intervals()) + bytes_of(intervals_),
              clock.milliseconds());
}

void CellProjector::set_up_table() {
  const base::Stopwatch clock;
  table_.emplace(scene_, plan_, cells_.scale, radius_);
  set_up_.tables_ms = clock.milliseconds();
  set_up_.add(Effect::table, table_->bytes(), clock.milliseconds());
}

void CellProjector::order_cells(const Frame& frame, Stats& stats) {
  constexpr auto kNotDrawn = std::numeric_limits<std::uint32_t>::max();
  if (!sorts_cells(plan_)) return;
  const base::Stopwatch clock;
  // Sorted with the rest: what is not drawn still tells which of two others lies behind.
  if (!sorter_ || sorted_cells_ != scene_.drawable.cells) {
    sorted_cells_ = scene_.drawable.cells;
    sorter_.emplace(plan_.sort, *scene_.mesh, sorted_cells_);
  }
  if (drawn_of_cell_.empty()) {
    drawn_of_cell_.assign(scene_.mesh->cells.size(), kNotDrawn);
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      drawn_of_cell_[cells_.numbers[i]] = static_cast<std::uint32_t>(i);
    }
  }
  const sort::Order& order = sorter_->sort(frame.view());
  order_.clear();
  order_.reserve(cells_.size());
  for (auto cell = order.cells.rbegin(); cell != order.cells.rend(); ++cell) {
    if (drawn_of_cell_[*cell] != kNotDrawn) order_.push_back(drawn_of_cell_[*cell]);
  }
  stats.sort_method = order.method;
  stats.sort_exact = order.exact;
  stats.cycles += order.cycles;
  stats.sort_ms += clock.milliseconds();
  stats.add(Effect::order, bytes_of(order.cells) + bytes_of(order_) + bytes_of(drawn_of_cell_),
            clock.milliseconds());
}

Picture CellProjector::picture(const Frame& frame, const Projection& projection) const {
  Picture picture;
  picture.mode = scene_.mode;
  picture.mip_of = scene_.mip_of;
  const bool blends = plan_.sort != SortMethod::none;
  picture.tile_size = blends ? kLargestTile / 2 : kLargestTile;
  picture.opaque = static_cast<float>(1 - plan_.opaque_at);
  if (!blends) {
    if (const std::optional<preint::Color> color = single_color(scene_)) {
      const Eigen::Array3f rgb = color->cast<float>();
      picture.single_color = {rgb[0], rgb[1], rgb[2]};
    }
    picture.nearest_only = scene_.mode == Mode::iso;
  }
  picture.cells_in_order = sorts_cells(plan_);
  picture.integrator = plan_.integrator;
  picture.table = table_ ? &*table_ : nullptr;
  picture.cells = &cells_;
  picture.points = &points_;
  picture.projection = &projection;
  picture.frame = &frame;
  picture.clip = scene_.clip;
  picture.medium = medium_ ? &*medium_ : nullptr;
  picture.intervals = intervals_;
  picture.surfaces = surfaces_;
  picture.lighting = lighting_ ? &*lighting_ : nullptr;
  return picture;
}

Image CellProjector::draw(const Frame& frame, Stats& stats) {
  const base::Stopwatch clock;
  for (const auto& [effect, work] : set_up_.work) stats.add(effect, work.bytes, work.ms);
  set_up_.work.clear();
  stats.tables_ms += std::exchange(set_up_.tables_ms, 0);
  const Projection projection(frame, radius_, middle_);
  Picture shared = picture(frame, projection);
  points_.project(*scene_.mesh, cells_, frame, projection);
  const double projected = clock.milliseconds();
  order_cells(frame, stats);
  const base::Stopwatch binning;
  bins_.assign(cells_, points_, frame.width(), frame.height(), shared.tile_size, order_);
  stats.add(Effect::cells, bytes_of(points_.exact) + bytes_of(points_.screen) + bins_.bytes(),
            projected + binning.milliseconds());
  const std::vector<ViewedLight> lights =
      lighting_ ? lighting_->view(frame, projection) : std::vector<ViewedLight>{};
  shared.lights = lights;
  Image image;
  if (scene_.opaque.empty()) {
    image = draw_tiles(shared, stats);
  } else {
    const base::Stopwatch layering;
    const OpaqueLayers opaque(scene_.opaque, scene_.lights, frame, scene_.samples);
    stats.add(Effect::opaque, opaque.bytes(), layering.milliseconds());
    image = opaque.compose([&](RayEnds ends) {
      shared.ends = ends;
      return draw_tiles(shared, stats);
    });
  }
  stats.threads = tbb::this_task_arena::max_concurrency();
  stats.project_ms += clock.milliseconds();
  return image;
}

Image CellProjector::draw_tiles(const Picture& shared, Stats& stats) {
  const base::Stopwatch drawing;
  Image image(shared.frame->width(), shared.frame->height());
  const bool blends = plan_.sort != SortMethod::none;
  const std::vector<std::uint32_t> tiles = bins_.largest_first();
  struct Worker {
    TileBuffers buffers;
    TileOrder order;
    std::vector<std::uint32_t> kept;
    double order_ms = 0;
    std::uint64_t fragments = 0;
  };
  tbb::enumerable_thread_specific<Worker> workers;
  tbb::parallel_for(
      std::size_t{0}, tiles.size(),
      [&](std::size_t i) {
        base::throw_if_interrupted();
        const std::size_t tile = tiles[i];
        const Region region{static_cast<int>(tile % bins_.tiles_x()) * shared.tile_size,
                            static_cast<int>(tile / bins_.tiles_x()) * shared.tile_size,
                            shared.tile_size, shared.tile_size};
        Picture own = shared;
        own.image = &image;
        Worker& worker = workers.local();
        std::span<const std::uint32_t> cells = bins_.cells(tile);
        if (!shared.ends.empty()) {
          const TileEnds ends = tile_ends(shared.ends, image, region);
          if (ends.wanted.width == 0) return;
          if (ends.nearest == kInfinity) own.ends = {};
          keep_cells_in(ends.wanted, cells_, cells, worker.kept);
          cells = worker.kept;
        }
        if (blends && !shared.cells_in_order) {
          const base::Stopwatch ordering;
          cells = worker.order.front_to_back(cells, cells_, points_, region);
          worker.order_ms += ordering.milliseconds();
        }
        worker.fragments += draw_tile(own, region.x, region.y, cells, worker.buffers).fragments;
      },
      tbb::simple_partitioner());
  double order_ms = 0;
  for (const Worker& worker : workers) {
    stats.fragments += worker.fragments;
    if (blends) stats.add(Effect::order, worker.order.bytes() + worker.buffers.order_bytes());
    order_ms += worker.order_ms / static_cast<double>(workers.size());
    if (shared.projection->perspective) stats.add(Effect::rays, worker.buffers.ray_bytes());
    if (!scene_.clip.empty()) stats.add(Effect::clipping, worker.buffers.clip_bytes());
  }
  if (blends && !shared.cells_in_order) {
    stats.add(Effect::order, 0, order_ms);
    stats.sort_method = to_string(plan_.sort);
  }
  stats.add(Effect::segments, 0, drawing.milliseconds() - order_ms);
  return image;
}

}  // namespace tetraglass::project::cpu
