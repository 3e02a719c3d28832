#include "project/cpu/cpu_projector.h"

#include "project/cpu/cell_projector.h"

namespace tetraglass::project {

Image render_cpu(const Scene& scene, const Plan& plan, Stats& stats) {
  cpu::CellProjector projector(scene, plan);
  return projector.draw(make_frame(scene), stats);
}

}  // namespace tetraglass::project
