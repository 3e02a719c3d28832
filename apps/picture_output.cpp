#include "apps/picture_output.h"

#include <algorithm>
#include <cstddef>

namespace tetraglass::apps {
namespace {

using project::Mode;

float largest_length(const project::Image& image) {
  float longest = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) longest = std::max(longest, image.rgba[i]);
  return longest;
}

}  // namespace

project::Image scaled_for_8_bits(const project::Image& image, Mode mode) {
  project::Image scaled = image;
  if (mode != Mode::thickness) return scaled;
  const float longest = largest_length(image);
  if (longest > 0) {
    for (std::size_t i = 0; i < scaled.rgba.size(); ++i) {
      if (i % 4 != 3) scaled.rgba[i] /= longest;
    }
  }
  return scaled;
}

}  // namespace tetraglass::apps
