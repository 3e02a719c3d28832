#include "project/cpu/cpu_projector.h"

#include "project/cpu/cell_projector.h"

namespace tetraglass::project {

Image render_cpu(const Scene& scene, const Plan& plan, Stats& stats) {
  const Frame frame(scene.camera, scene.width, scene.height);
  cpu::CellProjector projector(scene, plan);
  return projector.draw(frame, stats);
}

}  // namespace tetraglass::project
