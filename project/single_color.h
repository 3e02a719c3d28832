#pragma once

#include <optional>

#include "project/scene.h"

namespace tetraglass::project {

/// The color of all light of a medium (mode full) whose transfer function has one only, wherever
/// the field's values take any light at all; black where they take none. Then the picture is that
/// color times 1 - exp(-optical depth), whatever the order of the cells. None in other modes, where
/// the medium is lit, and where colors differ.
[[nodiscard]] std::optional<preint::Color> single_color(const Scene& scene);

}  // namespace tetraglass::project
