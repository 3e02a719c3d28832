#pragma once

#include "apps/render_arguments.h"
#include "project/image.h"

namespace tetraglass::apps {

/// A picture of mode thickness, which is in the mesh's units of length, scaled for 8 bits so that
/// the longest path is white; of other modes as it is.
[[nodiscard]] project::Image scaled_for_8_bits(const project::Image& image, project::Mode mode);

/// Writes the picture to all of the arguments' outputs over their background; tells on stderr what
/// 8 bits cannot hold. Throws WriteError.
void write_pictures(const RenderArguments& arguments, project::Mode mode,
                    const project::Image& image);

}  // namespace tetraglass::apps
