#include "apps/orbit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

namespace tetraglass::apps {

std::vector<project::Camera> orbit(const project::Camera& camera, const Eigen::Vector3d& pivot,
                                   int count) {
  const Eigen::Vector3d axis = camera.up.stableNormalized();
  std::vector<project::Camera> cameras(static_cast<std::size_t>(count), camera);
  for (int i = 1; i < count; ++i) {
    const Eigen::AngleAxisd turn(2 * std::numbers::pi * i / count, axis);
    project::Camera& turned = cameras[static_cast<std::size_t>(i)];
    turned.eye = pivot + turn * (camera.eye - pivot);
    turned.target = pivot + turn * (camera.target - pivot);
  }
  return cameras;
}

std::vector<Eigen::Vector3d> swept_by_orbit(std::span<const Eigen::Vector3d> points,
                                            const Eigen::Vector3d& pivot,
                                            const Eigen::Vector3d& axis) {
  const Eigen::Vector3d up = axis.stableNormalized();
  double radius = 0;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Eigen::Vector3d& p : points) {
    if (!p.allFinite()) continue;
    const double height = up.dot(p - pivot);
    low = std::min(low, height);
    high = std::max(high, height);
    radius = std::max(radius, (p - pivot - height * up).norm());
  }
  std::vector<Eigen::Vector3d> rims;
  if (low > high) return rims;
  const Eigen::Vector3d right = up.unitOrthogonal();
  const Eigen::Vector3d ahead = up.cross(right);
  constexpr int kCorners = 180;
  // A polygon around the circle.
  const double reach = radius / std::cos(std::numbers::pi / kCorners);
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners;
    const Eigen::Vector3d across = reach * (std::cos(angle) * right + std::sin(angle) * ahead);
    rims.emplace_back(pivot + low * up + across);
    rims.emplace_back(pivot + high * up + across);
  }
  return rims;
}

}  // namespace tetraglass::apps
