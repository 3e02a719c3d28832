#pragma once

#include <span>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "sort/order.h"

namespace tetraglass::project {

/// Right-handed; looks from `eye` to `target`.
struct Camera {
  Eigen::Vector3d eye = Eigen::Vector3d(0, 0, 1);
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();
  bool parallel = false;
  double fov_degrees = 30;  ///< vertical, perspective only
  double ortho_height = 1;  ///< height of the picture in world units, parallel only
};

/// A camera that looks along `-direction` (which points from the scene to the eye; need not be of
/// unit length) and sees all of `points` as large as they fit into a picture of the given aspect
/// (width / height), with a margin of a twentieth on each side. Points that are not finite are
/// passed over. `up` must not be parallel to `direction`. Both `fov_degrees` and `ortho_height` are
/// set up.
[[nodiscard]] Camera frame_camera(std::span<const Eigen::Vector3d> points,
                                  const Eigen::Vector3d& direction, const Eigen::Vector3d& up,
                                  double fov_degrees, double aspect);

/// The same for the corners of a box.
[[nodiscard]] Camera frame_camera(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& direction,
                                  const Eigen::Vector3d& up, double fov_degrees, double aspect);

/// The camera moved sideways, so that the picture of a parallel view is centred on `points` (those
/// that are finite).
[[nodiscard]] Camera centered(const Camera& camera, std::span<const Eigen::Vector3d> points);

/// A part of a picture, in pixels; (x, y) is its first pixel.
struct Region {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// The camera's axes and image plane, ready to map pixels to rays (DESIGN section 2, "Camera").
/// Camera space: x right, y up, z *away* from the viewer (depth), origin at the eye.
class Frame {
 public:
  /// Throws UsageError where eye and target coincide, up is parallel to the view, an angle is not
  /// in (0, 180), a size is not positive or a number not finite.
  Frame(const Camera& camera, int width, int height)
      : Frame(camera, width, height, {0, 0, width, height}) {}

  /// Of a part of the picture of this width and height: pixels are counted in the part. Throws
  /// UsageError where it has no pixels or leaves the picture, too.
  Frame(const Camera& camera, int width, int height, const Region& region);

  /// Image plane coordinates of the centre of pixel (x, y), at unit distance (perspective) or in
  /// world units (parallel).
  [[nodiscard]] Eigen::Vector2d image_plane(double x, double y) const {
    return {(2 * (x + region_.x + 0.5) / width_ - 1) * half_height_ * width_ / height_,
            (1 - 2 * (y + region_.y + 0.5) / height_) * half_height_};
  }
  /// The pixel position (x, y), fractional, whose centre has these image plane coordinates: inverse
  /// of `image_plane`.
  [[nodiscard]] Eigen::Vector2d pixel(const Eigen::Vector2d& plane) const {
    return {(plane.x() / (half_height_ * width_ / height_) + 1) * width_ / 2 - 0.5 - region_.x,
            (1 - plane.y() / half_height_) * height_ / 2 - 0.5 - region_.y};
  }
  [[nodiscard]] Eigen::Vector3d to_camera(const Eigen::Vector3d& world) const {
    return axes_ * (world - eye_);
  }

  /// A ray's origin and direction in camera space: the eye and (u, v, 1) in perspective (so that
  /// the ray parameter is the depth), the point (u, v, 0) and (0, 0, 1) in parallel views.
  [[nodiscard]] Eigen::Vector3d ray_origin(const Eigen::Vector2d& plane) const {
    return parallel_ ? Eigen::Vector3d(plane.x(), plane.y(), 0) : Eigen::Vector3d::Zero();
  }
  [[nodiscard]] Eigen::Vector3d ray_direction(const Eigen::Vector2d& plane) const {
    return parallel_ ? Eigen::Vector3d(0, 0, 1) : Eigen::Vector3d(plane.x(), plane.y(), 1);
  }

  [[nodiscard]] bool parallel() const { return parallel_; }
  [[nodiscard]] const Eigen::Matrix3d& axes() const { return axes_; }  ///< rows: right, up, away
  [[nodiscard]] const Eigen::Vector3d& eye() const { return eye_; }
  /// The side of a pixel in the image plane.
  [[nodiscard]] double pitch() const { return 2 * half_height_ / height_; }
  /// The camera's axis in pixels, from the corner of the first one.
  [[nodiscard]] Eigen::Vector2d middle() const {
    return {0.5 * width_ - region_.x, 0.5 * height_ - region_.y};
  }
  /// Pixels of the part that is drawn.
  [[nodiscard]] int width() const { return region_.width; }
  [[nodiscard]] int height() const { return region_.height; }
  [[nodiscard]] sort::View view() const { return {parallel_, eye_, axes_.row(2).transpose()}; }

 private:
  bool parallel_;
  int width_;  // of the whole picture
  int height_;
  Region region_;
  double half_height_;
  Eigen::Vector3d eye_;
  Eigen::Matrix3d axes_;
};

}  // namespace tetraglass::project
