#include "project/render.h"

#include "project/cpu/cpu_projector.h"
#include "project/gl/gl_projector.h"
#include "project/reference/reference.h"

namespace tetraglass::project {

Image render(const Scene& scene, const Plan& plan, Stats& stats) {
  switch (plan.projector) {
    case Projector::gl:
      return render_gl(scene, plan, stats);
    case Projector::cpu:
      return render_cpu(scene, plan, stats);
    case Projector::reference:
      return render_reference(scene, stats);
  }
  return {};
}

}  // namespace tetraglass::project
