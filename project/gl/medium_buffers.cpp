#include "project/gl/medium_buffers.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "project/gl/mesh_buffers.h"

namespace tetraglass::project::gl {
namespace {

// Many more than most transfer functions have points, and still in the first-level cache.
constexpr std::size_t kBins = 1024;

constexpr float kUnbounded = std::numeric_limits<float>::max();

Eigen::Vector4f medium_of(const preint::ControlPoint& point, double radius) {
  Eigen::Vector4d result;
  result << point.color.max(-MediumBuffers::kMostColor).min(MediumBuffers::kMostColor).matrix(),
      std::min(point.extinction * radius, MediumBuffers::kMostExtinction);
  return result.cast<float>();
}

std::vector<Eigen::Vector4f> pieces_of(const std::vector<preint::ControlPoint>& points,
                                       const std::vector<float>& values, double radius) {
  std::vector<Eigen::Vector4f> texels;
  const auto add = [&](float low, float high, const Eigen::Vector4f& at_low,
                       const Eigen::Vector4f& rise) {
    const bool bounded = low > -kUnbounded && high < kUnbounded && high > low;
    texels.emplace_back(low, high, bounded ? 1 / (high - low) : 0.0F, 0.0F);
    texels.push_back(at_low);
    texels.push_back(rise);
  };
  const Eigen::Vector4f none = Eigen::Vector4f::Zero();
  add(-kUnbounded, values.front(), medium_of(points.front(), radius), none);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Eigen::Vector4f low = medium_of(points[i], radius);
    add(values[i], values[i + 1], low, medium_of(points[i + 1], radius) - low);
  }
  add(values.back(), kUnbounded, medium_of(points.back(), radius), none);
  return texels;
}

// For each bin of [-1, 1] the number of control points not above the bin before it: the piece to
// start from. (One bin to spare: the shader may round a value into the next one.)
std::vector<std::uint32_t> index_of(const std::vector<float>& values) {
  std::vector<std::uint32_t> result(kBins);
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    const double low = 2 * (static_cast<double>(bin) - 1) / kBins - 1;
    const auto above = std::upper_bound(values.begin(), values.end(), static_cast<float>(low));
    result[bin] = bin == 0 ? 0 : static_cast<std::uint32_t>(above - values.begin());
  }
  return result;
}

}  // namespace

MediumBuffers::MediumBuffers(const Context& context, const preint::TransferFunction& tf,
                             const Normalization& normalization)
    : pieces_(context, Texel::rgba32f), index_(context, Texel::r32ui) {
  std::vector<float> values;
  for (const preint::ControlPoint& point : tf.points()) {
    values.push_back(normalization.value(point.value));
  }
  pieces_.upload(pieces_of(tf.points(), values, normalization.radius), "control points");
  index_.upload(index_of(values), "bins of the transfer function");
}

void MediumBuffers::bind() const {
  pieces_.bind(Units::kMediumPieces);
  index_.bind(Units::kMediumIndex);
}

}  // namespace tetraglass::project::gl
