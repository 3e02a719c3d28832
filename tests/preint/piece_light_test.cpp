#include "preint/piece_light.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "preint/segment_integral.h"

namespace tetraglass::preint {
namespace {

struct Lights {
  std::vector<float> front, back, transmittance;
};

Lights lights(const std::vector<float>& k_front, const std::vector<float>& k_back,
              double tolerance = kFinestPiece) {
  const std::size_t n = k_front.size();
  Lights result{std::vector<float>(n), std::vector<float>(n), std::vector<float>(n)};
  piece_lights({k_front, k_back, result.front, result.back, result.transmittance}, tolerance);
  return result;
}

/// Red is the share of the front's color, green that of the back's.
Radiance exact(float k_front, float k_back) {
  const TransferFunction tf({{0, {1, 0, 0}, k_front}, {1, {0, 1, 0}, k_back}});
  return integrate_full(tf, {0, 1, 1});
}

/// Of pieces to this depth.
void expect_tolerance(float most, double tolerance) {
  const double bound = piece_bounds(tolerance).tolerance;
  ASSERT_LE(bound, 1.0001 * tolerance);
  std::vector<float> k_front, k_back;
  for (int exponent = 0; exponent < 60; ++exponent) {
    // Half of the vectors are of one depth, half have a few deep pieces among thin ones.
    const float depth = most * std::pow(0.6F, static_cast<float>(exponent / 2));
    for (int i = 0; i < 32; ++i) {
      const float lane = exponent % 2 == 0 || i % 4 == 0 ? depth : 0.1F * depth;
      const float share = static_cast<float>(i) / 31;
      k_front.push_back(2 * lane * share);
      k_back.push_back(2 * lane * (1 - share));
    }
  }
  k_front.insert(k_front.end(), {0.0F, 0.0F, 1e-38F});
  k_back.insert(k_back.end(), {0.0F, 1e-38F, 0.0F});
  const Lights r = lights(k_front, k_back, tolerance);
  for (std::size_t i = 0; i < k_front.size(); ++i) {
    SCOPED_TRACE(testing::Message()
                 << "tolerance " << tolerance << " k " << k_front[i] << ", " << k_back[i]);
    const Radiance e = exact(k_front[i], k_back[i]);
    const double opacity = -std::expm1(-0.5 * (double(k_front[i]) + k_back[i]));
    ASSERT_NEAR(r.front[i], e.color[0], bound * opacity + 1e-37);
    ASSERT_NEAR(r.back[i], e.color[1], bound * opacity + 1e-37);
    ASSERT_NEAR(r.transmittance[i], e.transmittance, bound);
  }
}

TEST(PieceLight, WithinTheToleranceToEveryBound) {
  for (const double tolerance : {1e-6, 1e-5, 3e-5, 1e-4, 1e-3, 1.0}) {
    const PieceBounds& bounds = piece_bounds(tolerance);
    for (const float most :
         {1e-3F, bounds.thin, bounds.moderate, bounds.dense, 8.0F, 16.0F, 200.0F, 1e15F}) {
      expect_tolerance(most, tolerance);
    }
  }
}

TEST(PieceLight, AnyNumberOfPieces) {
  for (std::size_t n = 0; n < 70; ++n) {
    const std::vector<float> k_front(n, 0.5F), k_back(n, 1.5F);
    const Lights r = lights(k_front, k_back);
    const Radiance e = exact(0.5F, 1.5F);
    for (std::size_t i = 0; i < n; ++i) {
      ASSERT_NEAR(r.front[i], e.color[0], 1e-6) << n << " pieces, piece " << i;
      ASSERT_NEAR(r.back[i], e.color[1], 1e-6) << n << " pieces, piece " << i;
    }
  }
}

}  // namespace
}  // namespace tetraglass::preint
