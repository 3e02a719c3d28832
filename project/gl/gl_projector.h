#pragma once

#include "project/image.h"
#include "project/plan.h"
#include "project/scene.h"
#include "project/stats.h"

namespace tetraglass::project {

/// Weiler's cell projection in its indexed form: four generated vertices a cell, back faces, exit
/// point by barycentric ray parameters (weiler2002 sections 3 and 4; DESIGN section 3), in float on
/// an off-screen OpenGL context. Throws UnavailableError where no context can be had, with the
/// reason.
[[nodiscard]] Image render_gl(const Scene& scene, const Plan& plan, Stats& stats);

}  // namespace tetraglass::project
