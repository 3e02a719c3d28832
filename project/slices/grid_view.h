#pragma once

#include <array>

#include <Eigen/Core>

#include "project/camera.h"
#include "project/gl/normalization.h"
#include "project/gl/program.h"
#include "project/gl/view_uniforms.h"
#include "project/scene.h"

namespace tetraglass::project::slices {

/// A part of the grid: from `low` to `high`, in units of its half extent along each axis about its
/// centre, so that all of it is [-1, 1] each way.
struct GridBox {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(-1);
  Eigen::Vector3d high = Eigen::Vector3d::Constant(1);
};

/// The grid as one frame sees it. Camera space here is that of Frame in units of
/// Normalization::radius; a ray's parameter is its depth there less `focus` (ViewUniforms).
class GridView {
 public:
  /// The scene has a grid.
  GridView(const Scene& scene, const gl::Normalization& normalization, const Frame& frame,
           double focus);

  /// From camera space to units of the half extents (GridBox).
  [[nodiscard]] Eigen::Vector3d to_box(const Eigen::Vector3d& camera) const {
    return eye_ + to_box_ * camera;
  }

  /// Of a box, in camera space.
  [[nodiscard]] std::array<Eigen::Vector3d, 8> corners(const GridBox& box) const;

  /// In pixels from the picture's corner (the centre of pixel i is i + 1/2). In front of the eye.
  [[nodiscard]] Eigen::Vector2d pixel(const Eigen::Vector3d& camera) const;

  /// The largest length of a ray of the picture for each unit of depth.
  [[nodiscard]] double most_stretch() const { return most_stretch_; }

  /// The direction of the view axis and, in perspective, the place of the eye, in units of the half
  /// extents.
  [[nodiscard]] Eigen::Vector3d away() const { return to_box_.col(2); }
  [[nodiscard]] const Eigen::Vector3d& eye() const { return eye_; }

  /// The axis across which the planes of the grid are seen most directly.
  [[nodiscard]] int stack_axis() const { return stack_axis_; }

  /// The distance between two planes of the grid across an axis, a unit apart in the units of the
  /// half extents, in units of the normalization.
  [[nodiscard]] double plane_distance(int axis) const { return 1 / to_box_.row(axis).norm(); }

  /// The largest change of each of the half extents' units along a unit of length.
  [[nodiscard]] Eigen::Vector3d steepest() const { return to_box_.rowwise().norm(); }

  [[nodiscard]] bool parallel() const { return parallel_; }
  [[nodiscard]] double focus() const { return focus_; }

  /// What grid_ray.glsl reads, but for that of ViewUniforms.
  void set(const gl::Program& program) const;

 private:
  bool parallel_;
  double focus_;
  double pitch_;
  Eigen::Vector2d middle_;
  double most_stretch_ = 1;
  Eigen::Matrix3d to_box_;
  Eigen::Matrix3d to_camera_;
  Eigen::Vector3d eye_;
  int stack_axis_;
};

}  // namespace tetraglass::project::slices
