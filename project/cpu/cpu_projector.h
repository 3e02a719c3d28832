#pragma once

#include "project/image.h"
#include "project/plan.h"
#include "project/scene.h"
#include "project/stats.h"

namespace tetraglass::project {

/// Draws the scene without GL, with all threads and the widest vectors of the machine
/// (cpu::CellProjector).
[[nodiscard]] Image render_cpu(const Scene& scene, const Plan& plan, Stats& stats);

}  // namespace tetraglass::project
