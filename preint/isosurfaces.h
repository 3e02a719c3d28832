#pragma once

#include <optional>
#include <vector>

#include "preint/transfer_function.h"

namespace tetraglass::preint {

struct Isosurface {
  double value = 0;
  Color color = Color::Ones();
  double opacity = 1;
};

/// Whether a ray on which the field goes from `front` to `back` crosses the surface. Half open:
/// exactly one of two adjacent segments that share an end value has the crossing, so nothing is
/// missed and nothing counted twice.
[[nodiscard]] inline bool crosses(double front, double back, double isovalue) {
  return (front < isovalue) != (back < isovalue);
}

/// The isosurfaces (indices) that the segment crosses, nearest first: isovalues ascending where the
/// field rises along the ray, descending where it falls (weiler2002 section 5.2).
[[nodiscard]] std::vector<std::size_t> crossed(const std::vector<Isosurface>& surfaces,
                                               double front, double back);

}  // namespace tetraglass::preint
