#pragma once

#include <cstdint>
#include <vector>

#include "project/gl/normalization.h"
#include "project/scene.h"

namespace tetraglass::project::gl {

/// The drawable cells that can show anything: in mode iso those that a surface crosses, in full,
/// emission and absorption those with a value where the extinction is not 0, in the other modes
/// all. In the order of the mesh. Decided on the values as the context has them (normalized
/// floats).
[[nodiscard]] std::vector<std::uint32_t> drawn_cells(const Scene& scene,
                                                     const Normalization& normalization);

}  // namespace tetraglass::project::gl
