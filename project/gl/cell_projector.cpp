#include "project/gl/cell_projector.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "base/stopwatch.h"
#include "project/gl/functions.inl"
#include "project/gl/surface_texels.h"
#include "project/gl/switches.h"
#include "project/gl/target_image.h"
#include "project/light/surface_value.h"
#include "project/shown_cells.h"

namespace tetraglass::project::gl {

CellProjector::CellProjector(const Context& context, const Scene& scene, const Plan& plan,
                             Stats& stats, int largest_tile, std::size_t most_fragments,
                             Gradients gradients)
    : context_(context),
      scene_(scene),
      plan_(plan),
      largest_tile_(std::min(largest_tile, context.limits().tile)),
      most_fragments_(most_fragments),
      gradients_(gradients),
      normalization_(scene),
      drawn_(shown_cells(scene, normalization_.values)),
      cells_(make_cell_layout(context, scene, plan, normalization_, drawn_)),
      lights_(context, scene, plan),
      tables_(context, scene, plan, normalization_, stats),
      counter_(context) {
  add_cell_bytes(stats);
  if (reads_medium(scene, plan)) {
    medium_.emplace(context, scene.transfer_function, normalization_);
    stats.add(Effect::medium, medium_->bytes());
  }
  if (scene.mode == Mode::iso && plan.integrator == Integrator::exact) {
    surfaces_.emplace(context, Texel::rgba32f);
    surfaces_->upload(surface_texels(scene, normalization_), "isosurfaces");
  }
}

void CellProjector::add_cell_bytes(Stats& stats) const {
  const LayoutBytes bytes = cells_->bytes();
  stats.add(Effect::cells, bytes.cells);
  if (bytes.gradients > 0) stats.add(Effect::gradients, bytes.gradients);
  if (bytes.densities > 0) stats.add(Effect::modulation, bytes.densities);
}

const Program& CellProjector::program(bool parallel, const std::string& pass) {
  const std::string purpose =
      (parallel ? "parallel " : "perspective ") + pass + (ends_.empty() ? "" : " with ends");
  if (const auto found = programs_.find(purpose); found != programs_.end()) return found->second;
  std::vector<std::string> names = shader_switches(scene_, plan_, parallel);
  for (std::string& name : cells_->switches()) names.push_back(std::move(name));
  if (!pass.empty()) names.push_back(pass);
  if (gradients_ == Gradients::of_unit_vertices) names.emplace_back("UNIT_VERTICES");
  if (!ends_.empty()) names.emplace_back("RAY_ENDS");
  const Program& program =
      programs_
          .try_emplace(purpose, context_, shader_source(cells_->vertex_shader(), names),
                       shader_source("cell.frag.glsl", names))
          .first->second;
  cells_->set_uniforms(program);
  program.set("medium_pieces", Units::kMediumPieces);
  program.set("medium_index", Units::kMediumIndex);
  tables_.set_uniforms(program);
  program.set("surfaces", Units::kSurfaces);
  program.set("surface_count", static_cast<int>(scene_.isosurfaces.size()));
  program.set("ray_ends", Units::kRayEnds);
  lights_.set_uniforms(program);
  // Of a medium there is one (plan_light).
  const double value = scene_.isosurfaces.empty() ? scene_.transfer_function.points()[0].value
                                                  : scene_.isosurfaces[0].value;
  program.set("material", material_texel(scene_, value));
  program.set("lit_value", normalization_.value(surface_value(scene_.transfer_function)));
  return program;
}

bool CellProjector::order_cells(const Frame& frame, Stats& stats) {
  if (!sorts_cells(plan_)) return true;
  const base::Stopwatch clock;
  if (!sorter_) sorter_.emplace(plan_.sort, *scene_.mesh, scene_.drawable.cells);
  const sort::Order& order = sorter_->sort(frame.view());
  if (drawn_.size() < order.cells.size()) {
    // Sorted with the rest: what is not drawn still tells which of two others lies behind.
    std::vector<char> shows(scene_.mesh->cells.size(), 0);
    for (const std::uint32_t cell : drawn_) shows[cell] = 1;
    std::vector<std::uint32_t> cells;
    cells.reserve(drawn_.size());
    std::copy_if(order.cells.begin(), order.cells.end(), std::back_inserter(cells),
                 [&](std::uint32_t cell) { return shows[cell] != 0; });
    cells_->set_order(cells);
  } else {
    cells_->set_order(order.cells);
  }
  stats.sort_method = order.method;
  stats.sort_exact = order.exact;
  stats.cycles += order.cycles;
  stats.sort_ms += clock.milliseconds();
  stats.add(Effect::order, cells_->bytes().order, clock.milliseconds());
  return order.exact;
}

void CellProjector::bind() const {
  if (medium_) medium_->bind();
  if (surfaces_) surfaces_->bind(Units::kSurfaces);
  tables_.bind();
}

void CellProjector::set_blending() const {
  const Functions& gl = context_.gl();
  const bool opaque = draws_opaque_surfaces(scene_);
  (opaque ? gl.Disable : gl.Enable)(GL_BLEND);
  // Cells have the depth 1/2 where surfaces do not tell theirs.
  (opaque || !ends_.empty() ? gl.Enable : gl.Disable)(GL_DEPTH_TEST);
  gl.DepthFunc(GL_LESS);
  gl.DepthMask(opaque ? GL_TRUE : GL_FALSE);
  const bool over = scene_.mode == Mode::full || scene_.mode == Mode::iso;
  gl.BlendEquation(scene_.mode == Mode::mip ? GL_MAX : GL_FUNC_ADD);
  gl.BlendFunc(GL_ONE, over ? GL_ONE_MINUS_SRC_ALPHA : GL_ONE);
  // Of the outline's two covers that by the faces seen from behind is there even where the eye is
  // inside a cell. Counter-clockwise, since both the face and the picture's rows are turned.
  gl.Enable(GL_CULL_FACE);
  gl.CullFace(GL_BACK);
  gl.FrontFace(cells_->draws_front_faces() ? GL_CW : GL_CCW);
}

void CellProjector::draw_fragments(bool parallel, const ViewUniforms& view, const Tile& tile,
                                   Stats& stats) {
  const Program& counting = program(parallel, FragmentLists::kCountSwitch);
  const Program& gathering = program(parallel, FragmentLists::kGatherSwitch);
  for (const Program* each : {&counting, &gathering}) {
    view.set(*each, tile, context_.limits().subpixel_bits);
  }
  lists_->begin_counting();
  counting.use();
  cells_->draw();
  const std::vector<std::uint32_t> counts = lists_->counts(tile.width, tile.height);
  for (const Patch& patch :
       patches(counts, tile.width, lists_->most(), context_.limits().sorted_fragments)) {
    set_blending();
    lists_->begin_patch(patch, counts, tile.width);
    gathering.use();
    cells_->draw();
    lists_->resolve(patch);
    stats.fragments += patch.fragments;
  }
  context_.gl().ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  stats.sort_method = to_string(SortMethod::fragments);
  stats.sort_exact = true;
}

void CellProjector::draw_tile(bool parallel, const ViewUniforms& view, const Tile& tile,
                              const Target& target, Image& image, Stats& stats) {
  target.begin(empty_pixel(scene_), tile.width, tile.height);
  if (!ends_.empty()) target.set_depths(unwanted_, tile.width, tile.height);
  set_blending();
  if (by_fragments_) {
    draw_fragments(parallel, view, tile, stats);
  } else {
    const Program& shaders = program(parallel);
    view.set(shaders, tile, context_.limits().subpixel_bits);
    counter_.begin();
    shaders.use();
    cells_->draw();
    counter_.end();
    stats.fragments += counter_.count();
  }
  read_tile(target, scene_, normalization_, tile, image);
}

bool CellProjector::place_ends(const Frame& frame, const ViewUniforms& view, const Tile& tile) {
  tile_ends_.reset();
  if (ends_.empty()) return true;
  constexpr double kFar = 1e30;
  std::vector<float> depths;
  unwanted_.clear();
  bool any = false;
  for (int y = tile.y; y < tile.y + tile.height; ++y) {
    for (int x = tile.x; x < tile.x + tile.width; ++x) {
      const double end =
          ends_[static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width()) +
                static_cast<std::size_t>(x)];
      const bool wanted = end > -std::numeric_limits<double>::infinity();
      any = any || wanted;
      unwanted_.push_back(wanted ? 1.0F : 0.0F);
      depths.push_back(
          static_cast<float>(std::clamp(end / normalization_.radius - view.focus(), -kFar, kFar)));
    }
  }
  if (!any) return false;
  tile_ends_.emplace(context_, Texel::r32f, std::array<int, 3>{tile.width, tile.height, 0}, depths,
                     false);
  tile_ends_->bind(Units::kRayEnds);
  return true;
}

