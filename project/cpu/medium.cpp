#include "project/cpu/medium.h"

#include <algorithm>
#include <cstddef>

#include "base/parallel.h"

namespace tetraglass::project::cpu {
namespace {

constexpr double kMostExtinction = 1e30;

MediumInterval interval(const preint::Medium& low_end, const preint::Medium& high_end, float low,
                        float high, double radius) {
  const auto extinction = [&](const preint::Medium& end) {
    return static_cast<float>(std::min(end.extinction * radius, kMostExtinction));
  };
  MediumInterval result;
  result.low = low;
  result.high = high;
  result.inverse_width = 1 / (high - low);
  result.extinction = extinction(low_end);
  result.extinction_rise = extinction(high_end) - result.extinction;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto channel = static_cast<Eigen::Index>(c);
    result.color[c] = static_cast<float>(low_end.color[channel]);
    result.color_rise[c] = static_cast<float>(high_end.color[channel]) - result.color[c];
  }
  return result;
}

/// Calls visit(i, low, high, scaled_low, scaled_high) for the intervals i of the transfer function
/// that the field's range meets, ascending; those narrower than floats can tell are left out.
template <class Visit>
void for_each_interval(const preint::TransferFunction& tf, const ValueScale& scale,
                       const Visit& visit) {
  const std::vector<preint::ControlPoint>& points = tf.points();
  for (std::size_t i = 0; i <= points.size(); ++i) {
    // The ends as values of the field, cut to its range.
    double low = scale.value(-1);
    double high = scale.value(1);
    if (i > 0) low = std::max(low, points[i - 1].value);
    if (i < points.size()) high = std::min(high, points[i].value);
    const float scaled_low = std::max(-1.0F, scale.scaled(low));
    const float scaled_high = std::min(1.0F, scale.scaled(high));
    if (scaled_low < scaled_high) visit(i, low, high, scaled_low, scaled_high);
  }
}

/// The material at a value of interval i: at a jump, that of the interval's side.
preint::Material material_in_interval(const preint::TransferFunction& tf, std::size_t i,
                                      double value) {
  const bool at_upper_end = i < tf.points().size() && value == tf.points()[i].value;
  return at_upper_end ? tf.points()[i].material : tf.material_at(value);
}

std::array<float, 4> coefficients(const preint::Material& m) {
  return {static_cast<float>(m.ambient), static_cast<float>(m.diffuse),
          static_cast<float>(m.specular), static_cast<float>(m.shininess)};
}

}  // namespace

Medium::Medium(const preint::TransferFunction& tf, const ValueScale& scale, double radius) {
  for_each_interval(
      tf, scale, [&](std::size_t i, double low, double high, float scaled_low, float scaled_high) {
        intervals_.push_back(interval(tf.in_interval(i, low), tf.in_interval(i, high), scaled_low,
                                      scaled_high, radius));
      });
}

std::vector<MaterialInterval> material_intervals(const preint::TransferFunction& tf,
                                                 const ValueScale& scale) {
  std::vector<MaterialInterval> result;
  for_each_interval(tf, scale, [&](std::size_t i, double low, double high, float, float) {
    MaterialInterval interval;
    interval.low = coefficients(material_in_interval(tf, i, low));
    const std::array<float, 4> upper = coefficients(material_in_interval(tf, i, high));
    for (std::size_t k = 0; k < 4; ++k) interval.rise[k] = upper[k] - interval.low[k];
    result.push_back(interval);
  });
  return result;
}

IntervalRange Medium::range(float low, float high) const {
  const auto above = [&](float value) {
    const auto found =
        std::upper_bound(intervals_.begin(), intervals_.end() - 1, value,
                         [](float v, const MediumInterval& interval) { return v < interval.high; });
    return static_cast<std::uint32_t>(found - intervals_.begin());
  };
  const std::uint32_t first = above(low);
  std::uint32_t last = above(high);
  if (last > first && intervals_[last].low == high) --last;
  return {first, last};
}

std::array<float, 3> Medium::color(float value) const {
  const MediumInterval& interval = intervals_[range(value, value).first];
  const float t =
      (std::clamp(value, interval.low, interval.high) - interval.low) * interval.inverse_width;
  std::array<float, 3> result{};
  for (std::size_t c = 0; c < 3; ++c) {
    result[c] = interval.color[c] + t * interval.color_rise[c];
  }
  return result;
}

std::vector<IntervalRange> cell_intervals(const Medium& medium, const DrawnCells& cells) {
  std::vector<IntervalRange> result(cells.size());
  constexpr std::size_t kGrain = 4096;  // some 100 us of work
  base::parallel_ranges(cells.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!cells.cell_values.empty()) {
        result[i] = medium.range(cells.cell_values[i], cells.cell_values[i]);
        continue;
      }
      const mesh::Cell& v = cells.cells[i].vertices;
      const std::vector<float>& values = cells.point_values;
      const auto [low, high] =
          std::minmax({values[v[0]], values[v[1]], values[v[2]], values[v[3]]});
      result[i] = medium.range(low, high);
    }
  });
  return result;
}

}  // namespace tetraglass::project::cpu
