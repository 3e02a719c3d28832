#pragma once

#include "project/image.h"
#include "project/plan.h"
#include "project/scene.h"
#include "project/stats.h"

namespace tetraglass::project {

/// Draws the scene by the plan's projector and adds what it took to `stats`. Every projector gives
/// the same picture within the tolerance that the tests state. Throws UnavailableError where the
/// plan's context cannot be had, UsageError for a camera that sees nothing.
[[nodiscard]] Image render(const Scene& scene, const Plan& plan, Stats& stats);

/// Each pixel the mean of n x n samples.
[[nodiscard]] Image average(const Image& samples, int n);

}  // namespace tetraglass::project
