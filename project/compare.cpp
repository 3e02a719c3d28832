#include "project/compare.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/errors.h"

namespace tetraglass::project {
namespace {

double distance(float a, float b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
  const double d = std::abs(static_cast<double>(a) - static_cast<double>(b));
  return std::isfinite(d) ? d : std::numeric_limits<double>::infinity();
}

}  // namespace

Difference compare(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height) {
    throw base::InputError(fmt::format("the pictures have different sizes: {} x {} and {} x {}",
                                       a.width, a.height, b.width, b.height));
  }
  Difference result;
  result.pixels = a.rgba.size() / 4;
  double squares = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      for (int c = 0; c < 4; ++c) {
        const double d = distance(a.pixel(x, y)[c], b.pixel(x, y)[c]);
        squares += d * d;
        if (d > result.max) {
          result.max = d;
          result.worst_x = x;
          result.worst_y = y;
        }
      }
    }
  }
  result.rms = std::sqrt(squares / static_cast<double>(std::max<std::size_t>(1, a.rgba.size())));
  result.psnr_db = -20 * std::log10(result.rms);
  return result;
}

Image difference_image(const Image& a, const Image& b, const Difference& difference) {
  Image result(a.width, a.height);
  const double scale = difference.max > 0 && std::isfinite(difference.max) ? 1 / difference.max : 0;
  for (std::size_t i = 0; i < result.rgba.size(); ++i) {
    const double d = std::min(distance(a.rgba[i], b.rgba[i]) * scale, 1.0);
    result.rgba[i] = i % 4 == 3 ? 1.0F : static_cast<float>(std::isnan(d) ? 1.0 : d);
  }
  return result;
}

}  // namespace tetraglass::project
