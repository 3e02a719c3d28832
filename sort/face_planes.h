#pragma once

#include <cmath>
#include <limits>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "sort/order.h"

namespace tetraglass::sort {

/// The plane of a face in float: height over it = normal . p + offset, p relative to some middle.
struct FacePlane {
  Eigen::Vector3f normal;
  float offset;  ///< not a number where the face is too flat for its normal to be of use
};

/// The plane through a, b and c, which are seen counter-clockwise from above.
[[nodiscard]] inline FacePlane face_plane(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                          const Eigen::Vector3d& c, const Eigen::Vector3d& middle) {
  // Below this sine of the angle between two edges the normal is too uncertain.
  constexpr double kLeastSine = 0x1p-26;
  const Eigen::Vector3d u = b - a;
  const Eigen::Vector3d v = c - a;
  const Eigen::Vector3d normal = u.cross(v);
  const double length = normal.norm();
  if (!(length > kLeastSine * u.norm() * v.norm()) || !std::isnormal(length)) {
    return {Eigen::Vector3f::Zero(), std::numeric_limits<float>::quiet_NaN()};
  }
  FacePlane plane{(normal / length).cast<float>(), 0};
  plane.offset = static_cast<float>(-plane.normal.cast<double>().dot(a - middle));
  return plane;
}

/// On which side of planes the eye is, as far as float can tell.
///
/// Let u = 2^-24, e the eye and a the face's first vertex, both relative to the middle. The normal
/// in double is off by at most 2^-49 / kLeastSine < u in length (Higham 2002, Accuracy and
/// Stability, 3.1: the cross product of two rounded differences, 8 roundings of |u| |v|), that in
/// float by 2 u more: 3 u |e - a|. The offset is rounded by 2 u |a|, the eye by u |e|, the sum of
/// four terms of at most |e| and |a| by 4 u (2 |e| + |a|). Together less than 12 u |e| + 9 u |a| <
/// 2^-20 (|e| + radius). In parallel views the eye is the unit vector against the direction, and
/// the offset does not count.
class EyeSides {
 public:
  /// All planes were made relative to `middle`, and their first vertices lie within `radius` of it.
  EyeSides(const View& view, const Eigen::Vector3d& middle, double radius) {
    const Eigen::Vector3d eye =
        view.parallel ? Eigen::Vector3d(-view.direction) : Eigen::Vector3d(view.eye - middle);
    eye_ = eye.cast<float>();
    offset_weight_ = view.parallel ? 0.0F : 1.0F;
    slack_ =
        static_cast<float>(0x1p-20 * (eye.norm() + (view.parallel ? 0.0 : radius)) * (1 + 0x1p-20));
  }

  /// 1 above the plane, -1 below, 0 if that is uncertain.
  [[nodiscard]] int of(const FacePlane& plane) const {
    const float height = plane.normal.x() * eye_.x() + plane.normal.y() * eye_.y() +
                         plane.normal.z() * eye_.z() + offset_weight_ * plane.offset;
    return height > slack_ ? 1 : height < -slack_ ? -1 : 0;
  }

 private:
  Eigen::Vector3f eye_;
  float offset_weight_;
  float slack_;
};

}  // namespace tetraglass::sort
