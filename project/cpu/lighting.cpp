#include "project/cpu/lighting.h"

#include <algorithm>

#include "mesh/gradients.h"
#include "project/light/surface_value.h"

namespace tetraglass::project::cpu {

Lighting::Lighting(const Scene& scene, const DrawnCells& cells)
    : shading(scene.shading),
      has_cell_normals(project::has_cell_normals(scene)),
      is_headlight(!scene.lights.has_value()) {
  if (has_cell_normals) {
    const std::vector<Eigen::Vector3d> all = mesh::cell_gradients(*scene.mesh, scene.field);
    for (const std::uint32_t cell : cells.numbers) gradients.push_back(all[cell]);
  } else {
    gradients = mesh::vertex_gradients(*scene.mesh, scene.field);
  }
  // Only directions matter, and floats have to hold their squares.
  double largest = 0;
  for (const Eigen::Vector3d& gradient : gradients) {
    largest = std::max(largest, gradient.cwiseAbs().maxCoeff());
  }
  if (largest > 0) {
    for (Eigen::Vector3d& gradient : gradients) gradient /= largest;
  }
  const preint::TransferFunction& tf = scene.transfer_function;
  if (scene.mode == Mode::full) {
    materials = material_intervals(tf, cells.scale);
    surface_value = cells.scale.scaled(project::surface_value(tf));
  }
  if (is_headlight) return;
  for (std::size_t c = 0; c < 3; ++c) {
    ambient[c] = static_cast<float>(scene.lights->ambient[static_cast<Eigen::Index>(c)]);
  }
  sources = light_sources(*scene.lights, mesh::bounds(*scene.mesh), tf);
}

std::vector<ViewedLight> Lighting::view(const Frame& frame, const Projection& projection) const {
  std::vector<ViewedLight> result;
  const double start = projection.perspective ? projection.middle_depth * projection.radius
                                              : projection.depth_offset;
  for (const LightSource& source : sources) {
    const LightSource seen = viewed(source, frame, start, projection.radius);
    ViewedLight light;
    light.far_away = source.far_away;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto i = static_cast<Eigen::Index>(c);
      light.place[c] = static_cast<float>(seen.place[i]);
      light.color[c] = static_cast<float>(seen.color[i]);
    }
    result.push_back(light);
  }
  return result;
}

}  // namespace tetraglass::project::cpu
