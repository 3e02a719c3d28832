#pragma once

#include <vector>

#include <Eigen/Core>

#include "project/gl/normalization.h"
#include "project/scene.h"

namespace tetraglass::project::gl {

/// Three texels a surface, ascending: what crossing.glsl reads. Of equal isovalues the first is the
/// nearer one on rays along which the field rises; they are one surface in all but name.
[[nodiscard]] std::vector<Eigen::Vector4f> surface_texels(const Scene& scene,
                                                          const Normalization& normalization);

/// The transfer function's material at a value: ambient, diffuse, specular, shininess.
[[nodiscard]] Eigen::Vector4f material_texel(const Scene& scene, double value);

}  // namespace tetraglass::project::gl
