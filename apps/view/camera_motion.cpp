#include "apps/view/camera_motion.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>

namespace tetraglass::apps::view {
namespace {

struct Axes {
  Eigen::Vector3d right;
  Eigen::Vector3d up;
};

Axes axes_of(const project::Camera& camera) {
  const Eigen::Vector3d gaze = (camera.target - camera.eye).stableNormalized();
  const Eigen::Vector3d right = gaze.cross(camera.up).stableNormalized();
  return {right, right.cross(gaze)};
}

double height_at_unit_distance(const project::Camera& camera) {
  return 2 * std::tan(camera.fov_degrees * std::numbers::pi / 360);
}

/// Of the picture, at the target's distance, in the mesh's units.
double picture_height(const project::Camera& camera) {
  if (camera.parallel) return camera.ortho_height;
  return height_at_unit_distance(camera) * (camera.target - camera.eye).stableNorm();
}

}  // namespace

project::Camera orbited(const project::Camera& camera, const Eigen::Vector2d& drag) {
  const Axes axes = axes_of(camera);
  const Eigen::Matrix3d turn = (Eigen::AngleAxisd(-drag.x() * std::numbers::pi, axes.up) *
                                Eigen::AngleAxisd(-drag.y() * std::numbers::pi, axes.right))
                                   .toRotationMatrix();
  project::Camera result = camera;
  result.eye = camera.target + turn * (camera.eye - camera.target);
  result.up = turn * axes.up;
  return result;
}

project::Camera panned(const project::Camera& camera, const Eigen::Vector2d& drag) {
  const Axes axes = axes_of(camera);
  const Eigen::Vector3d shift =
      picture_height(camera) * (drag.y() * axes.up - drag.x() * axes.right);
  project::Camera result = camera;
  result.eye += shift;
  result.target += shift;
  return result;
}

project::Camera zoomed(const project::Camera& camera, double factor, const Eigen::Vector2d& place) {
  project::Camera result = camera;
  if (camera.parallel) {
    result.ortho_height = camera.ortho_height / factor;
  } else {
    result.eye = camera.target + (camera.eye - camera.target) / factor;
  }
  return panned(result, (1 - factor) * place);
}

project::Camera with_parallel(const project::Camera& camera, bool parallel) {
  project::Camera result = camera;
  if (parallel == camera.parallel) return result;
  result.parallel = parallel;
  if (parallel) {
    result.ortho_height = picture_height(camera);
  } else {
    const double distance = camera.ortho_height / height_at_unit_distance(camera);
    result.eye = camera.target + distance * (camera.eye - camera.target).stableNormalized();
  }
  return result;
}

CameraArguments camera_arguments(const project::Camera& camera) {
  CameraArguments arguments;
  arguments.eye = to_text(camera.eye);
  arguments.target = to_text(camera.target);
  arguments.up = to_text(camera.up);
  (camera.parallel ? arguments.ortho : arguments.fov) =
      fmt::format("{}", camera.parallel ? camera.ortho_height : camera.fov_degrees);
  return arguments;
}

std::string to_text(const Eigen::Vector3d& vector) {
  return fmt::format("{},{},{}", vector.x(), vector.y(), vector.z());
}

}  // namespace tetraglass::apps::view
