#pragma once

#include <algorithm>
#include <limits>

#include "project/camera.h"

namespace tetraglass::tests {

/// The length inside an axis-aligned box of the ray through the centre of pixel (x, y), by the slab
/// method; perspective rays start at the eye, parallel ones come from infinity.
inline double chord(const Eigen::AlignedBox3d& box, const project::Frame& frame, int x, int y) {
  const Eigen::Vector2d plane = frame.image_plane(x, y);
  const Eigen::Vector3d origin = frame.eye() + frame.axes().transpose() * frame.ray_origin(plane);
  const Eigen::Vector3d direction = frame.axes().transpose() * frame.ray_direction(plane);
  double enter = frame.parallel() ? -std::numeric_limits<double>::infinity() : 0.0;
  double leave = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0) {
      if (origin[axis] < box.min()[axis] || origin[axis] > box.max()[axis]) return 0;
      continue;
    }
    const double a = (box.min()[axis] - origin[axis]) / direction[axis];
    const double b = (box.max()[axis] - origin[axis]) / direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return std::max(0.0, leave - enter) * direction.norm();
}

}  // namespace tetraglass::tests
