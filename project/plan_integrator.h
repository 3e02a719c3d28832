#pragma once

#include "project/plan.h"
#include "project/scene.h"

namespace tetraglass::project {

/// Chooses the integrator, with the size of its table, of a plan whose projector is known, and
/// says why. Throws UsageError where the request contradicts the scene or the projector.
void plan_integrator(const Scene& scene, const Request& request, Plan& plan);

}  // namespace tetraglass::project
