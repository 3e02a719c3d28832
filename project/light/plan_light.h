#pragma once

#include "project/plan.h"

namespace tetraglass::project {

/// The light's part of a plan whose projector is chosen: gradients only where something is shaded.
/// Throws UsageError for what the mode or the projector lacks.
void plan_light(const Scene& scene, Plan& plan);

}  // namespace tetraglass::project
