#pragma once

#include "project/image.h"
#include "project/plan.h"
#include "project/scene.h"
#include "project/stats.h"

namespace tetraglass::project {

/// Draws the trilinear field of the scene's grid by slices: each of them stands for the slab around
/// it, cut exactly at the grid's faces (wilson1994, meissner2002 section 2, lum2004), in float on
/// an off-screen OpenGL context. Throws UnavailableError where no context can be had or the grid
/// does not fit, with the reason.
[[nodiscard]] Image render_slices(const Scene& scene, const Plan& plan, Stats& stats);

}  // namespace tetraglass::project
