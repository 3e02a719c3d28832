#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "preint/segment_integral.h"

/// The volume rendering integral by brute force in long double: what the fast forms are held
/// against. Shares nothing with them but the definition.
namespace tetraglass::tests {

using Real = long double;

struct GaussRule {
  std::vector<Real> x;  ///< on [0, 1]
  std::vector<Real> weight;
};

/// Gauss-Legendre with n points: roots of the Legendre polynomial by Newton's method.
inline GaussRule gauss_rule(int n) {
  GaussRule rule;
  for (int i = 0; i < n; ++i) {
    Real z = -std::cos(std::numbers::pi_v<Real> * (i + 0.75L) / (n + 0.5L));
    Real slope = 1;
    for (int iteration = 0; iteration < 10; ++iteration) {
      Real p = 1, before = 0;
      for (int k = 1; k <= n; ++k) {
        const Real next = ((2 * k - 1) * z * p - (k - 1) * before) / k;
        before = p;
        p = next;
      }
      slope = n * (z * p - before) / (z * z - 1);
      z -= p / slope;
    }
    rule.x.push_back((z + 1) / 2);
    rule.weight.push_back(1 / ((1 - z * z) * slope * slope));
  }
  return rule;
}

struct Reference {
  std::array<Real, 3> full{};
  std::array<Real, 3> emission{};
  Real depth = 0;
};

/// Splits at the control points; each piece at distances that halve towards its front (where an
/// opaque piece has all its light), each of these parts into `splits` more.
inline Reference integrate_by_quadrature(const preint::TransferFunction& tf,
                                         const preint::Segment& segment, int splits = 8) {
  static const GaussRule kRule = gauss_rule(16);
  const Real front = segment.front, back = segment.back, span = std::abs(back - front);
  const bool rising = front <= back;
  std::vector<Real> cuts = {front};
  for (const auto& p : tf.points()) {
    if ((front < p.value) != (back < p.value) && p.value != front && p.value != back &&
        p.value != cuts.back()) {
      cuts.push_back(p.value);
    }
  }
  cuts.push_back(back);
  std::sort(cuts.begin(), cuts.end());
  if (!rising) std::reverse(cuts.begin(), cuts.end());

  Reference result;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const Real from = cuts[i], to = cuts[i + 1];
    const Real length =
        span == 0 ? Real(segment.length) : segment.length * (std::abs(to - from) / span);
    // The interval of the transfer function by its middle; at one value, the upper one.
    const Real middle = (from + to) / 2;
    const auto& p = tf.points();
    std::size_t k = 0;
    while (k < p.size() && Real(p[k].value) <= middle) ++k;
    const auto& lower = p[k == 0 ? 0 : k - 1];
    const auto& upper = p[k == p.size() ? k - 1 : k];
    const auto mix = [&](Real value, Real a, Real b) {
      if (k == 0 || k == p.size()) return a;
      const Real w = Real(upper.value) - Real(lower.value);
      return a * ((upper.value - value) / w) + b * ((value - lower.value) / w);
    };
    const Real k0 = length * mix(from, lower.extinction, upper.extinction);
    const Real k1 = length * mix(to, lower.extinction, upper.extinction);
    std::array<Real, 3> c0{}, c1{};
    for (long channel = 0; channel < 3; ++channel) {
      const auto j = static_cast<std::size_t>(channel);
      c0[j] = mix(from, lower.color[channel], upper.color[channel]);
      c1[j] = mix(to, lower.color[channel], upper.color[channel]);
    }
    for (int octave = 0; octave <= 64; ++octave) {
      const Real low = octave == 64 ? 0 : std::ldexp(Real(1), -octave - 1);
      const Real high = std::ldexp(Real(1), -octave);
      for (int split = 0; split < splits; ++split) {
        const Real x0 = low + (high - low) * split / splits;
        const Real width = (high - low) / splits;
        for (std::size_t node = 0; node < kRule.x.size(); ++node) {
          const Real x = x0 + width * kRule.x[node];
          const Real tau = result.depth + k0 * x + (k1 - k0) * x * x / 2;
          const Real emitted = width * kRule.weight[node] * (k0 + (k1 - k0) * x);
          for (std::size_t j = 0; j < 3; ++j) {
            const Real color = c0[j] + (c1[j] - c0[j]) * x;
            result.full[j] += emitted * color * std::exp(-tau);
            result.emission[j] += emitted * color;
          }
        }
      }
    }
    result.depth += (k0 + k1) / 2;
  }
  return result;
}

}  // namespace tetraglass::tests
