#include "project/gl/surface_texels.h"

#include <algorithm>

namespace tetraglass::project::gl {

Eigen::Vector4f material_texel(const Scene& scene, double value) {
  const preint::Material m = scene.transfer_function.material_at(value);
  return Eigen::Vector4d(m.ambient, m.diffuse, m.specular, m.shininess).cast<float>();
}

std::vector<Eigen::Vector4f> surface_texels(const Scene& scene,
                                            const Normalization& normalization) {
  std::vector<preint::Isosurface> surfaces = scene.isosurfaces;
  std::stable_sort(surfaces.begin(), surfaces.end(),
                   [](const auto& a, const auto& b) { return a.value < b.value; });
  std::vector<Eigen::Vector4f> texels;
  for (const preint::Isosurface& surface : surfaces) {
    const Eigen::Vector3f color = surface.color.cast<float>().matrix();
    texels.emplace_back(normalization.values.isovalue_threshold(surface.value),
                        static_cast<float>(surface.opacity), normalization.value(surface.value),
                        0.0F);
    texels.emplace_back(color.x(), color.y(), color.z(), 0.0F);
    texels.push_back(material_texel(scene, surface.value));
  }
  return texels;
}

}  // namespace tetraglass::project::gl
