#pragma once

#include <limits>
#include <span>

#include <Eigen/Core>

#include "project/camera.h"

namespace tetraglass::project {

/// Keeps the half space normal . x <= offset of world space. The normal is not 0 and need not be of
/// unit length.
struct ClipPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
  double offset = 0;
};

/// A part of a ray, in depths along the view axis.
struct DepthRange {
  double near = -std::numeric_limits<double>::infinity();
  double far = std::numeric_limits<double>::infinity();
};

/// The part of the ray through an image plane position (Frame::image_plane) that all planes keep;
/// near > far where they keep none of it. Cells are cut there, not dropped.
[[nodiscard]] DepthRange clipped_ray(std::span<const ClipPlane> planes, const Frame& frame,
                                     const Eigen::Vector2d& plane);

}  // namespace tetraglass::project
