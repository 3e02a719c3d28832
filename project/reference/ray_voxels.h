#pragma once

#include <vector>

#include <Eigen/Core>

#include "mesh/rectilinear_grid.h"
#include "project/scene.h"

namespace tetraglass::project {

/// A piece of one ray inside one voxel on which the trilinear field rises or falls only. Along it
/// the field is the cubic c0 + c1 t + c2 t^2 + c3 t^3, t from 0 at its front to 1 at its back.
struct MonotonePiece {
  double entry = 0;  ///< depth along the view axis; >= 0 in perspective
  double exit = 0;   ///< > entry
  Eigen::Vector4d cubic = Eigen::Vector4d::Zero();

  [[nodiscard]] double value(double t) const {
    return cubic[0] + t * (cubic[1] + t * (cubic[2] + t * cubic[3]));
  }
  /// Where the field has a value that lies between those of the ends; by bisection, to rounding.
  [[nodiscard]] double position(double value_there) const;
};

/// Finds the voxels that the rays of a picture meet. Of a scene that has a grid; both outlive this.
class RayVoxels {
 public:
  explicit RayVoxels(const Scene& scene);

  /// All pieces of the ray through the centre of pixel (x, y), nearest first; cut at the scene's
  /// clip planes.
  void pieces(int x, int y, std::vector<MonotonePiece>& result) const;

  /// The coordinates (RectilinearGrid) of a place on the ray.
  [[nodiscard]] Eigen::Vector3d coordinate(const Eigen::Vector2d& plane, double depth) const;

  [[nodiscard]] const Frame& frame() const { return frame_; }

 private:
  void add_voxel(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double entry, double exit,
                 std::vector<MonotonePiece>& result) const;
  /// Whether a ray parallel to the two outer faces across an axis passes between them. In a face,
  /// the reference's rule (RayCells): as if moved by (epsilon, epsilon^2) to the right and up.
  [[nodiscard]] bool passes_between(Eigen::Index axis, const Eigen::Vector2d& plane) const;

  const Scene& scene_;
  Frame frame_;
  Eigen::Matrix3d to_coordinates_;  // of directions in camera space
  Eigen::Vector3d eye_;             // its coordinates
  Eigen::Vector3d low_corner_;      // of the grid, in camera space
  Eigen::Vector3d high_corner_;
};

}  // namespace tetraglass::project
