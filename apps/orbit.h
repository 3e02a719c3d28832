#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "project/camera.h"

namespace tetraglass::apps {

/// The camera turned about its up direction through the pivot, counter-clockwise from above, into
/// `count` >= 1 places evenly around it; the first is its own.
[[nodiscard]] std::vector<project::Camera> orbit(const project::Camera& camera,
                                                 const Eigen::Vector3d& pivot, int count);

/// Points whose outline is the same from everywhere around the axis and encloses that of all
/// `points` (those that are finite): the rims of the cylinder around them.
[[nodiscard]] std::vector<Eigen::Vector3d> swept_by_orbit(std::span<const Eigen::Vector3d> points,
                                                          const Eigen::Vector3d& pivot,
                                                          const Eigen::Vector3d& axis);

}  // namespace tetraglass::apps
