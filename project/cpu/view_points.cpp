#include "project/cpu/view_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "base/parallel.h"

namespace tetraglass::project::cpu {

Projection::Projection(const Frame& frame, double unit, const Eigen::Vector3d& middle)
    : perspective(!frame.parallel()),
      radius(unit),
      focal(1 / frame.pitch()),
      center_x(frame.middle().x() - 0.5),
      center_y(frame.middle().y() - 0.5),
      axes(frame.axes()),
      depth_offset(frame.parallel() ? frame.to_camera(middle).z() : 0),
      middle_depth(std::max(1.0, frame.to_camera(middle).z() / unit)) {}

void ViewPoints::project(const mesh::TetMesh& mesh, const DrawnCells& cells, const Frame& frame,
                         const Projection& projection) {
  exact.resize(mesh.points.size());
  screen.resize(mesh.points.size());
  const double plane =
      projection.perspective ? projection.focal / projection.radius : projection.focal;
  constexpr std::size_t kGrain = 4096;  // some 50 us of work
  base::parallel_ranges(mesh.points.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d p = frame.to_camera(mesh.points[i]);
      ViewPoint& e = exact[i];
      e.x = plane * p.x();
      e.y = -plane * p.y();
      e.z = (p.z() - projection.depth_offset) / projection.radius;
      e.value = cells.point_values.empty() ? 0 : static_cast<double>(cells.point_values[i]);
      const bool in_front = !projection.perspective || e.z > 0;
      const double inverse = projection.perspective && in_front ? 1 / e.z : 1;
      const double distance = projection.perspective ? p.norm() / projection.radius : e.z;
      screen[i] = {static_cast<float>(e.x * inverse + projection.center_x),
                   static_cast<float>(e.y * inverse + projection.center_y),
                   static_cast<float>(distance), in_front ? 1.0F : 0.0F};
    }
  });
}

ClippedDepths clipped_depths(std::span<const ClipPlane> planes, RayEnds ends, const Frame& frame,
                             const Projection& projection, int x, int y) {
  DepthRange kept;
  if (!planes.empty()) kept = clipped_ray(planes, frame, frame.image_plane(x, y));
  if (!ends.empty() && x < frame.width() && y < frame.height()) {
    const std::size_t pixel =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width()) +
        static_cast<std::size_t>(x);
    kept.far = std::min(kept.far, ends[pixel]);
  }
  const auto depth = [&](double z) {
    if (!projection.perspective) return (z - projection.depth_offset) / projection.radius;
    // Behind the eye is nothing.
    if (!(z > 0)) return -std::numeric_limits<double>::infinity();
    return 1 - projection.middle_depth * projection.radius / z;
  };
  // Far outside of the mesh a depth only has to stay there.
  const auto rounded = [](double d) { return static_cast<float>(std::clamp(d, -1e30, 1e30)); };
  return {rounded(depth(kept.near)), rounded(depth(kept.far))};
}

double value_at_eye(const mesh::Cell& cell, const ViewPoints& points) {
  // Barycentric coordinates of the origin: the volumes that it spans with the faces.
  double volume = 0;
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto vertex = [&](std::size_t i) {
      const ViewPoint& p = points.exact[cell[(k + i) % 4]];
      return Eigen::Vector3d(p.x, p.y, p.z);
    };
    const double part = std::abs(vertex(1).cross(vertex(2)).dot(vertex(3)));
    volume += part;
    sum += part * points.exact[cell[k]].value;
  }
  return volume > 0 ? sum / volume : points.exact[cell[0]].value;
}

}  // namespace tetraglass::project::cpu
