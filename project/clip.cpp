#include "project/clip.h"

#include <algorithm>

namespace tetraglass::project {

DepthRange clipped_ray(std::span<const ClipPlane> planes, const Frame& frame,
                       const Eigen::Vector2d& plane) {
  DepthRange range;
  const Eigen::Vector3d origin = frame.ray_origin(plane);
  const Eigen::Vector3d direction = frame.ray_direction(plane);
  for (const ClipPlane& clip : planes) {
    const Eigen::Vector3d normal = frame.axes() * clip.normal;
    // normal . (origin + z direction) <= room
    const double room = clip.offset - clip.normal.dot(frame.eye()) - normal.dot(origin);
    const double slope = normal.dot(direction);
    if (slope > 0) {
      range.far = std::min(range.far, room / slope);
    } else if (slope < 0) {
      range.near = std::max(range.near, room / slope);
    } else if (room < 0) {
      range.near = std::numeric_limits<double>::infinity();
      range.far = -range.near;
    }
  }
  return range;
}

}  // namespace tetraglass::project
