#pragma once

#include <string>

#include <Eigen/Core>

#include "apps/camera_options.h"
#include "project/camera.h"

/// How dragging moves a camera. Distances over the picture are in parts of its height, x to the
/// right, y downwards.
namespace tetraglass::apps::view {

/// The camera turned about its target, as if the mouse turned a ball: half a turn for a drag over
/// the height of the picture.
[[nodiscard]] project::Camera orbited(const project::Camera& camera, const Eigen::Vector2d& drag);

/// The camera moved sideways, so that what is at the target's distance follows the mouse.
[[nodiscard]] project::Camera panned(const project::Camera& camera, const Eigen::Vector2d& drag);

/// What is at the target's distance looks `factor` times as large; what is there under the mouse,
/// `place` from the middle of the picture, stays there.
[[nodiscard]] project::Camera zoomed(const project::Camera& camera, double factor,
                                     const Eigen::Vector2d& place);

/// A parallel or a perspective view that shows what is at the target's distance as large as before.
[[nodiscard]] project::Camera with_parallel(const project::Camera& camera, bool parallel);

/// The options that give this camera, to the last bit.
[[nodiscard]] CameraArguments camera_arguments(const project::Camera& camera);

/// "1,2.5,-3e-05": numbers that read back as the same doubles.
[[nodiscard]] std::string to_text(const Eigen::Vector3d& vector);

}  // namespace tetraglass::apps::view
