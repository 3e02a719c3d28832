#pragma once

#include "preint/transfer_function.h"

namespace tetraglass::project {

/// Where Shading::surface lights a segment: the value of the largest extinction, the middle of the
/// first run of control points that have it.
[[nodiscard]] double surface_value(const preint::TransferFunction& tf);

}  // namespace tetraglass::project
