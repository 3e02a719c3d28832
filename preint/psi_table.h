#pragma once

#include <cmath>
#include <vector>

#include "preint/segment_integral.h"

namespace tetraglass::preint {

/// Partial pre-integration (Moreland and Angel, "A fast high accuracy volume renderer for
/// unstructured data", VolVis 2004): one small table for every transfer function. On a piece with
/// linear extinction and color the light is, integrating kappa c exp(-tau) by parts,
///     c_front (1 - Psi) + c_back (Psi - zeta),    zeta = exp(-tau),
/// where Psi, the mean transmittance from the front, depends on the extinction times length at both
/// ends only:
///     Psi(k_f, k_b) = int_0^1 exp(-(k_f x + (k_b - k_f) x^2 / 2)) dx.
/// The table maps k >= 0 to gamma = k / (k + 1) in [0, 1], with n samples including both ends.
struct PsiTable {
  int n = 0;
  std::vector<float> psi;  ///< entry (front, back) at psi[back * n + front]

  /// Bilinear. Error: at most 2 / (n - 1)^2 for k below 10, rising to 0.31 / sqrt(n - 1) where one
  /// k is very large (Psi goes to 0 like a square root there).
  [[nodiscard]] double lookup(double k_front, double k_back) const;
};

[[nodiscard]] inline double psi_gamma(double k) {
  return k / (k + 1);
}

/// The mean transmittance, to 1e-12. Infinite arguments have the limit 0.
[[nodiscard]] double psi(double k_front, double k_back);

/// In parallel. Throws UsageError for n < 2.
[[nodiscard]] PsiTable psi_table(int n);

/// The light of a piece with this Psi.
[[nodiscard]] inline Radiance light_from_psi(double psi, double optical_depth, const Color& front,
                                             const Color& back) {
  const double zeta = std::exp(-optical_depth);
  return {(1 - psi) * front + (psi - zeta) * back, zeta};
}

}  // namespace tetraglass::preint
