#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "project/camera.h"
#include "project/light/lights.h"

namespace tetraglass::project {

/// Where light comes from, in the form that projectors sum up.
struct LightSource {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< far away: the unit vector towards it
  bool far_away = false;
  preint::Color color = preint::Color::Ones();
};

/// Every light as sources. A rectangle becomes the points of a Gauss-Legendre rule, 4 to 14 each
/// way: so many that, seen from the nearest point of `scene`, they lie closer together than the
/// specular lobe of the shiniest material of `tf` is wide (1 / sqrt(shininess) radians). Its error
/// is about 1e-3 of the light's color where the rectangle does not touch the scene.
[[nodiscard]] std::vector<LightSource> light_sources(const Lights& lights,
                                                     const Eigen::AlignedBox3d& scene,
                                                     const preint::TransferFunction& tf);

/// The source in the camera's axes (right, up, away), from the point at this depth on its axis, in
/// units of `unit`.
[[nodiscard]] LightSource viewed(const LightSource& source, const Frame& frame, double depth,
                                 double unit);

}  // namespace tetraglass::project
