#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "project/image.h"
#include "project/scene.h"
#include "project/stats.h"

namespace tetraglass::project {

/// The judge of every other projector: double precision, one ray at a time, brute force over the
/// cells that a ray can meet, exact order, segments integrated to 1e-12 (preint::integrate_full).
/// Decides with exact predicates which faces a ray meets; rays through edges and vertices are
/// decided as if moved by an infinitesimal step to the right and up, so neighbouring cells never
/// disagree. A pixel for each sample.
[[nodiscard]] Image render_reference(const Scene& scene, Stats& stats);

/// Single pixels (x, y) of the scene's picture: RGBA each, the mean of their samples.
[[nodiscard]] std::vector<Eigen::Array4d> reference_pixels(const Scene& scene,
                                                           std::span<const Eigen::Vector2i> pixels);

}  // namespace tetraglass::project
