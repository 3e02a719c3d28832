#include "project/cpu/surfaces.h"

#include <algorithm>

namespace tetraglass::project::cpu {

std::vector<Surface> surfaces(const Scene& scene, const DrawnCells& cells) {
  std::vector<Surface> result;
  for (const preint::Isosurface& surface : scene.isosurfaces) {
    const Eigen::Array3f color = surface.color.cast<float>();
    result.push_back({cells.scale.scaled(surface.value),
                      cells.scale.isovalue_threshold(surface.value),
                      static_cast<float>(surface.opacity),
                      {color[0], color[1], color[2]},
                      scene.transfer_function.material_at(surface.value)});
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const Surface& a, const Surface& b) { return a.value < b.value; });
  return result;
}

}  // namespace tetraglass::project::cpu
