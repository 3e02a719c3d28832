#include "project/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "base/errors.h"

namespace tetraglass::project {
namespace {

constexpr double kMargin =
    1 / 0.9;  // the part of the picture that a framed scene fills, upside down

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

}  // namespace

Camera frame_camera(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& direction,
                    const Eigen::Vector3d& up, double fov_degrees, double aspect) {
  const Eigen::Vector3d away = -direction.stableNormalized();
  const Eigen::Vector3d right = away.cross(up).stableNormalized();
  Eigen::Matrix3d axes;
  axes << right.transpose(), right.cross(away).transpose(), away.transpose();

  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : points) {
    if (point.allFinite()) box.extend(point);
  }
  const Eigen::Vector3d center = box.isEmpty() ? Eigen::Vector3d::Zero().eval() : box.center();
  const double half_slope = std::tan(radians(fov_degrees) / 2);
  const Eigen::Array2d slope(half_slope * aspect / kMargin, half_slope / kMargin);

  // A point (x, y, z) in the camera's axes is inside the picture of an eye at (o, -d) if |x - o| <=
  // slope (z + d): the largest x - slope z and -x - slope z of all points bound slope d + o and
  // slope d - o from below.
  Eigen::Array2d high = Eigen::Array2d::Constant(-std::numeric_limits<double>::infinity());
  Eigen::Array2d low = high;
  Eigen::AlignedBox3d extent;  // in the camera's axes
  for (const Eigen::Vector3d& point : points) {
    if (!point.allFinite()) continue;
    const Eigen::Vector3d p = axes * (point - center);
    extent.extend(p);
    high = high.max(p.head<2>().array() - slope * p.z());
    low = low.max(-p.head<2>().array() - slope * p.z());
  }
  Camera camera;
  camera.up = up;
  camera.fov_degrees = fov_degrees;
  const double size = extent.isEmpty() ? 0 : extent.sizes().maxCoeff();
  if (!(size > 0)) {  // nothing, or a single point
    camera.target = center;
    camera.eye = center - away;
    camera.ortho_height = 1;
    return camera;
  }
  // Far enough to be outside, even where the points lie on a line along the view.
  const double distance =
      std::max(((high + low) / (2 * slope)).maxCoeff(), size * 1e-3 - extent.min().z());
  const Eigen::Vector2d offset = (high - low) / 2;
  camera.eye = center + axes.transpose() * Eigen::Vector3d(offset.x(), offset.y(), -distance);
  camera.target = camera.eye + away * distance;
  // A parallel view must hold the extent about the same axis.
  const Eigen::Array2d half =
      (extent.max().head<2>() - offset).array().max((offset - extent.min().head<2>()).array());
  camera.ortho_height = 2 * kMargin * std::max({half.y(), half.x() / aspect, size * 1e-3});
  return camera;
}

Camera frame_camera(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& direction,
                    const Eigen::Vector3d& up, double fov_degrees, double aspect) {
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < 8 && !box.isEmpty(); ++i) {
    corners.push_back(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)));
  }
  return frame_camera(corners, direction, up, fov_degrees, aspect);
}

Camera centered(const Camera& camera, std::span<const Eigen::Vector3d> points) {
  const Frame frame(camera, 1, 1);
  Eigen::AlignedBox3d extent;
  for (const Eigen::Vector3d& point : points) {
    if (point.allFinite()) extent.extend(frame.to_camera(point));
  }
  if (extent.isEmpty()) return camera;
  Eigen::Vector3d sideways = extent.center();
  sideways.z() = 0;
  Camera result = camera;
  result.eye += frame.axes().transpose() * sideways;
  result.target += frame.axes().transpose() * sideways;
  return result;
}

Frame::Frame(const Camera& camera, int width, int height, const Region& region)
    : parallel_(camera.parallel),
      width_(width),
      height_(height),
      region_(region),
      eye_(camera.eye) {
  const auto finite = [](const Eigen::Vector3d& v) { return v.array().isFinite().all(); };
  if (width < 1 || height < 1)
    throw base::UsageError("the picture needs at least one pixel each way");
  if (region.width < 1 || region.height < 1 || region.x < 0 || region.y < 0 ||
      region.x > width - region.width || region.y > height - region.height) {
    throw base::UsageError("the region has no pixels or leaves the picture of " +
                           std::to_string(width) + " x " + std::to_string(height) + " pixels");
  }
  if (!finite(camera.eye) || !finite(camera.target) || !finite(camera.up)) {
    throw base::UsageError("the camera's eye, target and up must be finite numbers");
  }
  const Eigen::Vector3d gaze = camera.target - camera.eye;
  if (!(gaze.stableNorm() > 0))
    throw base::UsageError("the camera's eye and target are the same point");
  const Eigen::Vector3d away = gaze.stableNormalized();
  const Eigen::Vector3d right = away.cross(camera.up.stableNormalized());
  // Below this sine the rounding of the cross product (3 ulp of the operands) would turn the
  // picture by more than a 16,384th of a radian, a pixel in the widest image.
  constexpr double kSmallestSine = 16384 * 3 * 2.3e-16;
  if (!(right.norm() > kSmallestSine)) {
    throw base::UsageError(
        "the camera's up direction is parallel to the view; choose another --up");
  }
  axes_.row(0) = right.normalized();
  axes_.row(1) = right.normalized().cross(away);
  axes_.row(2) = away;
  if (parallel_) {
    if (!(camera.ortho_height > 0) || !std::isfinite(camera.ortho_height)) {
      throw base::UsageError("--ortho needs a height above 0, in the mesh's units");
    }
    half_height_ = camera.ortho_height / 2;
  } else {
    if (!(camera.fov_degrees > 0 && camera.fov_degrees < 180)) {
      throw base::UsageError("--fov must lie between 0 and 180 degrees (exclusive)");
    }
    half_height_ = std::tan(radians(camera.fov_degrees) / 2);
  }
}

}  // namespace tetraglass::project
