#include "project/slices/slice_projector.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "base/stopwatch.h"
#include "project/gl/functions.inl"
#include "project/gl/mesh_buffers.h"
#include "project/gl/surface_texels.h"
#include "project/gl/switches.h"
#include "project/gl/target_image.h"
#include "project/light/surface_value.h"
#include "project/slices/slab_switches.h"
#include "project/slices/slab_triangles.h"

namespace tetraglass::project::slices {
namespace {

// Of the samplers of the slabs' shaders that those of the cells do not have.
constexpr int kGridUnit = gl::Units::kCells;
constexpr int kPointsUnit = gl::Units::kVertices;

// Blocks farther off than this would have to be looked at for every one.
constexpr int kFarthestReach = 2 * BlockRanges::kSide;

std::vector<float> places_of_points(const mesh::RectilinearGrid& grid) {
  std::vector<float> places;
  for (const std::vector<double>& row : grid.coordinates) {
    for (const double at : row) places.push_back(static_cast<float>(2 * at / row.back() - 1));
  }
  return places;
}

/// Whether anything of the values [least, most] can be seen.
bool shows(const Scene& scene, const SlicesPlan& plan, double least, double most) {
  // Rounded values, and those between them, may leave the range by a step.
  if (plan.texels != TexelBits::floats) {
    const double step = (scene.field.max - scene.field.min) / 255;
    least -= step;
    most += step;
  }
  switch (scene.mode) {
    case Mode::full:
    case Mode::emission:
    case Mode::absorption:
      return scene.transfer_function.max_extinction(least, most) > 0;
    case Mode::iso:
      return std::ranges::any_of(scene.isosurfaces, [&](const preint::Isosurface& surface) {
        return surface.value >= least && surface.value <= most;
      });
    case Mode::mip:
    case Mode::thickness:
      break;
  }
  return true;
}

double volume(const std::vector<Block>& blocks) {
  double sum = 0;
  for (const Block& block : blocks) sum += (block.high - block.low).cast<double>().prod();
  return sum;
}

bool same(const Block& a, const Block& b) {
  return a.low == b.low && a.high == b.high;
}

}  // namespace

SliceProjector::SliceProjector(const gl::Context& context, const Scene& scene, const Plan& plan,
                               Stats& stats, int largest_tile)
    : context_(context),
      scene_(scene),
      plan_(plan),
      largest_tile_(std::min(largest_tile, context.limits().tile)),
      normalization_(scene),
      ranges_(*scene.grid, scene.field.values),
      tables_(context, scene, plan_, normalization_),
      lights_(context, scene, plan),
      counter_(context) {
  const base::Stopwatch clock;
  if (slab_reads_medium(scene, plan)) {
    medium_.emplace(context, scene.transfer_function, normalization_);
  }
  if (scene.mode == Mode::iso) {
    surfaces_.emplace(context, gl::Texel::rgba32f);
    surfaces_->upload(gl::surface_texels(scene, normalization_), "isosurfaces");
  }
  if (is_uneven(*scene.grid)) {
    points_.emplace(context, gl::Texel::r32f);
    points_->upload(places_of_points(*scene.grid), "points of the grid's axes");
  }
  stats.tables_ms += clock.milliseconds();
}

std::size_t SliceProjector::bytes() const {
  std::size_t sum = 0;
  for (const auto& [axis, texture] : textures_) sum += texture.bytes();
  return sum;
}

std::optional<int> SliceProjector::layers(const GridView& view) const {
  if (plan_.slices.stack != Stack::textures) return std::nullopt;
  return view.stack_axis();
}

double SliceProjector::nominal_length(std::optional<int> layers) const {
  if (plan_.slices.distance > 0) return plan_.slices.distance / normalization_.radius;
  const mesh::RectilinearGrid& grid = *scene_.grid;
  const auto axis = static_cast<std::size_t>(layers.value_or(0));
  const double step = grid.coordinates[axis].back() / static_cast<double>(grid.size(axis) - 1);
  const Eigen::Matrix3d inverse = grid.axes.inverse();
  return step / inverse.row(static_cast<Eigen::Index>(axis)).norm() / normalization_.radius;
}

const GridTexture& SliceProjector::texture(std::optional<int> layers) {
  const int key = layers.value_or(-1);
  const auto found = textures_.find(key);
  if (found != textures_.end()) return found->second;
  const Block all = whole_grid(*scene_.grid);
  GridTexture& made =
      textures_.try_emplace(key, context_, scene_, plan_.slices, points_of(all), layers)
          .first->second;
  made.load(all, nominal_length(layers) * normalization_.radius);
  return made;
}

GridTexture& SliceProjector::brick_texture(const std::vector<DrawnBrick>& bricks) {
  Eigen::Vector3i room = Eigen::Vector3i::Zero();
  for (const DrawnBrick& brick : bricks) room = room.cwiseMax(points_of(brick.points));
  if (!brick_texture_ || brick_texture_->room() != room) {
    brick_texture_.reset();  // never two
    brick_texture_.emplace(context_, scene_, plan_.slices, room, std::nullopt);
  }
  return *brick_texture_;
}

const gl::Program& SliceProjector::program(bool parallel, std::optional<int> layers, bool blocks) {
  const std::vector<std::string> names = slab_switches(scene_, plan_, parallel, layers, blocks);
  std::string purpose;
  for (const std::string& name : names) purpose += name + ' ';
  if (const auto found = programs_.find(purpose); found != programs_.end()) return found->second;
  const gl::Program& program =
      programs_
          .try_emplace(purpose, context_, gl::shader_source("slab.vert.glsl", names),
                       gl::shader_source("slab.frag.glsl", names))
          .first->second;
  program.set("medium_pieces", gl::Units::kMediumPieces);
  program.set("medium_index", gl::Units::kMediumIndex);
  SlabTables::set_uniforms(program);
  program.set("surfaces", gl::Units::kSurfaces);
  program.set("surface_count", static_cast<int>(scene_.isosurfaces.size()));
  program.set("grid_points", kPointsUnit);
  lights_.set_uniforms(program);
  // Of a medium there is one, or one shininess (plan_light).
  program.set("material", gl::material_texel(scene_, scene_.transfer_function.points()[0].value));
  program.set("lit_value", normalization_.value(surface_value(scene_.transfer_function)));
  if (scene_.modulation) program.set("modulation", gl::modulation_factor(scene_, normalization_));
  const Eigen::Vector3i last = whole_grid(*scene_.grid).high;
  program.set("last_point", Eigen::Vector3f(last.cast<float>()));
  return program;
}

std::optional<Eigen::Vector3i> SliceProjector::reach(const GridView& view) const {
  if (plan_.slices.classify != Classify::integrated) return Eigen::Vector3i::Zero();
  if (plan_.slices.stack == Stack::textures) return std::nullopt;
  const double half = 0.5 * nominal_length({}) * view.most_stretch();
  Eigen::Vector3i result;
  for (int k = 0; k < 3; ++k) {
    const std::vector<double>& row = scene_.grid->coordinates[static_cast<std::size_t>(k)];
    double closest = row.back();
    for (std::size_t i = 0; i + 1 < row.size(); ++i) {
      closest = std::min(closest, row[i + 1] - row[i]);
    }
    const double points = std::ceil(half * view.steepest()[k] * 0.5 * row.back() / closest);
    result[k] = static_cast<int>(std::min(points, static_cast<double>(row.size())));
  }
  return result;
}

std::vector<Brick> SliceProjector::bricks(const GridView& view,
                                          const std::optional<Eigen::Vector3i>& reach) const {
  const Block all = whole_grid(*scene_.grid);
  const Eigen::Vector3i size = all.high + Eigen::Vector3i::Ones();
  const bool fits =
      plan_.slices.stack == Stack::textures || size.maxCoeff() <= context_.limits().table_3d;
  if (plan_.slices.brick_bytes == 0 && fits) return {{all, all}};
  const std::size_t most = plan_.slices.brick_bytes > 0
                               ? plan_.slices.brick_bytes / bytes_per_point(plan_.slices)
                               : std::numeric_limits<std::size_t>::max();
  // A gradient is that between the points beside it.
  const Eigen::Vector3i border = reach.value_or(Eigen::Vector3i::Zero()) +
                                 Eigen::Vector3i::Constant(has_gradients(scene_) ? 1 : 0);
  std::vector<Brick> result = make_bricks(*scene_.grid, border, most, context_.limits().table_3d);
  order_bricks(result, *scene_.grid, view);
  return result;
}

std::vector<Block> SliceProjector::shown(const Block& voxels,
                                         const std::optional<Eigen::Vector3i>& reach) const {
  if (!plan_.slices.skip_empty || !reach || reach->maxCoeff() > kFarthestReach) return {voxels};
  std::vector<Block> blocks = ranges_.shown(voxels, *reach, [&](double least, double most) {
    return shows(scene_, plan_.slices, least, most);
  });
  // The outlines of many blocks cost more than the fragments of a few: together then.
  constexpr double kMostShown = 0.6;
  if (blocks.empty() || volume(blocks) <= kMostShown * volume({voxels})) return blocks;
  Block around = blocks[0];
  for (const Block& block : blocks) {
    around = {around.low.cwiseMin(block.low), around.high.cwiseMax(block.high)};
  }
  return {around};
}

void SliceProjector::set_blending() const {
  const gl::Functions& gl = context_.gl();
  gl.Disable(GL_DEPTH_TEST);
  gl.Disable(GL_CULL_FACE);
  gl.Enable(GL_BLEND);
  const bool over = scene_.mode == Mode::full || scene_.mode == Mode::iso;
  gl.BlendEquation(scene_.mode == Mode::mip ? GL_MAX : GL_FUNC_ADD);
  gl.BlendFunc(GL_ONE, over ? GL_ONE_MINUS_SRC_ALPHA : GL_ONE);
}

void SliceProjector::draw_tile(const GridView& view, const std::vector<Slab>& slabs,
                               const std::vector<DrawnBrick>& bricks,
                               const gl::ViewUniforms& uniforms, const gl::Tile& tile) {
  const std::optional<int> axis = layers(view);
  const Block all = whole_grid(*scene_.grid);
  GridTexture* part = nullptr;
  for (const DrawnBrick& brick : bricks) {
    const gl::Program& shaders =
        program(view.parallel(), axis, brick.blocks.size() > 1 || !same(brick.blocks[0], all));
    uniforms.set(shaders, tile, context_.limits().subpixel_bits);
    view.set(shaders);
    const double length = nominal_length(axis);
    shaders.set("nominal_inverse", static_cast<float>(1 / length));
    if (same(brick.points, all)) {
      texture(axis).bind(shaders, kGridUnit);
    } else {
      if (part == nullptr) part = &brick_texture(bricks);
      part->load(brick.points, length * normalization_.radius);
      part->bind(shaders, kGridUnit);
    }
    draw_slabs(context_, shaders, view, *scene_.grid, slabs, brick.blocks, axis, tile);
  }
}

Image SliceProjector::draw(const Frame& frame, Stats& stats) {
  const base::Stopwatch clock;
  const double tables_before = stats.tables_ms;
  stats.context = context_.description();
  Image image(frame.width(), frame.height());
  const gl::ViewUniforms uniforms(frame, normalization_, scene_);
  const GridView view(scene_, normalization_, frame, uniforms.focus());
  const std::optional<Eigen::Vector3i> reach = this->reach(view);
  std::vector<DrawnBrick> drawn;
  for (const Brick& brick : bricks(view, reach)) {
    std::vector<Block> blocks = shown(brick.voxels, reach);
    if (!blocks.empty()) drawn.push_back({brick.points, std::move(blocks)});
  }
  if (uniforms.sees_mesh() && !drawn.empty()) {
    const double length = nominal_length(layers(view));
    const std::vector<Slab> slabs =
        make_slabs(view, *scene_.grid, plan_.slices.stack, plan_.slices.distance > 0 ? length : 0);
    tables_.make(length, stats);
    lights_.place(frame, uniforms, normalization_.radius);
    if (medium_) medium_->bind();
    if (surfaces_) surfaces_->bind(gl::Units::kSurfaces);
    if (points_) points_->bind(kPointsUnit);
    tables_.bind();
    const int width = std::min(frame.width(), largest_tile_);
    const int height = std::min(frame.height(), largest_tile_);
    const gl::Target target(context_, gl::target_texel(scene_, TargetFormat::rgba32f), false, width,
                            height);
    set_blending();
    for (int y = 0; y < frame.height(); y += height) {
      for (int x = 0; x < frame.width(); x += width) {
        const gl::Tile tile{x, y, std::min(width, frame.width() - x),
                            std::min(height, frame.height() - y)};
        target.begin(gl::empty_pixel(scene_), tile.width, tile.height);
        counter_.begin();
        draw_tile(view, slabs, drawn, uniforms, tile);
        counter_.end();
        stats.fragments += counter_.count();
        gl::read_tile(target, scene_, normalization_, tile, image);
      }
    }
    context_.gl().Finish();
    context_.check("drawing slices");
  }
  stats.project_ms += clock.milliseconds() - (stats.tables_ms - tables_before);
  return image;
}

}  // namespace tetraglass::project::slices
