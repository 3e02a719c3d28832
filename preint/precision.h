#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include "preint/gauss.h"
#include "preint/segment_integral.h"

namespace tetraglass::preint {

/// A Gauss-Legendre rule on [0, 1].
using Rule = std::span<const GaussNode>;

inline constexpr std::size_t kRules = 4;
inline const std::array<Rule, kRules> kRuleNodes = {kGauss4, kGauss6, kGauss10, kGauss14};

/// How deep a part each of these rules may cover for a tolerance: there the error of int k p
/// exp(-tau) dx is below `tolerance` times the opacity of the part, for any linear k and any p that
/// is a product of two linear functions with values in [0, 1]. (Largest over nine ratios of k at
/// the two ends and the nine products of 1, 1 - x and x; found by bisection in 30 digits against a
/// composite rule of 128 nodes, rounded down.) Errors of parts add up to less than the tolerance,
/// because what lies behind a part is dimmed by it.
struct Precision {
  double tolerance;
  double opaque;  ///< the optical depth behind which lies less than tolerance / 100
  std::array<double, kRules> deepest;
};
inline constexpr std::array<Precision, 5> kPrecisions = {
    {{1e-4, 13.9, {1.1, 4.2, 9.9, 9.9}},
     {1e-6, 18.5, {0.28, 1.9, 8.8, 9.9}},
     {1e-9, 25.4, {0.03, 0.56, 4.3, 9.9}},
     {1e-12, 32.3, {3e-3, 0.15, 2.2, 6.9}},
     {kFinest, 39.2, {3e-4, 0.039, 1.1, 4.3}}}};

inline const Precision& precision_for(double tolerance) {
  for (const Precision& p : kPrecisions) {
    if (p.tolerance <= tolerance) return p;
  }
  return kPrecisions.back();
}

/// The rule and the number of equally deep parts that cover the depth with the fewest nodes.
inline std::pair<Rule, int> cheapest(double depth, const Precision& precision) {
  std::pair<Rule, int> best;
  double fewest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < kRules; ++i) {
    const double parts = std::ceil(depth / precision.deepest[i]);
    const double nodes = parts * static_cast<double>(kRuleNodes[i].size());
    if (nodes >= fewest) continue;
    fewest = nodes;
    best = {kRuleNodes[i], static_cast<int>(parts)};
  }
  return best;
}

}  // namespace tetraglass::preint
