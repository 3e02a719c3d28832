#pragma once

#include <string>
#include <vector>

#include "project/plan.h"
#include "project/scene.h"

/// What a scene calls for; everything else is left out of shaders, buffers and target.
namespace tetraglass::project::gl {

/// The `#define` of the mode.
[[nodiscard]] const char* mode_switch(const Scene& scene);

/// Mode iso with surfaces that hide what is behind them: the depth buffer stands for an order.
[[nodiscard]] bool draws_opaque_surfaces(const Scene& scene);

/// One number per pixel: length, optical depth or largest value.
[[nodiscard]] bool has_scalar_target(const Scene& scene);

/// Whether the fragment stage integrates the transfer function itself.
[[nodiscard]] bool reads_medium(const Scene& scene, const Plan& plan);

/// Whether segments of a medium are lit by tables weighted towards both of their ends (lum2004).
[[nodiscard]] bool has_ramped_light(const Scene& scene, const Plan& plan);

/// Whether segments of a medium are lit by means of its materials, and of where they are seen
/// (meissner2002 section 4).
[[nodiscard]] bool has_material_table(const Scene& scene);

/// The `#define`s of the shaders, but for those that the layout of the cells adds.
[[nodiscard]] std::vector<std::string> shader_switches(const Scene& scene, const Plan& plan,
                                                       bool parallel);

}  // namespace tetraglass::project::gl
