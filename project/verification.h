#pragma once

#include <cstddef>

#include "project/image.h"
#include "project/scene.h"

namespace tetraglass::project {

/// Errors of random pixels against the reference.
struct Verification {
  std::size_t pixels = 0;
  double max_error = 0;  ///< per channel, in the picture's own units
  double rms_error = 0;
};

/// Draws `count` random pixels (the same ones each time) by the reference projector, of grids by
/// the grid reference, and compares.
[[nodiscard]] Verification verify(const Scene& scene, const Image& image, int count);

}  // namespace tetraglass::project
