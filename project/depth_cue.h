#pragma once

#include <algorithm>

namespace tetraglass::project {

/// Intensity depth-cueing (weiler2002, Fig. 11): isosurfaces darken with their distance from the
/// eye along the view axis, in world units; in parallel views from the plane through the eye.
struct DepthCue {
  double near = 0;  ///< up to here colors are as they are
  double far = 1;   ///< > near; from here on they are black. Opacity does not change

  /// What the shaded color at this depth is multiplied by, linear in between.
  [[nodiscard]] double intensity(double depth) const {
    return std::clamp((far - depth) / (far - near), 0.0, 1.0);
  }
};

}  // namespace tetraglass::project
