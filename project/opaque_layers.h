#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "project/camera.h"
#include "project/image.h"
#include "project/light/lights.h"
#include "project/opaque_geometry.h"

namespace tetraglass::project {

/// What a ray meets of the opaque geometry.
struct OpaqueFragment {
  double depth = 0;                 ///< along the view axis: the ray's parameter (see Frame)
  std::array<float, 3> color = {};  ///< linear, lit
  float coverage = 0;               ///< the part of the pixel, in (0, 1]; 1: nothing shows behind
};

/// Where the ray of each pixel ends, as a depth along the view axis: infinity where it does not,
/// -infinity where the pixel is not wanted. Row by row.
using RayEnds = std::span<const double>;

/// The opaque geometry of a scene as the rays of one view meet it.
///
/// Lines are antialiased: a pixel's coverage is that of a box of a pixel's width, and a pixel
/// partly covered shows both what there is with the line and without it,
///   coverage * (volume in front of the line, over its color) + (1 - coverage) * (the rest),
/// where the rest is the same with the next line, and at last the surface or the whole volume.
/// Surfaces cover whole pixels, decided at the pixel's centre without gaps between triangles; their
/// colors are those of isosurfaces (light/phong.h, default material). What lies at a line's width
/// behind another line, or less, is of one piece with it.
class OpaqueLayers {
 public:
  /// `samples`: pixels of the frame for one of the picture, each way (the widths of lines count in
  /// the picture's). Cost: linear in triangles and the pixels that they and the lines cover.
  OpaqueLayers(const OpaqueGeometry& geometry, const std::optional<Lights>& lights,
               const Frame& frame, int samples);

  /// Of a pixel, nearest first; the last one may be solid (coverage 1), the others are not.
  [[nodiscard]] std::span<const OpaqueFragment> fragments(int x, int y) const;

  /// The most fragments of a pixel that are not solid.
  [[nodiscard]] std::size_t partial_layers() const { return partial_layers_; }

  /// Where rays end that go as far as there is volume to see: at the solid fragment. Empty where
  /// there is none.
  [[nodiscard]] std::vector<double> solid_ends() const;

  /// Where rays end at their fragment number `layer` that is not solid; pixels that have none are
  /// not wanted.
  [[nodiscard]] std::vector<double> partial_ends(std::size_t layer) const;

  /// Memory.
  [[nodiscard]] std::size_t bytes() const {
    return fragments_.size() * sizeof(OpaqueFragment) +
           (starts_.size() + pixels_.size()) * sizeof(std::size_t);
  }

  /// The picture of the volume together with the opaque geometry; `draw` makes that of the volume
  /// alone, for rays that end where they are told (pixels that are not wanted may hold anything).
  /// It is called once, and once more for each of the partial layers.
  [[nodiscard]] Image compose(const std::function<Image(RayEnds)>& draw) const;

 private:
  void find_fragments(const OpaqueGeometry& geometry, const std::optional<Lights>& lights,
                      const Frame& frame, int samples);

  /// The same end for all pixels.
  [[nodiscard]] std::vector<double> all(double end) const;
  /// Of the covered pixel number i.
  [[nodiscard]] std::span<const OpaqueFragment> covering(std::size_t i) const {
    return std::span(fragments_).subspan(starts_[i], starts_[i + 1] - starts_[i]);
  }

  int width_;
  int height_;
  std::vector<std::size_t> pixels_;        // that are covered, ascending: y * width + x
  std::vector<OpaqueFragment> fragments_;  // pixel by pixel
  std::vector<std::size_t> starts_;        // of each covered pixel in fragments_, and the end
  std::size_t partial_layers_ = 0;
};

}  // namespace tetraglass::project
