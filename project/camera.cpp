#include "project/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/errors.h"

namespace tetraglass::project {
namespace {

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

}  // namespace

Camera frame_camera(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& direction,
                    const Eigen::Vector3d& up, double fov_degrees, double aspect) {
  // The sphere around the box always fits, from whichever side it is seen.
  const double diagonal = box.isEmpty() ? 0.0 : box.diagonal().norm();
  const double radius = diagonal > 0 ? diagonal / 2 : 1.0;
  const double half = radians(fov_degrees) / 2;
  const double narrow = aspect < 1 ? std::atan(std::tan(half) * aspect) : half;
  Camera camera;
  camera.target = box.isEmpty() ? Eigen::Vector3d::Zero().eval() : box.center();
  camera.eye = camera.target + direction.stableNormalized() * (radius / std::sin(narrow));
  camera.up = up;
  camera.fov_degrees = fov_degrees;
  camera.ortho_height = 2 * radius / std::min(1.0, aspect);
  return camera;
}

Frame::Frame(const Camera& camera, int width, int height)
    : parallel_(camera.parallel), width_(width), height_(height), eye_(camera.eye) {
  const auto finite = [](const Eigen::Vector3d& v) { return v.array().isFinite().all(); };
  if (width < 1 || height < 1)
    throw base::UsageError("the picture needs at least one pixel each way");
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
