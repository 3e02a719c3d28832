#include "preint/transfer_function.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/errors.h"

namespace tetraglass::preint {
namespace {

void check(const std::vector<ControlPoint>& points) {
  if (points.empty()) throw base::InputError("a transfer function needs at least one point");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ControlPoint& p = points[i];
    if (!std::isfinite(p.value) || !p.color.isFinite().all() || !std::isfinite(p.extinction)) {
      throw base::InputError(
          fmt::format("points[{}]: value, color and extinction must be finite", i));
    }
    const Material& m = p.material;
    for (const double k : {m.ambient, m.diffuse, m.specular, m.shininess}) {
      if (!(k >= 0) || !std::isfinite(k)) {
        throw base::InputError(fmt::format(
            "points[{}]: ambient, diffuse, specular and shininess must be finite and not negative, "
            "one is {}",
            i, k));
      }
    }
    if (p.extinction < 0) {
      throw base::InputError(
          fmt::format("points[{}]: extinction must not be negative, it is {}", i, p.extinction));
    }
    if (i > 0 && p.value < points[i - 1].value) {
      throw base::InputError(fmt::format("points[{}]: values must not decrease, {} comes after {}",
                                         i, p.value, points[i - 1].value));
    }
    if (i > 1 && p.value == points[i - 2].value) {
      throw base::InputError(fmt::format(
          "points[{}]: at most two points may have the same value ({}); two of them make a jump", i,
          p.value));
    }
  }
  if (!std::isfinite(points.back().value - points.front().value)) {
    throw base::InputError(fmt::format("the values from {} to {} span more than a double can hold",
                                       points.front().value, points.back().value));
  }
}

/// Between two points of different values. Weights of both ends, not one end plus a slope: each
/// weight is a quotient of exactly rounded differences, so an extinction that falls to 0 keeps its
/// relative accuracy there.
Medium interpolate(const ControlPoint& lower, const ControlPoint& upper, double value) {
  const double span = upper.value - lower.value;
  const double a = (upper.value - value) / span;
  const double b = (value - lower.value) / span;
  return {a * lower.color + b * upper.color, a * lower.extinction + b * upper.extinction};
}

}  // namespace

TransferFunction::TransferFunction(std::vector<ControlPoint> points) : points_(std::move(points)) {
  check(points_);
}

std::size_t TransferFunction::interval_above(double value) const {
  const auto greater = [](double v, const ControlPoint& p) { return v < p.value; };
  const auto end = std::upper_bound(points_.begin(), points_.end(), value, greater);
  return static_cast<std::size_t>(end - points_.begin());
}

std::size_t TransferFunction::interval_below(double value) const {
  const auto less = [](const ControlPoint& p, double v) { return p.value < v; };
  const auto end = std::lower_bound(points_.begin(), points_.end(), value, less);
  return static_cast<std::size_t>(end - points_.begin());
}

Medium TransferFunction::in_interval(std::size_t interval, double value) const {
  if (interval == 0) return {points_.front().color, points_.front().extinction};
  if (interval == points_.size()) return {points_.back().color, points_.back().extinction};
  return interpolate(points_[interval - 1], points_[interval], value);
}

Medium TransferFunction::at(double value) const {
  return in_interval(interval_above(value), value);
}

Medium TransferFunction::below(double value) const {
  return in_interval(interval_below(value), value);
}

double TransferFunction::max_extinction(double low, double high) const {
  if (low > high) std::swap(low, high);
  const std::size_t first = interval_above(low);
  const std::size_t end = interval_above(high);
  double result = std::max(at(low).extinction, at(high).extinction);
  for (std::size_t i = first; i < end; ++i) result = std::max(result, points_[i].extinction);
  return result;
}

Material TransferFunction::material_at(double value) const {
  const std::size_t i = interval_above(value);
  if (i == 0) return points_.front().material;
  if (i == points_.size()) return points_.back().material;
  const double span = points_[i].value - points_[i - 1].value;
  const double part = (value - points_[i - 1].value) / span;
  const Material& lower = points_[i - 1].material;
  const Material& upper = points_[i].material;
  // Where both are the same, so is what lies between, to the last bit.
  const auto between = [&](double a, double b) { return a + part * (b - a); };
  return {between(lower.ambient, upper.ambient), between(lower.diffuse, upper.diffuse),
          between(lower.specular, upper.specular), between(lower.shininess, upper.shininess)};
}

TransferFunction materials_as_colors(const TransferFunction& tf) {
  std::vector<ControlPoint> points = tf.points();
  for (ControlPoint& p : points) {
    p.color = {p.material.ambient, p.material.diffuse, p.material.specular};
  }
  return TransferFunction(std::move(points));
}

TransferFunction mirrored(const TransferFunction& tf) {
  std::vector<ControlPoint> points(tf.points().rbegin(), tf.points().rend());
  for (ControlPoint& p : points) p.value = -p.value;
  return TransferFunction(std::move(points));
}

}  // namespace tetraglass::preint
