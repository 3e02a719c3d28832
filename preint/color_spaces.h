#pragma once

#include <cstdint>

#include "preint/transfer_function.h"

namespace tetraglass::preint {

/// IEC 61966-2-1, one channel in [0, 1].
[[nodiscard]] double linear_from_srgb(double srgb);

/// The spaces in which ParaView interpolates the colors of a map.
enum class ColorSpace { rgb, hsv, lab, diverging };

/// From `a` (t = 0) to `b` (t = 1), both sRGB in [0, 1]; the result is sRGB, cut to [0, 1].
/// diverging: Moreland, "Diverging color maps for scientific visualization", ISVC 2009: polar
/// coordinates of Lab, by way of white where the hues lie far apart.
[[nodiscard]] Color interpolate_srgb(ColorSpace space, const Color& a, const Color& b, double t);

}  // namespace tetraglass::preint
