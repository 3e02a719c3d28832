#include "sort/power_keys.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace tetraglass::sort {
namespace {

constexpr std::uint32_t kLast = std::numeric_limits<std::uint32_t>::max();

double power_of_two_above(double x) {
  int exponent = 0;
  std::frexp(x, &exponent);
  return std::ldexp(1.0, std::clamp(exponent, -1000, 1000));
}

// `joined` takes the second range into the first one if they overlap, and says whether they do.
template <typename T, typename Begin, typename Join>
void join(std::vector<T>& ranges, const Begin& begin, const Join& joined) {
  std::sort(ranges.begin(), ranges.end(),
            [&](const T& a, const T& b) { return begin(a) < begin(b); });
  std::size_t count = 0;
  for (const T& range : ranges) {
    if (count == 0 || !joined(ranges[count - 1], range)) ranges[count++] = range;
  }
  ranges.resize(count);
}

}  // namespace

PowerOfEye::PowerOfEye(const View& view, const Eigen::Vector3d& middle) : constant_(0) {
  if (view.parallel) {
    linear_ = view.direction;
  } else {
    // |center - e|^2 - radius^2, less |e|^2, scaled by a power of two lest it overflow.
    const Eigen::Vector3d half = 0.5 * view.eye - 0.5 * middle;
    int exponent = 0;
    std::frexp(half.cwiseAbs().maxCoeff(), &exponent);
    exponent = std::clamp(exponent, 0, 1000);
    constant_ = std::ldexp(1.0, -exponent);
    linear_ = -4 * (constant_ * half);
  }
  sum_ = linear_.cwiseAbs().sum() * (1 + 0x1p-50);
}

KeyedSpheres::KeyedSpheres(const std::vector<PowerSphere>& spheres, double radius,
                           double largest_weight, std::vector<std::uint32_t> items)
    : items_(std::move(items)) {
  // Of a sphere through p (less a weight) the constant is 2 center . p - |p|^2 (+ weight).
  const double far_constant = 16 * radius * radius + 4 * largest_weight;
  const auto is_near = [&](const PowerSphere& sphere) {
    return sphere.center.cwiseAbs().maxCoeff() <= 2 * radius &&
           std::abs(sphere.constant) <= far_constant && sphere.center_error <= 0x1p-36 * radius &&
           sphere.constant_error <= 0x1p-36 * far_constant;
  };
  double largest = 0;
  for (const PowerSphere& sphere : spheres) {
    if (is_near(sphere)) largest = std::max(largest, std::abs(sphere.constant));
  }
  unit_ = power_of_two_above(2 * radius);
  constant_unit_ = power_of_two_above(largest);
  for (auto* numbers : {&x_, &y_, &z_, &constants_}) numbers->resize(spheres.size());
  for (std::uint32_t i = 0; i < spheres.size(); ++i) {
    const PowerSphere& sphere = spheres[i];
    if (!is_near(sphere)) {
      far_.push_back(i);
      continue;
    }
    const Eigen::Vector3d center = sphere.center / unit_;
    const Eigen::Vector4d v(center.x(), center.y(), center.z(), sphere.constant / constant_unit_);
    x_[i] = in_steps(v[0]);
    y_[i] = in_steps(v[1]);
    z_[i] = in_steps(v[2]);
    constants_[i] = in_steps(v[3]);
    center_error_ = std::max(center_error_, sphere.center_error);
    constant_error_ = std::max(constant_error_, sphere.constant_error);
  }
}

// A sample's range but for its ends, and an eighth more on either side. Beyond it all spheres have
// one key.
std::pair<double, double> KeyedSpheres::range_of_most(const Eigen::Vector4d& slopes) const {
  constexpr std::size_t kMost = 512;
  std::array<double, kMost> sample{};
  const std::size_t step = (size() + kMost - 1) / kMost;
  std::size_t count = 0;
  for (std::size_t i = 0; i < size(); i += step) {
    sample[count++] = 0x1p-31 * slopes.dot(Eigen::Vector4d(x_[i], y_[i], z_[i], constants_[i]));
  }
  if (count == 0) return {0, 0};
  std::sort(sample.begin(), sample.begin() + static_cast<std::ptrdiff_t>(count));
  const std::size_t left_out = count / 256;
  const double low = sample[left_out];
  const double high = sample[count - 1 - left_out];
  return {low - (high - low) / 8, high + (high - low) / 8};
}

KeyedSpheres::Keys KeyedSpheres::choose_keys(const PowerOfEye& power) const {
  Keys keys;
  keys.depth.square = power.constant() * constant_unit_;
  keys.depth.linear = unit_ * power.linear();
  const Eigen::Vector4d slopes(keys.depth.linear.x(), keys.depth.linear.y(), keys.depth.linear.z(),
                               keys.depth.square);
  const auto [nearest, farthest] = range_of_most(slopes);
  const double range = farthest - nearest;
  keys.depth.farthest = farthest;
  keys.depth.scale = kLast / range;
  if (!std::isfinite(keys.depth.scale) || !std::isfinite(keys.depth.farthest)) {
    keys.depth.scale = 0;
    keys.doubt = kLast;
    return keys;
  }
  // In units of the numbers kept, which are at most 1: half a step of 2^-31 each (a whole one at
  // the upper end), the errors of the spheres, and less than 16 roundings of terms that are no
  // larger than `size` and `farthest` together; that the key is rounded down counts as a step.
  const double size = slopes.cwiseAbs().sum();
  const double doubt = 0x1p-31 * size + power.constant() * constant_error_ +
                       power.linear().cwiseAbs().sum() * center_error_ +
                       0x1p-48 * (size + std::abs(farthest));
  const double steps = doubt * keys.depth.scale * (1 + 0x1p-40) + 2;
  keys.doubt = steps < kLast ? static_cast<std::uint32_t>(steps) : kLast;
  return keys;
}

void KeyedSpheres::write(const Keys& keys, std::size_t begin, std::size_t count,
                         KeyedItem* target) const {
  write_entries(
      keys.depth,
      {x_.data() + begin, y_.data() + begin, z_.data() + begin, constants_.data() + begin},
      items_.data() + begin, count, target);
}

KeyRange doubtful_range(const KeyedSpheres::Keys& keys, double power, double doubt) {
  if (!std::isfinite(power) || !std::isfinite(doubt) || keys.doubt == kLast) return {0, kLast};
  const double margin = 2.0 + keys.doubt;
  const auto key = [&](double p, double more) {
    const double steps = (keys.depth.farthest - p) * keys.depth.scale + more;
    return static_cast<std::uint32_t>(std::clamp(steps, 0.0, double{kLast}));
  };
  return {key(power + doubt, -margin), key(power - doubt, margin)};
}

void join_overlapping(std::vector<KeyRange>& ranges) {
  join(
      ranges, [](const KeyRange& range) { return range.low; },
      [](KeyRange& last, const KeyRange& next) {
        if (next.low > last.high) return false;
        last.high = std::max(last.high, next.high);
        return true;
      });
}

void join_overlapping(std::vector<Run>& runs) {
  join(
      runs, [](const Run& run) { return run.begin; },
      [](Run& last, const Run& next) {
        if (next.begin >= last.end) return false;
        last.end = std::max(last.end, next.end);
        return true;
      });
}

}  // namespace tetraglass::sort
