#pragma once

#include <vector>

#include "project/camera.h"
#include "project/gl/normalization.h"
#include "project/gl/program.h"
#include "project/scene.h"

namespace tetraglass::project::gl {

/// A part of the picture, in pixels; drawn at once.
struct Tile {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// The camera, and what of the scene is placed by it (clip planes, depth cue), in the normalized
/// units of the mesh, as the shaders want it.
class ViewUniforms {
 public:
  ViewUniforms(const Frame& frame, const Normalization& normalization, const Scene& scene);

  /// Whether anything of the mesh can lie in front of the eye.
  [[nodiscard]] bool sees_mesh() const { return parallel_ || farthest_depth_ > 0; }

  /// The depth, in units of the normalization, that depths are counted from.
  [[nodiscard]] double focus() const { return focus_; }

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
  Eigen::Vector2f depth_cue_ = Eigen::Vector2f::Zero();  // far - focus; 1 / (far - near)
};

}  // namespace tetraglass::project::gl
