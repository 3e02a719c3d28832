#pragma once

#include "project/plan.h"

namespace tetraglass::project {

/// Cube maps are made in a moment up to this size.
inline constexpr int kLargestLightMap = 2048;

/// Whether all control points have the same material.
[[nodiscard]] bool has_one_material(const preint::TransferFunction& tf);

/// The light's part of a plan whose projector is chosen: gradients only where something is shaded.
/// `light_map`: texels each way of cube maps (light_maps.h), 0 for none. Throws UsageError for what
/// the mode or the projector lacks.
void plan_light(const Scene& scene, int light_map, Plan& plan);

}  // namespace tetraglass::project
