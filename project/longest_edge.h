#pragma once

#include "project/scene.h"

namespace tetraglass::project {

/// The longest edge of a drawable cell: no ray is longer within one. Cost: linear in the cells.
[[nodiscard]] double longest_edge(const Scene& scene);

}  // namespace tetraglass::project
