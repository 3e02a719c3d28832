#pragma once

#include <array>

#include <Eigen/Core>

namespace tetraglass::sort {

/// The image of a face, each coordinate off by at most 2^-49 of `size`, which is no less than the
/// largest of them.
struct ImageTriangle {
  std::array<Eigen::Vector2d, 3> corners;
  double size = 0;

  ImageTriangle() { corners.fill(Eigen::Vector2d::Zero()); }
  ImageTriangle(const std::array<Eigen::Vector2d, 3>& at, double largest)
      : corners(at), size(largest) {}
};

/// Whether the interiors of two triangles overlap.
enum class Overlap { none, some, uncertain };

/// `none` and `some` are certain for the exact images too; `uncertain` where rounding leaves it
/// open, as for triangles that share a corner.
[[nodiscard]] Overlap find_overlap(const ImageTriangle& a, const ImageTriangle& b);

}  // namespace tetraglass::sort
