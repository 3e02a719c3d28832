#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "project/scene.h"

namespace tetraglass::project {

/// The piece of one ray inside one cell.
struct RaySegment {
  double entry = 0;  ///< depth along the view axis where the ray enters; >= 0 in perspective, where
                     ///< rays start at the eye
  double exit = 0;   ///< ... and where it leaves, >= entry
  double front = 0;  ///< the field's value at the entry
  double back = 0;   ///< ... and at the exit
  std::uint32_t cell = 0;
  Eigen::Vector4d entry_weights =
      Eigen::Vector4d::Zero();  ///< barycentric coordinates of the entry point
  Eigen::Vector4d exit_weights = Eigen::Vector4d::Zero();  ///< ... and of the exit point
};

/// Finds the cells that the rays of a picture meet.
class RayCells {
 public:
  /// Takes the scene's drawable cells to camera space and bins them to tiles of pixels by their
  /// bounds. The scene outlives this.
  explicit RayCells(const Scene& scene);

  /// Every segment of the ray through the centre of pixel (x, y), nearest first (by the middle of
  /// the segment, so that segments of no length fall between their neighbours). Which faces the ray
  /// meets is decided exactly. Cost: linear in the cells of the tile.
  void segments(int x, int y, std::vector<RaySegment>& result) const;

  [[nodiscard]] const Frame& frame() const { return frame_; }

 private:
  [[nodiscard]] bool intersect(std::uint32_t cell, const Eigen::Vector2d& plane,
                               RaySegment& segment) const;
  /// The point in the image plane's homogeneous coordinates: (x, y, depth) in perspective, (x, y,
  /// 1) in parallel views.
  [[nodiscard]] Eigen::Vector3d projective(std::uint32_t point) const;
  [[nodiscard]] int edge_side(std::uint32_t from, std::uint32_t to,
                              const Eigen::Vector2d& plane) const;
  [[nodiscard]] int edge_side_at_eye(const Eigen::Vector3d& p, const Eigen::Vector3d& q,
                                     const Eigen::Vector2d& plane) const;
  void bin_cells();

  /// A cell with the pixels that its image can touch.
  struct TileCell {
    std::uint32_t cell = 0;
    std::int32_t first_x = 0;
    std::int32_t first_y = 0;
    std::int32_t last_x = 0;
    std::int32_t last_y = 0;
  };

  const Scene& scene_;
  Frame frame_;
  std::vector<Eigen::Vector3d> points_;
  int tiles_x_;
  int tiles_y_;
  std::vector<std::vector<TileCell>> tile_cells_;
};

}  // namespace tetraglass::project
