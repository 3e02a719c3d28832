#pragma once

#include "project/image.h"
#include "project/scene.h"

namespace tetraglass::apps {

/// A picture of mode thickness, which is in the mesh's units of length, scaled for 8 bits so that
/// the longest path is white; of other modes as it is.
[[nodiscard]] project::Image scaled_for_8_bits(const project::Image& image, project::Mode mode);

}  // namespace tetraglass::apps
