#pragma once

#include <array>
#include <string>
#include <vector>

#include "project/image.h"

namespace tetraglass::project {

/// What stands behind the picture in a .png: linear RGB, not premultiplied, and an opacity.
struct Background {
  std::array<double, 3> rgb = {0, 0, 0};
  double alpha = 1;
};

/// The extensions that `write_image` and `read_image` know: .png, .exr, .npy.
[[nodiscard]] std::vector<std::string> image_extensions();

/// What writing to 8 bits lost.
struct WriteReport {
  std::size_t clipped_pixels = 0;  ///< brighter than white in some channel
};

/// Writes by the extension: .png (8 bit RGBA, composited over the background, sRGB-encoded), .exr
/// (32-bit float RGBA as it is), .npy (height x width x 4 float32 as it is). The file appears whole
/// or not at all. Throws WriteError.
WriteReport write_image(const Image& image, const std::string& file,
                        const Background& background = {});

/// A picture read back, and whether its values are sRGB-encoded (.png) or linear.
struct ReadImage {
  Image image;
  bool encoded = false;  ///< [0, 1] sRGB, not premultiplied
};

/// Reads what `write_image` writes (.png of any depth and color type, .exr, .npy of float32 or
/// float64, C order). Throws ReadError.
[[nodiscard]] ReadImage read_image(const std::string& file);

/// The sRGB transfer curve (IEC 61966-2-1), [0, 1] to [0, 1].
[[nodiscard]] double srgb_encode(double linear);
[[nodiscard]] double srgb_decode(double encoded);

/// The picture as a .png holds it, in [0, 1] before rounding to 8 bits: composited over the
/// background (linear light), encoded.
[[nodiscard]] Image encode(const Image& image, const Background& background);

}  // namespace tetraglass::project
