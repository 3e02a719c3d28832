#include "project/gl/gl_projector.h"

#include "project/gl/cell_projector.h"

namespace tetraglass::project {

Image render_gl(const Scene& scene, const Plan& plan, Stats& stats) {
  const Frame frame = make_frame(scene);
  const std::unique_ptr<gl::Context> context = gl::Context::create(plan.context);
  if (scene.drawable.cells.empty()) {
    stats.context = context->description();
    return {frame.width(), frame.height()};
  }
  gl::CellProjector projector(*context, scene, plan, stats);
  return projector.draw(frame, stats);
}

}  // namespace tetraglass::project
