#pragma once

#include <cstdint>
#include <vector>

#include "project/scene.h"
#include "project/value_scale.h"

namespace tetraglass::project {

/// The drawable cells that can show anything: in mode iso those that a surface crosses, in full,
/// emission and absorption those with a value where the extinction is not 0, in the other modes
/// all. In the order of the mesh. Surfaces are decided on the values as projectors have them
/// (`scale`).
[[nodiscard]] std::vector<std::uint32_t> shown_cells(const Scene& scene, const ValueScale& scale);

}  // namespace tetraglass::project
