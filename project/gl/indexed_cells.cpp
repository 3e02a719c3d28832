#include "project/gl/indexed_cells.h"

#include "project/gl/switches.h"

namespace tetraglass::project::gl {

IndexedCells::IndexedCells(const Context& context, const Scene& scene, const Plan& plan,
                           const Normalization& normalization,
                           const std::vector<std::uint32_t>& drawn)
    : strip_(plan.gl.layout == Layout::strip),
      sorted_(sorts_cells(plan)),
      count_(drawn.size()),
      mesh_(context, scene, normalization, plan.gradients && !has_cell_normals(scene)),
      faces_(context, strip_) {
  // Without an order the cells to draw are still told by their numbers, unless all are.
  if (sorted_ || drawn.size() != scene.mesh->cells.size()) {
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
  program.set("cells", Units::kCells);
  program.set("vertices", Units::kVertices);
  program.set("order", Units::kOrder);
  program.set("cell_values", Units::kCellValues);
  program.set("gradients", Units::kGradients);
}

void IndexedCells::set_order(const std::vector<std::uint32_t>& cells) {
  order_->upload(cells, "cells");
}

void IndexedCells::draw() const {
  mesh_.bind();
  if (order_) order_->bind(Units::kOrder);
  faces_.draw(count_);
}

LayoutBytes IndexedCells::bytes() const {
  const std::size_t numbers = order_ ? order_->bytes() : 0;
  const std::size_t cells = mesh_.bytes() - mesh_.gradient_bytes();
  return {sorted_ ? cells : cells + numbers, sorted_ ? numbers : 0, mesh_.gradient_bytes()};
}

}  // namespace tetraglass::project::gl
