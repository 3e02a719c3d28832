#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "project/cpu/drawn_cells.h"
#include "project/cpu/medium.h"
#include "project/cpu/view_points.h"
#include "project/light/light_sources.h"

namespace tetraglass::project::cpu {

/// A light in one view: coordinates of the camera (right, up, away) from the camera's axis at the
/// projection's depth of 0, in units of its radius.
struct ViewedLight {
  std::array<float, 3> place = {};  ///< or the unit vector towards it
  bool far_away = false;
  std::array<float, 3> color = {};
};

/// What lights the cells of a scene, whatever the view. Made only for scenes that are lit.
struct Lighting {
  Lighting(const Scene& scene, const DrawnCells& cells);

  /// Empty for a headlight.
  [[nodiscard]] std::vector<ViewedLight> view(const Frame& frame,
                                              const Projection& projection) const;

  Shading shading;
  bool has_cell_normals;
  /// Of each point or each drawn cell, in the mesh's axes, the largest component of all 1.
  std::vector<Eigen::Vector3d> gradients;
  bool is_headlight;
  std::array<float, 3> ambient = {1, 1, 1};
  std::vector<LightSource> sources;
  /// Of each interval of the medium (mode full).
  std::vector<MaterialInterval> materials;
  /// The scaled value of the largest extinction (Shading::surface): the lit surface.
  float surface_value = 0;
};

}  // namespace tetraglass::project::cpu
