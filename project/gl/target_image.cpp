#include "project/gl/target_image.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <tbb/parallel_for.h>

#include "project/gl/switches.h"

namespace tetraglass::project::gl {
namespace {

// Normalized values lie in [-1, 1]; every format holds this one.
constexpr float kNoValue = -2;

float finite(double value) {
  constexpr double kMost = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(value, -kMost, kMost));
}

// The RGBA of a pixel of a scalar target.
void resolve(const Scene& scene, const Normalization& normalization, float value, float* rgba) {
  if (scene.mode == Mode::thickness) {
    std::fill_n(rgba, 3, finite(value * normalization.radius));
    rgba[3] = value > 0 ? 1.0F : 0.0F;
  } else if (scene.mode == Mode::absorption) {
    rgba[3] = static_cast<float>(-std::expm1(-static_cast<double>(value)));
  } else if (value != kNoValue) {
    const double largest = normalization.field_value(value);
    const preint::Color color = scene.transfer_function.at(largest).color;
    for (int c = 0; c < 3; ++c) rgba[c] = finite(color[c]);
    rgba[3] = 1;
  }
}

}  // namespace

Texel target_texel(const Scene& scene, TargetFormat format) {
  const bool scalar = has_scalar_target(scene);
  switch (format) {
    case TargetFormat::rgba32f:
      return scalar ? Texel::r32f : Texel::rgba32f;
    case TargetFormat::rgba16f:
      return scalar ? Texel::r16f : Texel::rgba16f;
    case TargetFormat::rgba8:
      break;
  }
  return Texel::rgba8;
}

float empty_pixel(const Scene& scene) {
  return is_field_maximum(scene) ? kNoValue : 0;
}

void read_tile(const Target& target, const Scene& scene, const Normalization& normalization,
               const Tile& tile, Image& image) {
  if (has_scalar_target(scene)) {
    const auto width = static_cast<std::size_t>(tile.width);
    std::vector<float> values(width * static_cast<std::size_t>(tile.height));
    target.read(tile.width, tile.height, values.data(), tile.width);
    tbb::parallel_for(0, tile.height, [&](int y) {
      const float* row = values.data() + static_cast<std::size_t>(y) * width;
      for (int x = 0; x < tile.width; ++x) {
        resolve(scene, normalization, row[x], image.pixel(tile.x + x, tile.y + y));
      }
    });
    return;
  }
  target.read(tile.width, tile.height, image.pixel(tile.x, tile.y), image.width);
  tbb::parallel_for(0, tile.height, [&](int y) {
    float* row = image.pixel(tile.x, tile.y + y);
    for (int i = 0; i < 4 * tile.width; ++i) row[i] = finite(row[i]);
  });
}

}  // namespace tetraglass::project::gl
