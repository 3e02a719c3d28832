#pragma once

#include <cstddef>
#include <optional>

#include "project/gl/objects.h"
#include "project/gl/program.h"
#include "project/scene.h"
#include "project/slices/shown_blocks.h"
#include "project/slices_plan.h"

namespace tetraglass::project::slices {

/// The points of a grid in a texture: their values, normalized (ValueScale), or, classified before
/// interpolation, the color (associated) and the opacity of a slab of a nominal length around them
/// (wilson1994: alpha = 1 - exp(-kappa length), C = c alpha). Of one block after the other in the
/// same texture: drivers make shaders anew for textures of another size.
class GridTexture {
 public:
  /// With room for so many points along each axis; finite everywhere. `layers`: the axis across
  /// which they lie in 2D textures; else they are one 3D texture. Refers to the scene and the plan,
  /// which outlive it. Throws UnavailableError where the context cannot hold it.
  GridTexture(const gl::Context& context, const Scene& scene, const SlicesPlan& plan,
              const Eigen::Vector3i& room, std::optional<int> layers);

  /// Puts the points of `block` there, for which there is room, in place of those before. `length`:
  /// of the slab, in world units.
  void load(const Block& block, double length);

  /// Makes it the texture of a unit and tells the program how to read it (grid_sample.glsl).
  void bind(const gl::Program& program, int unit) const;

  [[nodiscard]] const Eigen::Vector3i& room() const { return room_; }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  const Scene& scene_;
  const SlicesPlan& plan_;
  Eigen::Vector3i room_;
  std::optional<int> layers_;
  gl::Name texture_;
  Eigen::Vector3f scale_;   // from places in units of points ...
  Eigen::Vector3f offset_;  // ... to texture coordinates
  int last_layer_ = 0;
  Eigen::Vector2f value_;  // factor and summand that make a texel a number
  std::size_t bytes_ = 0;
};

/// How many points the block has along each axis.
[[nodiscard]] Eigen::Vector3i points_of(const Block& block);

/// The bytes of a texture that is not compressed for each point.
[[nodiscard]] std::size_t bytes_per_point(const SlicesPlan& plan);

}  // namespace tetraglass::project::slices
