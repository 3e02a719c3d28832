#include "project/opaque_geometry.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace tetraglass::project {

std::vector<OpaqueLine> box_outline(const Eigen::AlignedBox3d& box, const preint::Color& color,
                                    double width) {
  using Corner = Eigen::AlignedBox3d::CornerType;
  std::vector<OpaqueLine> lines;
  if (box.isEmpty()) return lines;
  for (int axis = 0; axis < 3; ++axis) {
    for (int corner = 0; corner < 8; ++corner) {
      if ((corner >> axis & 1) != 0) continue;
      lines.push_back({box.corner(static_cast<Corner>(corner)),
                       box.corner(static_cast<Corner>(corner | 1 << axis)), color, width});
    }
  }
  return lines;
}

OpaqueSurface shaded_surface(std::vector<Eigen::Vector3d> points,
                             std::vector<std::array<std::uint32_t, 3>> triangles,
                             const preint::Color& color, double crease_degrees) {
  OpaqueSurface surface;
  surface.color = color;
  std::vector<Eigen::Vector3d> areas;  // twice the area along the normal
  std::vector<std::vector<std::uint32_t>> around(points.size());
  areas.reserve(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    areas.emplace_back((points[b] - points[a]).cross(points[c] - points[a]));
    for (const std::uint32_t corner : triangles[t]) around[corner].push_back(t);
  }
  const double least_cosine = std::cos(crease_degrees * std::numbers::pi / 180);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Eigen::Vector3d own = areas[t].stableNormalized();
    for (const std::uint32_t corner : triangles[t]) {
      Eigen::Vector3d sum = areas[t];
      for (const std::uint32_t other : around[corner]) {
        if (other != t && areas[other].stableNormalized().dot(own) > least_cosine)
          sum += areas[other];
      }
      surface.normals.push_back(sum);
    }
  }
  surface.points = std::move(points);
  surface.triangles = std::move(triangles);
  return surface;
}

}  // namespace tetraglass::project
