#include "preint/psi_table.h"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "base/errors.h"

namespace tetraglass::preint {
namespace {

TEST(Psi, ClosedForms) {
  for (const double k : {1e-6, 0.1, 1.0, 7.0, 300.0}) {
    EXPECT_NEAR(psi(k, k), -std::expm1(-k) / k, 1e-12) << k;
    // exp(-k x^2 / 2): an error function
    EXPECT_NEAR(psi(0, k), std::sqrt(std::acos(-1.0) / (2 * k)) * std::erf(std::sqrt(k / 2)), 1e-12)
        << k;
  }
  EXPECT_EQ(psi(0, 0), 1);
  EXPECT_EQ(psi(std::numeric_limits<double>::infinity(), 0), 0);
  EXPECT_EQ(psi(0, std::numeric_limits<double>::infinity()), 0);
}

TEST(Psi, TableHoldsPsiAtItsNodes) {
  constexpr int kN = 17;
  const PsiTable table = psi_table(kN);
  for (int b = 0; b + 1 < kN; ++b) {
    for (int f = 0; f + 1 < kN; ++f) {
      const double k_f = f / double(kN - 1 - f), k_b = b / double(kN - 1 - b);
      EXPECT_NEAR(table.lookup(k_f, k_b), psi(k_f, k_b), 1e-7) << f << ", " << b;
    }
  }
  EXPECT_EQ(table.psi.back(), 0);
  EXPECT_THROW(static_cast<void>(psi_table(1)), base::UsageError);
}

TEST(Psi, GivesTheLightOfAnyLinearPiece) {
  const Color red(1, 0.2, 0), blue(0, 0.3, 1);
  for (const double k_f : {0.0, 0.05, 1.0, 20.0, 1e4}) {
    for (const double k_b : {0.0, 0.02, 2.0, 50.0, 1e5}) {
      SCOPED_TRACE(testing::Message() << "k " << k_f << ", " << k_b);
      const TransferFunction tf({{0, red, k_f}, {1, blue, k_b}});
      const Radiance exact = integrate_full(tf, {0, 1, 1});
      const double depth = (k_f + k_b) / 2;
      const Radiance by_psi = light_from_psi(psi(k_f, k_b), depth, red, blue);
      EXPECT_LE((by_psi.color - exact.color).abs().maxCoeff(), 1e-12);
      EXPECT_NEAR(by_psi.transmittance, exact.transmittance, 1e-15);
    }
  }
}

TEST(Psi, ErrorOfTheLookup) {
  for (const int n : {64, 512}) {
    const PsiTable table = psi_table(n);
    double worst = 0, worst_moderate = 0;
    for (double k_f = 1e-4; k_f < 1e5; k_f *= 1.3) {
      for (double k_b = 1e-4; k_b < 1e5; k_b *= 1.3) {
        const double error = std::abs(table.lookup(k_f, k_b) - psi(k_f, k_b));
        worst = std::max(worst, error);
        if (k_f < 10 && k_b < 10) worst_moderate = std::max(worst_moderate, error);
      }
    }
    // Psi(0, k) = sqrt(pi (1 - gamma) / 2) near gamma = 1: linear interpolation of a square root
    // over the last step h = 1 / (n - 1) errs by sqrt(h) / 4.
    EXPECT_LE(worst, std::sqrt(std::acos(-1.0) / 2 / (n - 1)) / 4) << n;
    EXPECT_LE(worst_moderate, 2.0 / ((n - 1) * (n - 1))) << n;
  }
}

}  // namespace
}  // namespace tetraglass::preint
