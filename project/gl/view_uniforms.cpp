#include "project/gl/view_uniforms.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace tetraglass::project::gl {

ViewUniforms::ViewUniforms(const Frame& frame, const Normalization& normalization,
                           const Scene& scene)
    : parallel_(frame.parallel()),
      axes_(frame.axes()),
      origin_(frame.to_camera(normalization.center) / normalization.radius),
      pitch_(frame.pitch()),
      middle_(frame.middle()),
      focus_(origin_.z()),
      nearest_depth_(origin_.z() - 1),
      farthest_depth_(origin_.z() + 1) {
  // The mesh lies in the unit sphere around the origin but for the rounding of its points.
  constexpr double kRounding = 1e-6;
  nearest_depth_ -= kRounding;
  farthest_depth_ += kRounding;
  if (parallel_) {
    pitch_ /= normalization.radius;
  } else {
    // Depths beyond the focus lose digits (farthest / focus): at most a factor of 2 this way.
    focus_ = std::max(focus_, 1.0);
    nearest_depth_ = std::max(nearest_depth_, 0.0);
  }
  // Farther off than the mesh is large they keep all of it or nothing.
  constexpr double kFar = 1e9;
  for (const ClipPlane& plane : scene.clip) {
    const double size = plane.normal.norm();
    const Eigen::Vector3d normal = axes_ * plane.normal / size;
    const double offset =
        (plane.offset - plane.normal.dot(normalization.center)) / (size * normalization.radius);
    const double room = offset + normal.dot(origin_ - Eigen::Vector3d(0, 0, focus_));
    clip_.emplace_back(normal.cast<float>().x(), normal.cast<float>().y(), normal.cast<float>().z(),
                       static_cast<float>(std::clamp(room, -kFar, kFar)));
  }
  if (scene.depth_cue) {
    const double far = scene.depth_cue->far / normalization.radius - focus_;
    const double range = (scene.depth_cue->far - scene.depth_cue->near) / normalization.radius;
    depth_cue_ = {static_cast<float>(std::clamp(far, -1e30, 1e30)),
                  static_cast<float>(std::min(1 / range, 1e30))};
  }
}

// Z of face_planes.glsl, not beyond what floats hold at the eye.
double ViewUniforms::linear_depth(double depth) const {
  if (parallel_) return depth - focus_;
  return depth > 0 ? std::max((depth - focus_) * focus_ / depth, -1e30) : -1e30;
}

void ViewUniforms::set(const Program& program, const Tile& tile, int subpixel_bits) const {
  program.set("axes", axes_);
  program.set("origin", origin_);
  program.set("pitch", pitch_);
  program.set("middle", middle_);
  program.set("focus", focus_);
  program.set("tile_origin", Eigen::Vector2d(tile.x, tile.y));
  program.set("tile_size", Eigen::Vector2d(tile.width, tile.height));

  // For the layouts that place their vertices in floats: a point's product with the matrix is
  // (2 x / width - w, 2 y / height - w, 0, w), x and y its pixel position in the tile times w.
  Eigen::Matrix<double, 3, 4> camera;
  camera << axes_, origin_;
  Eigen::Matrix4d clip = Eigen::Matrix4d::Zero();
  if (parallel_) {
    clip(3, 3) = 1;
  } else {
    clip.row(3) = camera.row(2);
  }
  const Eigen::Vector2d middle = middle_ - Eigen::Vector2d(tile.x, tile.y);
  clip.row(0) =
      (2 / pitch_ * camera.row(0) + 2 * middle.x() * clip.row(3)) / tile.width - clip.row(3);
  clip.row(1) =
      (-2 / pitch_ * camera.row(1) + 2 * middle.y() * clip.row(3)) / tile.height - clip.row(3);
  program.set("to_clip", Eigen::Matrix4f(clip.cast<float>()));
  program.set("eye", Eigen::Vector3f((-axes_.transpose() * origin_).cast<float>()));
  program.set("direction", Eigen::Vector3f(axes_.row(2).transpose().cast<float>()));
  Eigen::Vector4d depth = camera.row(2);
  depth.w() -= focus_;
  program.set("to_depth", Eigen::Vector4f(depth.cast<float>()));

  // Vertices are exact to 2^-25 sqrt(3) units, planes to 2^-24 of the distance from their anchor on
  // the screen: twice as much moves a ray off any edge that it would meet but for rounding. Four
  // times as far to the right as up, so that up counts where right does not.
  const double pixels_per_unit = 1 / (parallel_ ? pitch_ : pitch_ * focus_);
  const double up = std::ldexp(std::max(2 * middle_.maxCoeff(), pixels_per_unit), -23);
  program.set("tie_shift", Eigen::Vector2d(4 * up, up));

  // What the rasterizer rounds: to half a subpixel each way; before that to floats, of positions up
  // to 16 tiles off (2^-20 tiles, and as much in the viewport transform). Twice that, since a
  // needle's tip keeps half of it.
  const double rounded =
      std::sqrt(2.0) * (std::ldexp(0.5, -subpixel_bits) +
                        std::ldexp(std::max(tile.width, tile.height), -19) + 4 * up);
  program.set("margin", static_cast<float>(2 * rounded));

  for (std::size_t i = 0; i < clip_.size(); ++i) {
    program.set(fmt::format("clip_planes[{}]", i).c_str(), clip_[i]);
  }
  program.set("tile_corner", Eigen::Vector2f(tile.x, tile.y));
  program.set("picture_middle", Eigen::Vector2f(middle_.cast<float>()));
  program.set("pixel_pitch", static_cast<float>(pitch_));
  program.set("focus_inverse", parallel_ ? 0.0F : static_cast<float>(1 / focus_));
  program.set("nearest", static_cast<float>(linear_depth(nearest_depth_)));
  program.set("farthest", static_cast<float>(linear_depth(farthest_depth_)));
  program.set("depth_cue", depth_cue_);
  program.set("depth_range",
              Eigen::Vector2f(nearest_depth_ - focus_, 1 / (farthest_depth_ - nearest_depth_)));
}

}  // namespace tetraglass::project::gl
