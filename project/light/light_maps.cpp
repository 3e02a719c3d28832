#include "project/light/light_maps.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace tetraglass::project {
namespace {

/// Of every texel the sum of `response(direction, towards the source)` over the sources.
template <class F>
LightMap make_map(std::span<const LightSource> sources, int size, const F& response) {
  LightMap map{size, std::vector<float>(std::size_t{6} * 4 * size * size)};
  base::parallel_ranges(std::size_t{6} * size, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      const int face = static_cast<int>(row) / size;
      const int y = static_cast<int>(row) % size;
      for (int x = 0; x < size; ++x) {
        const Eigen::Vector3d direction = texel_direction(size, face, x, y);
        preint::Color sum = preint::Color::Zero();
        for (const LightSource& source : sources) {
          sum += source.color * response(direction.dot(source.place));
        }
        float* texel = map.rgba.data() + 4 * (row * size + x);
        for (int c = 0; c < 3; ++c) texel[c] = static_cast<float>(sum[c]);
      }
    }
  });
  return map;
}

}  // namespace

Eigen::Vector3d texel_direction(int size, int face, int x, int y) {
  const double s = 2 * (x + 0.5) / size - 1;
  const double t = 2 * (y + 0.5) / size - 1;
  const std::array<Eigen::Vector3d, 6> directions = {
      {{1, -t, -s}, {-1, -t, s}, {s, 1, t}, {s, -1, -t}, {s, -t, 1}, {-s, -t, -1}}};
  return directions[static_cast<std::size_t>(face)].normalized();
}

std::vector<LightSource> seen_from(std::span<const LightSource> sources,
                                   const Eigen::Vector3d& middle) {
  std::vector<LightSource> result(sources.begin(), sources.end());
  for (LightSource& source : result) {
    if (source.far_away) continue;
    source.place = (source.place - middle).stableNormalized();
    source.far_away = true;
  }
  return result;
}

LightMap diffuse_map(std::span<const LightSource> sources, int size) {
  return make_map(sources, size, [](double cosine) { return std::max(0.0, cosine); });
}

LightMap specular_map(std::span<const LightSource> sources, double shininess, int size) {
  return make_map(sources, size, [&](double cosine) {
    return cosine > 0 ? std::pow(std::min(cosine, 1.0), shininess) : 0;
  });
}

}  // namespace tetraglass::project