Image CellProjector::draw_rays(const Frame& frame, const ViewUniforms& view, RayEnds ends,
                               Stats& stats) {
  Image image(frame.width(), frame.height());
  if (drawn_.empty() || !view.sees_mesh()) return image;
  ends_ = ends;
  const int width = std::min(frame.width(), largest_tile_);
  const int height = std::min(frame.height(), largest_tile_);
  const Target target(context_, target_texel(scene_, plan_.gl.target),
                      draws_opaque_surfaces(scene_) || !ends.empty(), width, height);
  bind();
  lights_.place(frame, view, normalization_.radius);
  if (scene_.lights) stats.add(Effect::lights, lights_.bytes());
  if (by_fragments_ && !(lists_ && lists_->hold(width, height))) {
    lists_.emplace(context_, width, height, most_fragments_);
    stats.add(Effect::order, lists_->bytes());
  }
  for (int y = 0; y < frame.height(); y += height) {
    for (int x = 0; x < frame.width(); x += width) {
      const Tile tile{x, y, std::min(width, frame.width() - x),
                      std::min(height, frame.height() - y)};
      if (place_ends(frame, view, tile)) {
        draw_tile(frame.parallel(), view, tile, target, image, stats);
      }
    }
  }
  context_.gl().Finish();
  context_.check("drawing cells");
  ends_ = {};
  return image;
}

Image CellProjector::draw(const Frame& frame, Stats& stats) {
  const bool exact = order_cells(frame, stats);
  by_fragments_ = plan_.sort == SortMethod::fragments || (plan_.fragments_in_cycles && !exact);
  const base::Stopwatch clock;
  stats.context = context_.description();
  const ViewUniforms view(frame, normalization_, scene_);
  Image image;
  if (scene_.opaque.empty()) {
    image = draw_rays(frame, view, {}, stats);
  } else {
    const base::Stopwatch layering;
    const OpaqueLayers opaque(scene_.opaque, scene_.lights, frame, scene_.samples);
    stats.add(Effect::opaque, opaque.bytes(), layering.milliseconds());
    image = opaque.compose([&](RayEnds ends) { return draw_rays(frame, view, ends, stats); });
  }
  stats.parts = cells_->parts();
  if (!cells_told_ && stats.parts > 1) add_cell_bytes(stats);
  cells_told_ = true;
  stats.add(Effect::segments, 0, clock.milliseconds());
  stats.project_ms += clock.milliseconds();
  return image;
}

}  // namespace tetraglass::project::gl
