#pragma once

#include <array>
#include <cstddef>

namespace tetraglass::preint {

/// How deep a piece each series may cover for a tolerance: what it leaves out is at most that part
/// of the opacity of the piece (degree 4, 6 and 12 of F - 1, and 5 and 7 of 1 - exp(-D / 2);
/// largest over h, against the series of degree 40; rounded down, and less the rounding of floats,
/// 7e-7). What lies behind a piece is dimmed by it, so the errors of any number of pieces along a
/// ray add up to at most the tolerance times the opacity of all, and their rounding.
struct PieceBounds {
  float tolerance;
  float thin;      ///< degree 4
  float moderate;  ///< degree 6
  float dense;     ///< degree 12 and an exponential
};
inline constexpr std::array<PieceBounds, 4> kPieceBounds = {{{1e-6F, 0.26F, 0.92F, 4.9F},
                                                             {1e-5F, 0.59F, 1.5F, 6.8F},
                                                             {1e-4F, 0.99F, 2.1F, 8.7F},
                                                             {1e-3F, 1.6F, 2.8F, 11.4F}}};

/// The smallest error that can be asked of floats.
inline constexpr double kFinestPiece = 1e-6;

/// The cheapest that hold the tolerance; the finest ones if none does.
constexpr const PieceBounds& piece_bounds(double tolerance) {
  std::size_t i = 0;
  while (i + 1 < kPieceBounds.size() && kPieceBounds[i + 1].tolerance <= tolerance) ++i;
  return kPieceBounds[i];
}

/// The mean transmittance from the front of a piece (Moreland and Angel's Psi), with
/// D = (k_front + k_back) / 2 its optical depth and h = (k_back - k_front) / 2, |h| <= D, is
///     M = int_0^1 exp(-(D x - h x (1 - x))) dx = exp(-D / 2) F,
///     F = int_{-1/2}^{1/2} cosh(D y) exp(h (1/4 - y^2)) dy = sum_jk c_jk D^2j h^k,
///     c_jk = int y^2j (1/4 - y^2)^k dy / ((2j)! k!)
///          = 2^-(2j + 2k + 1) / ((2j)! (j + 1/2) (j + 3/2) ... (j + k + 1/2)).
/// The light is color_front (1 - M) + color_back (M - exp(-D)).
constexpr double piece_coefficient(std::size_t j, std::size_t k) {
  double result = 0.5;
  for (std::size_t i = 1; i <= 2 * j; ++i) result /= 2.0 * static_cast<double>(i);
  for (std::size_t i = 1; i <= k; ++i) result /= 4.0;
  for (std::size_t i = 0; i <= k; ++i) result /= static_cast<double>(j + i) + 0.5;
  return result;
}
static_assert(piece_coefficient(0, 0) == 1);

/// [k][j], of terms up to a total degree of Degree in D and h; 0 beyond.
template <std::size_t Degree>
constexpr auto piece_coefficients() {
  std::array<std::array<float, Degree / 2 + 1>, Degree + 1> result{};
  for (std::size_t k = 0; k <= Degree; ++k) {
    for (std::size_t j = 0; 2 * j + k <= Degree; ++j) {
      result[k][j] = static_cast<float>(piece_coefficient(j, k));
    }
  }
  return result;
}

/// 1 - exp(-y / Divisor) = sum_m result[m] y^m, without what is left out after y^Degree.
template <std::size_t Degree, int Divisor>
constexpr std::array<float, Degree + 1> absorbed_coefficients() {
  std::array<float, Degree + 1> result{};
  double coefficient = -1;
  for (std::size_t m = 1; m <= Degree; ++m) {
    coefficient /= -static_cast<double>(m) * Divisor;
    result[m] = static_cast<float>(coefficient);
  }
  return result;
}

}  // namespace tetraglass::preint
