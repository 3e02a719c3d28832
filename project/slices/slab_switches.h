#pragma once

#include <optional>
#include <string>
#include <vector>

#include "project/plan.h"
#include "project/scene.h"

namespace tetraglass::project::slices {

/// The switches (`#define`) that make of the slabs' shaders those that draw this scene, and nothing
/// that it does not ask for. `layers`: the axis of 2D textures; none for a 3D texture. `blocks`:
/// whether slabs are drawn block by block. The scene has a grid.
[[nodiscard]] std::vector<std::string> slab_switches(const Scene& scene, const Plan& plan,
                                                     bool parallel, std::optional<int> layers,
                                                     bool blocks);

/// Whether the points of an axis of the grid lie unevenly, and the shaders look them up.
[[nodiscard]] bool is_uneven(const mesh::RectilinearGrid& grid);

/// Whether the shaders compute gradients of the field.
[[nodiscard]] bool has_gradients(const Scene& scene);

/// Whether the shaders walk along the transfer function.
[[nodiscard]] bool slab_reads_medium(const Scene& scene, const Plan& plan);

}  // namespace tetraglass::project::slices
