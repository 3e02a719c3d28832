#include "project/gl/surface_texels.h"

#include <algorithm>

namespace tetraglass::project::gl {

std::vector<Eigen::Vector4f> surface_texels(const Scene& scene,
                                            const Normalization& normalization) {
  std::vector<preint::Isosurface> surfaces = scene.isosurfaces;
  std::stable_sort(surfaces.begin(), surfaces.end(),
                   [](const auto& a, const auto& b) { return a.value < b.value; });
  std::vector<Eigen::Vector4f> texels;
  for (const preint::Isosurface& surface : surfaces) {
    const Eigen::Vector3f color = surface.color.cast<float>().matrix();
    texels.emplace_back(normalization.value(surface.value), static_cast<float>(surface.opacity),
                        0.0F, 0.0F);
    texels.emplace_back(color.x(), color.y(), color.z(), 0.0F);
  }
  return texels;
}

}  // namespace tetraglass::project::gl
