#include "project/gl/indexed_parts.h"

#include <algorithm>
#include <limits>

#include "project/gl/functions.inl"
#include "project/gl/indexed_cells.h"

namespace tetraglass::project::gl {

PartLimits indexed_limits(const Context& context, const Scene& scene, const Plan& plan) {
  // Vertices, 4 or 6 a cell, are numbered in an int; the top bit of a point's number is taken.
  constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();
  const std::size_t texels = context.limits().texture_buffer_texels;
  PartLimits limits;
  limits.bytes = plan.gl.memory > 0 ? plan.gl.memory : std::numeric_limits<std::size_t>::max();
  limits.cells = std::min(texels, kMost / (plan.gl.layout == Layout::strip ? 6 : 4));
  limits.points = std::min(texels, kMost);
  limits.cell_bytes = MeshBuffers::cell_bytes(scene);
  limits.point_bytes = MeshBuffers::point_bytes(needs_vertex_gradients(scene, plan));
  return limits;
}

IndexedParts::IndexedParts(const Context& context, const Scene& scene, const Plan& plan,
                           const Normalization& normalization,
                           const std::vector<std::uint32_t>& drawn)
    : context_(context),
      strip_(plan.gl.layout == Layout::strip),
      cells_(drawn),
      cutter_(*scene.mesh, indexed_limits(context, scene, plan)),
      mesh_(context, scene, normalization, needs_vertex_gradients(scene, plan)),
      faces_(context, strip_) {}

std::vector<std::string> IndexedParts::switches() const {
  return strip_ ? std::vector<std::string>{"STRIP"} : std::vector<std::string>{};
}

void IndexedParts::set_uniforms(const Program& program) const {
  set_mesh_units(program);
}

void IndexedParts::draw() {
  parts_ = 0;
  for (std::size_t first = 0; first < cells_.size(); ++parts_) {
    const std::span<const std::uint32_t> rest = std::span(cells_).subspan(first);
    const std::size_t count = cutter_.next(rest);
    // What is still drawn from would be kept beside what takes its place.
    context_.gl().Finish();
    mesh_.load(rest.first(count), cutter_);
    mesh_.bind();
    faces_.draw(count);
    const LayoutBytes bytes{mesh_.bytes() - mesh_.gradient_bytes() - mesh_.density_bytes(), 0,
                            mesh_.gradient_bytes(), mesh_.density_bytes()};
    if (bytes.sum() > most_.sum()) most_ = bytes;
    first += count;
  }
}

}  // namespace tetraglass::project::gl
