#include "sort/power_keys.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace tetraglass::sort {
namespace {

constexpr std::uint32_t kTail = 1U << 30;  // keys on either side of the range

// Grows with `beyond` >= 0, by 2^24 as 1 + beyond doubles.
std::uint32_t tail(double beyond) {
  const std::uint64_t bits =
      std::bit_cast<std::uint64_t>(1 + beyond) - std::bit_cast<std::uint64_t>(1.0);
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(bits >> 28, kTail - 1));
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

PowerKeys::PowerKeys(std::vector<double> sample) {
  if (sample.empty()) return;
  std::sort(sample.begin(), sample.end());
  const auto set_range = [&](std::size_t left_out) {
    high_ = sample[sample.size() - 1 - left_out];
    const double range = high_ - sample[left_out];
    if (range > 0) scale_ = std::min(1 / range, std::numeric_limits<double>::max());
    return range > 0;
  };
  if (!set_range(sample.size() / 50)) set_range(0);
}

std::uint32_t PowerKeys::key(double power) const {
  const double x = (high_ - power) * scale_;
  if (x < 0) return kTail - 1 - tail(-x);
  if (x < 1) return kTail + static_cast<std::uint32_t>(static_cast<std::int64_t>(x * 0x1p31));
  return 3 * kTail + tail(x - 1);
}

void join_overlapping(std::vector<KeyRange>& ranges) {
  std::sort(ranges.begin(), ranges.end(),
            [](const KeyRange& a, const KeyRange& b) { return a.low < b.low; });
  std::size_t count = 0;
  for (const KeyRange& range : ranges) {
    if (count > 0 && range.low <= ranges[count - 1].high) {
      ranges[count - 1].high = std::max(ranges[count - 1].high, range.high);
    } else {
      ranges[count++] = range;
    }
  }
  ranges.resize(count);
}

}  // namespace tetraglass::sort
