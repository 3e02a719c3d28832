#include "project/cpu/surfaces.h"

#include <algorithm>

#include "mesh/gradients.h"

namespace tetraglass::project::cpu {

Surfaces::Surfaces(const Scene& scene, const DrawnCells& cells) : shading(scene.shading) {
  for (const preint::Isosurface& surface : scene.isosurfaces) {
    const Eigen::Array3f color = surface.color.cast<float>();
    surfaces.push_back({cells.scale.scaled(surface.value),
                        static_cast<float>(surface.opacity),
                        {color[0], color[1], color[2]}});
  }
  if (shading == Shading::smooth) {
    gradients = mesh::vertex_gradients(*scene.mesh, scene.field);
  } else if (shading == Shading::flat) {
    const std::vector<Eigen::Vector3d> all = mesh::cell_gradients(*scene.mesh, scene.field);
    for (const std::uint32_t cell : cells.numbers) gradients.push_back(all[cell]);
  }
  // Only directions matter, and floats have to hold their squares.
  double largest = 0;
  for (const Eigen::Vector3d& gradient : gradients) {
    largest = std::max(largest, gradient.cwiseAbs().maxCoeff());
  }
  if (!(largest > 0)) return;
  for (Eigen::Vector3d& gradient : gradients) gradient /= largest;
}

}  // namespace tetraglass::project::cpu
