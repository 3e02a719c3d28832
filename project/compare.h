#pragma once

#include <cstddef>

#include "project/image.h"

namespace tetraglass::project {

/// How far two pictures of one size are apart, over all four channels.
struct Difference {
  double max = 0;
  double rms = 0;
  double psnr_db =
      0;  ///< 20 log10(1 / rms): for values in [0, 1]; infinite where the pictures are equal
  std::size_t pixels = 0;
  int worst_x = 0;  ///< the pixel with the largest difference
  int worst_y = 0;
};

/// Throws InputError where the sizes differ. A value that is not finite in one picture alone counts
/// as infinitely far.
[[nodiscard]] Difference compare(const Image& a, const Image& b);

/// |a - b| per channel, opaque, scaled so that `difference.max` is 1: for looking at.
[[nodiscard]] Image difference_image(const Image& a, const Image& b, const Difference& difference);

}  // namespace tetraglass::project
