#pragma once

#include "project/gl/normalization.h"
#include "project/gl/objects.h"
#include "project/gl/view_uniforms.h"
#include "project/gl_plan.h"
#include "project/image.h"
#include "project/scene.h"

namespace tetraglass::project::gl {

/// What the target is made of: one number a pixel where the mode has no more.
[[nodiscard]] Texel target_texel(const Scene& scene, TargetFormat format);

/// What a pixel of the target holds that no cell has touched.
[[nodiscard]] float empty_pixel(const Scene& scene);

/// Reads the tile from the target into its place in the picture, as the mode defines the picture
/// (DESIGN section 2): lengths in world units, opacity of the optical depth, color of the largest
/// value. All numbers finite.
void read_tile(const Target& target, const Scene& scene, const Normalization& normalization,
               const Tile& tile, Image& image);

}  // namespace tetraglass::project::gl
