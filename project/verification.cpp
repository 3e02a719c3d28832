#include "project/verification.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "project/reference/grid_reference.h"
#include "project/reference/reference.h"

namespace tetraglass::project {

Verification verify(const Scene& scene, const Image& image, int count) {
  std::mt19937 random;  // the default seed: the same pixels each time
  // Not uniform_int_distribution: its values differ between standard libraries.
  const auto below = [&](int limit) {
    return static_cast<int>(random() % static_cast<std::uint32_t>(limit));
  };
  std::vector<Eigen::Vector2i> pixels;
  pixels.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const int x = below(image.width);
    pixels.emplace_back(x, below(image.height));
  }
  const std::vector<Eigen::Array4d> expected =
      scene.grid ? grid_reference_pixels(scene, pixels) : reference_pixels(scene, pixels);
  Verification result;
  result.pixels = pixels.size();
  double squares = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const float* actual = image.pixel(pixels[i].x(), pixels[i].y());
    for (int c = 0; c < 4; ++c) {
      const double error = std::abs(static_cast<double>(actual[c]) - expected[i][c]);
      result.max_error = std::max(result.max_error, error);
      squares += error * error;
    }
  }
  result.rms_error =
      std::sqrt(squares / (4.0 * static_cast<double>(std::max<std::size_t>(1, pixels.size()))));
  return result;
}

}  // namespace tetraglass::project
