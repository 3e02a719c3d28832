#include "preint/transfer_function_edit.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include <fmt/format.h>

#include "base/errors.h"

namespace tetraglass::preint {

TransferFunction scale_extinction(const TransferFunction& tf, double factor) {
  if (!(factor >= 0) || !std::isfinite(factor)) {
    throw base::UsageError(fmt::format("extinction cannot be scaled by {}", factor));
  }
  std::vector<ControlPoint> points = tf.points();
  for (ControlPoint& p : points) p.extinction *= factor;
  return TransferFunction(std::move(points));
}

TransferFunction with_extinction_of(const TransferFunction& colors,
                                    const TransferFunction& extinction) {
  std::set<double> values;
  std::set<double> jumps;
  for (const TransferFunction* tf : {&colors, &extinction}) {
    double previous = std::nan("");
    for (const ControlPoint& p : tf->points()) {
      values.insert(p.value);
      if (p.value == previous) jumps.insert(p.value);
      previous = p.value;
    }
  }
  std::vector<ControlPoint> points;
  for (const double v : values) {
    if (jumps.count(v) > 0) {
      const std::size_t i = colors.interval_below(v);
      const bool has_point = i < colors.points().size() && colors.points()[i].value == v;
      const Material lower = has_point ? colors.points()[i].material : colors.material_at(v);
      points.push_back({v, colors.below(v).color, extinction.below(v).extinction, lower});
    }
    points.push_back({v, colors.at(v).color, extinction.at(v).extinction, colors.material_at(v)});
  }
  return TransferFunction(std::move(points));
}

TransferFunction with_logarithmic_values(const TransferFunction& tf) {
  const double low = tf.points().front().value;
  const double high = tf.points().back().value;
  if (!(low > 0)) {
    throw base::InputError(fmt::format(
        "logarithmic values need a range above 0, but the transfer function begins at {}", low));
  }
  if (low == high) return tf;
  const double stretch = std::log(high / low) / (high - low);
  const auto moved = [&](double value) {
    return std::clamp(low * std::exp((value - low) * stretch), low, high);
  };
  std::vector<ControlPoint> points;
  const auto add = [&](ControlPoint p, double value) {
    p.value = points.empty() ? value : std::max(value, points.back().value);
    points.push_back(p);
  };
  add(tf.points().front(), low);
  for (std::size_t i = 1; i < tf.points().size(); ++i) {
    const ControlPoint& a = tf.points()[i - 1];
    const ControlPoint& b = tf.points()[i];
    // A chord of the logarithm over the ratio exp(u) errs by at most u^2 / 8; the whole interval is
    // (b - a) stretch.
    const double u = (b.value - a.value) * stretch;
    const int parts = std::max(1, static_cast<int>(std::ceil(std::sqrt(128 * u))));
    for (int part = 1; part < parts; ++part) {
      const double t = static_cast<double>(part) / parts;
      const double value = a.value * (1 - t) + b.value * t;
      const double place = moved(value);
      if (place <= points.back().value) continue;
      const Medium medium = tf.at(value);
      add({0, medium.color, medium.extinction, tf.material_at(value)}, place);
    }
    add(b, i + 1 == tf.points().size() ? high : moved(b.value));
  }
  return TransferFunction(std::move(points));
}

TransferFunction tents(std::vector<double> isovalues, double half_width, double opacity,
                       const std::string& colors, double low, double high, double diagonal) {
  const TransferFunction map = preset(colors, low, high, diagonal);
  const bool finite =
      std::all_of(isovalues.begin(), isovalues.end(), [](double v) { return std::isfinite(v); });
  if (isovalues.empty() || !finite) throw base::UsageError("tents need isovalues, all finite");
  if (!(half_width > 0) || !(opacity >= 0 && opacity < 1) || !(low < high)) {
    throw base::UsageError(
        fmt::format("tents need a half width > 0, an opacity from 0 to below 1 and a range with "
                    "low < high, not {}, {} and {}:{}",
                    half_width, opacity, low, high));
  }
  std::sort(isovalues.begin(), isovalues.end());
  isovalues.erase(std::unique(isovalues.begin(), isovalues.end()), isovalues.end());
  std::vector<ControlPoint> points;
  for (std::size_t i = 0; i < isovalues.size(); ++i) {
    const double value = isovalues[i];
    double reach = half_width;
    if (i > 0) reach = std::min(reach, (value - isovalues[i - 1]) / 2);
    if (i + 1 < isovalues.size()) reach = std::min(reach, (isovalues[i + 1] - value) / 2);
    // The ray is in the tent for the length diagonal * 2 reach / (high - low), at half the peak on
    // average.
    const double peak = -std::log1p(-opacity) * (high - low) / (reach * diagonal);
    const Color color = map.at(value).color;
    const double begin =
        points.empty() ? value - reach : std::max(points.back().value, value - reach);
    points.push_back({begin, color, 0});
    points.push_back({value, color, peak});
    points.push_back({value + reach, color, 0});
  }
  return TransferFunction(std::move(points));
}

Histogram histogram(std::span<const double> values, double low, double high, std::size_t bins) {
  if (!(low < high) || !std::isfinite(high - low) || bins == 0) {
    throw base::UsageError(
        fmt::format("a histogram needs low < high and bins, not {}:{} and {}", low, high, bins));
  }
  Histogram result{low, high, std::vector<std::uint64_t>(bins)};
  for (const double v : values) {
    if (!(v >= low && v <= high)) continue;
    const double place = (v - low) / (high - low) * static_cast<double>(bins);
    ++result.counts[std::min(static_cast<std::size_t>(place), bins - 1)];
  }
  return result;
}

TransferFunction automatic_extinction(const TransferFunction& tf, const Histogram& histogram,
                                      double mean_depth, double diagonal) {
  const std::size_t bins = histogram.counts.size();
  const auto total = static_cast<double>(
      std::accumulate(histogram.counts.begin(), histogram.counts.end(), std::uint64_t{0}));
  if (total == 0) throw base::InputError("the field has no values to choose an opacity from");
  if (!(mean_depth > 0) || !(diagonal > 0)) {
    throw base::UsageError(fmt::format("optical depth and diagonal must be positive, not {} and {}",
                                       mean_depth, diagonal));
  }
  std::vector<ControlPoint> shape;
  double mean = 0;
  for (std::size_t i = 0; i < bins; ++i) {
    const double t = (static_cast<double>(i) + 0.5) / static_cast<double>(bins);
    const double share = static_cast<double>(histogram.counts[i]) / total;
    const double extinction = 1 / (1 + share * static_cast<double>(bins));
    shape.push_back({histogram.low * (1 - t) + histogram.high * t, Color::Zero(), extinction});
    mean += share * extinction;
  }
  const TransferFunction extinction =
      scale_extinction(TransferFunction(shape), mean_depth / (mean * diagonal));

  return with_extinction_of(tf, extinction);
}

}  // namespace tetraglass::preint
