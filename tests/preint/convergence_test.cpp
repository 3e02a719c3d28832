// How fast a picture gets better as the cells get smaller: order 2 where each segment's field is
// taken as linear and integrated exactly, order 1 where the attenuation inside the segment is
// neglected (Etiene et al., TVCG 2014).
#include <cmath>
#include <functional>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "preint/segment_integral.h"

namespace tetraglass::preint {
namespace {

constexpr double kLength = 2;

/// A smooth field along a ray of length `kLength`.
double field(double t) {
  return 0.5 + 0.45 * std::sin(4 * t + 0.3);
}

TransferFunction smooth_medium() {
  return TransferFunction(
      {{0, {0.1, 0.2, 0.9}, 0.2}, {0.5, {0.7, 0.9, 0.3}, 1.5}, {1, {1, 0.5, 0.1}, 3}});
}

using SegmentModel = std::function<Radiance(const TransferFunction&, const Segment&)>;

/// Light and what remains of it over `n` segments of equal length.
Radiance compose(const TransferFunction& tf, int n, const SegmentModel& model) {
  Radiance ray;
  for (int i = 0; i < n; ++i) {
    const Radiance segment =
        model(tf, {field(kLength * i / n), field(kLength * (i + 1) / n), kLength / n});
    ray.color += ray.transmittance * segment.color;
    ray.transmittance *= segment.transmittance;
  }
  return ray;
}

Radiance exact(const TransferFunction& tf, const Segment& segment) {
  return integrate_full(tf, segment);
}

/// The bad example: all light of the segment reaches its front.
Radiance unattenuated(const TransferFunction& tf, const Segment& segment) {
  return {integrate_emission(tf, segment), std::exp(-optical_depth(tf, segment))};
}

/// The slope of log(error) over log(n), by least squares.
double measured_order(const char* name, const SegmentModel& model) {
  const TransferFunction tf = smooth_medium();
  const Radiance truth = compose(tf, 1 << 16, exact);
  double sum_x = 0;
  double sum_y = 0;
  double sum_xx = 0;
  double sum_xy = 0;
  int count = 0;
  for (int n = 16; n <= 1024; n *= 2) {
    const double error = (compose(tf, n, model).color - truth.color).abs().maxCoeff();
    fmt::print("{:<14} {:>5} segments: error {:.3e}\n", name, n, error);
    const double x = std::log2(n);
    const double y = std::log2(error);
    sum_x += x;
    sum_y += y;
    sum_xx += x * x;
    sum_xy += x * y;
    ++count;
  }
  const double order = -(count * sum_xy - sum_x * sum_y) / (count * sum_xx - sum_x * sum_x);
  fmt::print("{:<14} order {:.3f}\n", name, order);
  return order;
}

TEST(Convergence, LinearSegmentsAreOfSecondOrder) {
  EXPECT_NEAR(measured_order("exact", exact), 2, 0.1);
}

TEST(Convergence, WithoutAttenuationInsideASegmentItIsOfFirstOrder) {
  EXPECT_NEAR(measured_order("unattenuated", unattenuated), 1, 0.1);
}

}  // namespace
}  // namespace tetraglass::preint
