#include "project/gl/cell_layout.h"

#include "project/gl/faces12_cells.h"
#include "project/gl/indexed_cells.h"
#include "project/gl/indexed_parts.h"

namespace tetraglass::project::gl {

std::unique_ptr<CellLayout> make_cell_layout(const Context& context, const Scene& scene,
                                             const Plan& plan, const Normalization& normalization,
                                             const std::vector<std::uint32_t>& drawn) {
  if (has_faces12(plan.gl.layout)) {
    return std::make_unique<Faces12Cells>(context, scene, plan, normalization, drawn);
  }
  if (IndexedCells::fit(indexed_limits(context, scene, plan), scene, plan, drawn.size())) {
    return std::make_unique<IndexedCells>(context, scene, plan, normalization, drawn);
  }
  return std::make_unique<IndexedParts>(context, scene, plan, normalization, drawn);
}

}  // namespace tetraglass::project::gl
