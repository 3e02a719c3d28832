#pragma once

#include <span>
#include <vector>

#include "project/camera.h"
#include "project/clip.h"
#include "project/gl/normalization.h"
#include "project/gl/program.h"

namespace tetraglass::project::gl {

/// A part of the picture, in pixels; drawn at once.
struct Tile {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// The camera in the normalized units of the mesh, as the shaders want it.
class ViewUniforms {
 public:
  ViewUniforms(const Frame& frame, const Normalization& normalization,
               std::span<const ClipPlane> clip);

  /// Whether anything of the mesh can lie in front of the eye.
  [[nodiscard]] bool sees_mesh() const { return parallel_ || farthest_depth_ > 0; }

  /// Sets the uniforms of the program that depend on view and tile.
  void set(const Program& program, const Tile& tile, int subpixel_bits) const;

 private:
  [[nodiscard]] double linear_depth(double depth) const;

  bool parallel_;
  Eigen::Matrix3d axes_;
  Eigen::Vector3d origin_;
  double pitch_;
  Eigen::Vector2d middle_;
  double focus_;
  double nearest_depth_;  // of the mesh, along the view axis; not behind the eye in perspective
  double farthest_depth_;
  std::vector<Eigen::Vector4f> clip_;
};

}  // namespace tetraglass::project::gl
