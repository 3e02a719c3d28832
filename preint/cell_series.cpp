#include "preint/cell_series.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "preint/gauss.h"
#include "preint/segment_pieces.h"

namespace tetraglass::preint {
namespace {

constexpr double kDeepest = 4;

/// Enough for any tolerance: 4^29 / 29! = 3.3e-14. The moments come from Gauss-Legendre with 14
/// nodes, whose error at that depth is 2.4e-16 of the emission (as for the segment integral).
constexpr int kTerms = 29;

/// Which integrals a span holds, as values at one point of the cell: the color, and for ramps the
/// color and white times the position.
template <class Span>
struct Quantities;

template <>
struct Quantities<LightSpan> {
  static constexpr std::size_t kCount = 3;
  static std::array<double, kCount> at(const Color& c, double /*position*/) {
    return {c[0], c[1], c[2]};
  }
};

template <>
struct Quantities<RampedSpan> {
  static constexpr std::size_t kCount = 7;
  static std::array<double, kCount> at(const Color& c, double position) {
    return {c[0], c[1], c[2], position * c[0], position * c[1], position * c[2], position};
  }
};

/// How deep `terms` terms reach: depth^terms / terms! = tolerance.
double depth_of_terms(int terms, double tolerance) {
  return std::exp((std::log(tolerance) + std::lgamma(terms + 1.0)) / terms);
}

/// The moments [m * quantities + quantity] of a cell of unit length and this optical depth.
template <class Q>
std::array<double, kTerms * Q::kCount> unit_moments(const TransferFunction& tf, const Segment& unit,
                                                    double depth) {
  std::array<double, kTerms * Q::kCount> sums{};
  if (depth == 0) return sums;
  double before = 0;    // optical depth in front of the piece
  double position = 0;  // of the front of the piece in the cell
  for_each_piece(tf, unit, [&](const Piece& piece) {
    const OpticalExtinction k = optical_extinction(piece);
    const double slope = k.back - k.front;
    for (const GaussNode& node : kGauss14) {
      const double x = node.x;
      const Color color = (1 - x) * piece.front.color + x * piece.back.color;
      const auto values = Q::at(color, std::min(1.0, position + x * piece.length));
      const double t = (before + x * (k.front + 0.5 * slope * x)) / depth;
      double weight = node.weight * (k.front + slope * x);
      for (std::size_t m = 0; m < kTerms; ++m) {
        for (std::size_t q = 0; q < Q::kCount; ++q) sums[m * Q::kCount + q] += weight * values[q];
        weight *= t / static_cast<double>(m + 1);
      }
    }
    before += k.depth();
    position += piece.length;
  });
  return sums;
}

}  // namespace

template <>
LightSpan exact_span<LightSpan>(const TransferFunction& tf, const Segment& segment,
                                double tolerance) {
  const Radiance r = integrate_full(tf, segment, tolerance);
  return {r.color[0], r.color[1], r.color[2], r.transmittance};
}

template <>
RampedSpan exact_span<RampedSpan>(const TransferFunction& tf, const Segment& segment,
                                  double tolerance) {
  const RampedRadiance r = integrate_ramped(tf, segment, tolerance);
  const Color c = r.front + r.back;
  return {c[0],      c[1],      c[2],      r.white_front + r.white_back,
          r.back[0], r.back[1], r.back[2], r.white_back};
}

template <class Span>
CellSeries<Span>::CellSeries(const TransferFunction& tf, const std::vector<double>& nodes,
                             double tolerance)
    : tf_(tf), nodes_(nodes), tolerance_(tolerance), depth_(nodes.size() - 1) {
  constexpr std::size_t kMoments = kTerms * Quantities<Span>::kCount;
  moments_.resize(kMoments * size());
  base::parallel_ranges(size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t cell = begin; cell < end; ++cell) {
      const Segment unit{nodes[cell], nodes[cell + 1], 1};
      depth_[cell] = optical_depth(tf, unit);
      const auto moments = unit_moments<Quantities<Span>>(tf, unit, depth_[cell]);
      std::copy(moments.begin(), moments.end(), &moments_[cell * kMoments]);
    }
  });
  for (int terms = 1; terms < kTerms; ++terms) {
    depth_of_terms_.push_back(depth_of_terms(terms, tolerance));
  }
  depth_of_terms_.push_back(std::numeric_limits<double>::infinity());
}

template <class Span>
void CellSeries<Span>::evaluate(const double* lengths, double* cells) const {
  const SeriesInput input{depth_.data(), moments_.data(),        size(),
                          kTerms,        depth_of_terms_.data(), kDeepest};
  evaluate_series(input, kSpanSize<Span>, lengths, cells);
  const std::size_t lanes = run_lanes();
  const double longest = *std::max_element(lengths, lengths + lanes);
  for (std::size_t cell = 0; cell < size(); ++cell) {
    if (longest * depth_[cell] <= kDeepest) continue;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      if (lengths[lane] * depth_[cell] <= kDeepest) continue;
      const Segment segment{nodes_[cell], nodes_[cell + 1], lengths[lane]};
      const auto doubles = std::bit_cast<std::array<double, kSpanSize<Span>>>(
          exact_span<Span>(tf_, segment, tolerance_));
      for (std::size_t i = 0; i < doubles.size(); ++i) {
        cells[(cell * doubles.size() + i) * lanes + lane] = doubles[i];
      }
    }
  }
}

template class CellSeries<LightSpan>;
template class CellSeries<RampedSpan>;

}  // namespace tetraglass::preint
