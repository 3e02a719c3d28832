#include "project/slices/slices_projector.h"

#include "project/slices/slice_projector.h"

namespace tetraglass::project {

Image render_slices(const Scene& scene, const Plan& plan, Stats& stats) {
  const Frame frame = make_frame(scene);
  const std::unique_ptr<gl::Context> context = gl::Context::create(plan.context);
  slices::SliceProjector projector(*context, scene, plan, stats);
  return projector.draw(frame, stats);
}

}  // namespace tetraglass::project
