#pragma once

#include <Eigen/Core>

#include "project/scene.h"
#include "project/value_scale.h"

namespace tetraglass::project::gl {

/// How a scene's numbers become floats: points relative to the centre of the mesh's bounds in units
/// of half their diagonal, values so that the field's range becomes [-1, 1]. Monotonic, so equal
/// values stay equal and greater ones stay at least as great.
struct Normalization {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 1;  ///< half the diagonal of the bounds, in world units
  ValueScale values;

  /// The mesh has a drawable cell.
  explicit Normalization(const Scene& scene);

  /// Finite for finite points of the mesh.
  [[nodiscard]] Eigen::Vector3f point(const Eigen::Vector3d& world) const;

  /// Within [-1, 1] for values of the field; others may lie outside, but are finite.
  [[nodiscard]] float value(double value) const { return values.scaled(value); }

  /// The inverse of `value`.
  [[nodiscard]] double field_value(double normalized) const { return values.value(normalized); }
};

/// What the length of a gradient in normalized units is multiplied by to be a density, below 1
/// (modulation.h). The scene has a modulation.
[[nodiscard]] float modulation_factor(const Scene& scene, const Normalization& normalization);

}  // namespace tetraglass::project::gl
