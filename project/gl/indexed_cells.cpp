#include "project/gl/indexed_cells.h"

#include "project/gl/switches.h"

namespace tetraglass::project::gl {

namespace {

// Without an order the cells to draw are still told by their numbers, unless all are.
bool numbers_cells(const Scene& scene, const Plan& plan, std::size_t drawn) {
  return sorts_cells(plan) || drawn != scene.mesh->cells.size();
}

}  // namespace

bool IndexedCells::fit(const PartLimits& limits, const Scene& scene, const Plan& plan,
                       std::size_t drawn) {
  const std::size_t cells = scene.mesh->cells.size();
  const std::size_t points = scene.mesh->points.size();
  const std::size_t numbers =
      numbers_cells(scene, plan, drawn) ? drawn * texel_bytes(Texel::r32ui) : 0;
  return cells <= limits.cells && points <= limits.points &&
         cells * limits.cell_bytes + points * limits.point_bytes + numbers <= limits.bytes;
}

IndexedCells::IndexedCells(const Context& context, const Scene& scene, const Plan& plan,
                           const Normalization& normalization,
                           const std::vector<std::uint32_t>& drawn)
    : strip_(plan.gl.layout == Layout::strip),
      sorted_(sorts_cells(plan)),
      count_(drawn.size()),
      mesh_(context, scene, normalization, needs_vertex_gradients(scene, plan)),
      faces_(context, strip_) {
  mesh_.load();
  if (numbers_cells(scene, plan, drawn.size())) {
    order_.emplace(context, Texel::r32ui);
    if (!sorted_) order_->upload(drawn, "cells");
  }
}

std::vector<std::string> IndexedCells::switches() const {
  std::vector<std::string> names;
  if (order_) names.emplace_back("ORDERED");
  if (strip_) names.emplace_back("STRIP");
  return names;
}

void IndexedCells::set_uniforms(const Program& program) const {
  set_mesh_units(program);
  program.set("order", Units::kOrder);
}

void IndexedCells::set_order(const std::vector<std::uint32_t>& cells) {
  order_->upload(cells, "cells");
}

void IndexedCells::draw() {
  mesh_.bind();
  if (order_) order_->bind(Units::kOrder);
  faces_.draw(count_);
}

LayoutBytes IndexedCells::bytes() const {
  const std::size_t numbers = order_ ? order_->bytes() : 0;
  const std::size_t cells = mesh_.bytes() - mesh_.gradient_bytes() - mesh_.density_bytes();
  return {sorted_ ? cells : cells + numbers, sorted_ ? numbers : 0, mesh_.gradient_bytes(),
          mesh_.density_bytes()};
}

}  // namespace tetraglass::project::gl
