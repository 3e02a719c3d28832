#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "project/light/light_sources.h"

namespace tetraglass::project {

/// Light by direction, on the six faces of a cube (meissner2002 section 3): what many lights send
/// is looked up instead of summed. Directions are those of the mesh's axes.
struct LightMap {
  int size = 0;  ///< texels each way of a face
  /// [face][row][column] of RGBA, A unused: faces, rows and columns as OpenGL's cube maps have
  /// them (OpenGL 4.5 core, Table 8.19: +x, -x, +y, -y, +z, -z).
  std::vector<float> rgba;

  [[nodiscard]] const float* texel(int face, int x, int y) const {
    return rgba.data() + 4 * ((std::size_t(face) * size + y) * std::size_t(size) + x);
  }
};

/// The direction, of unit length, in which the centre of a texel lies.
[[nodiscard]] Eigen::Vector3d texel_direction(int size, int face, int x, int y);

/// The sources as they look from `middle`: far away. What is near errs by its angle from elsewhere.
[[nodiscard]] std::vector<LightSource> seen_from(std::span<const LightSource> sources,
                                                 const Eigen::Vector3d& middle);

/// sum color max(0, n.l) by the normal n. All sources are far away.
[[nodiscard]] LightMap diffuse_map(std::span<const LightSource> sources, int size);

/// sum color max(0, r.l)^shininess by the direction r in which the viewer is reflected.
[[nodiscard]] LightMap specular_map(std::span<const LightSource> sources, double shininess,
                                    int size);

/// Texels each way of the diffuse map beside a specular one of `size`: light by cosines is smooth
/// (meissner2002 section 6: 16 beside 64).
[[nodiscard]] constexpr int diffuse_size(int size) {
  return size < 16 ? 4 : size / 4;
}

}  // namespace tetraglass::project
