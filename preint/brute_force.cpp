#include "preint/brute_force.h"

#include <algorithm>
#include <array>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "preint/brute_force.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set
#include <hwy/highway.h>
// After highway.h:
#include <hwy/contrib/math/math-inl.h>

#include "preint/precision.h"
#include "preint/segment_pieces.h"

HWY_BEFORE_NAMESPACE();
namespace tetraglass::preint::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, kMostLanes>;
using V = hn::Vec<Doubles>;

HWY_INLINE V constant(double x) {
  return hn::Set(Doubles(), x);
}

HWY_INLINE V transmitted(V depth) {
  return hn::Exp(Doubles(), hn::Neg(hn::Min(depth, constant(700))));
}

/// Light that reaches the front of a piece, as in segment_integral.cpp.
struct Weights {
  V front_front;  ///< of (1 - x)^2
  V front_back;   ///< of x (1 - x)
  V back_back;    ///< of x^2
};

/// Where the optical depth is u: see position_of_depth in segment_integral.cpp.
HWY_INLINE V position(V k_front, V k_back, V depth, V u) {
  const V all = hn::Max(depth, constant(1e-300));
  const V front = hn::Div(k_front, all);
  const V rise = hn::Div(hn::Sub(k_back, k_front), all);
  const V part = hn::Div(u, all);
  const V square = hn::MulAdd(hn::Add(rise, rise), part, hn::Mul(front, front));
  const V root = hn::Sqrt(hn::Max(square, constant(0)));
  const V below = hn::Max(hn::Add(front, root), constant(1e-300));
  return hn::Min(constant(1), hn::Div(hn::Add(part, part), below));
}

/// Rule and parts by the deepest lane.
HWY_INLINE Weights weights(V k_front, V k_back, V depth, double deepest,
                           const Precision& precision) {
  const auto [rule, parts] = cheapest(std::min(deepest, precision.opaque), precision);
  const V one = constant(1);
  const V slope = hn::Sub(k_back, k_front);
  const V half_slope = hn::Mul(constant(0.5), slope);
  const V reached = hn::Min(depth, constant(precision.opaque));
  V from = constant(0);
  Weights sum{from, from, from};
  for (int part = 1; part <= parts; ++part) {
    V to = one;
    if (parts > 1) {
      const V share = constant(static_cast<double>(part) / parts);
      to = position(k_front, k_back, depth, hn::Mul(share, reached));
      if (part == parts) to = hn::IfThenElse(hn::Lt(reached, depth), to, one);
    }
    const V width = hn::Sub(to, from);
    for (const GaussNode& node : rule) {
      const V x = hn::MulAdd(width, constant(node.x), from);
      const V tau = hn::Mul(x, hn::MulAdd(half_slope, x, k_front));
      const V k = hn::Mul(hn::MulAdd(slope, x, k_front), hn::Mul(width, constant(node.weight)));
      const V light = hn::Mul(k, transmitted(tau));
      const V back = hn::Mul(x, light);
      const V front = hn::Sub(light, back);
      sum.back_back = hn::MulAdd(x, back, sum.back_back);
      sum.front_back = hn::MulAdd(x, front, sum.front_back);
      sum.front_front = hn::MulAdd(hn::Sub(one, x), front, sum.front_front);
    }
    from = to;
  }
  return sum;
}

/// Sums along a range.
template <std::size_t kSize>
struct Sums {
  V color[3];
  V transmittance;
  V opacity;
  V ramped[4];  ///< three colors and white
};

template <std::size_t kSize>
HWY_INLINE void add_piece(const CellPiece& piece, double cells_before, V length, double longest,
                          const Precision& precision, Sums<kSize>& sums) {
  const V extent = hn::Mul(length, constant(piece.length));
  // Bounded, so that sums and products stay finite (as in segment_pieces.h).
  const V most = constant(1e300);
  const V k_front = hn::Min(most, hn::Mul(extent, constant(piece.k_front)));
  const V k_back = hn::Min(most, hn::Mul(extent, constant(piece.k_back)));
  const V depth = hn::Add(hn::Mul(constant(0.5), k_front), hn::Mul(constant(0.5), k_back));
  const double deepest =
      std::min(1e300, longest * piece.length * (0.5 * piece.k_front + 0.5 * piece.k_back));
  if (deepest == 0) return;
  const Weights w = weights(k_front, k_back, depth, deepest, precision);
  const V before = sums.transmittance;
  const V front = hn::Mul(before, hn::Add(w.front_front, w.front_back));
  const V back = hn::Mul(before, hn::Add(w.front_back, w.back_back));
  for (std::size_t c = 0; c < 3; ++c) {
    sums.color[c] = hn::MulAdd(front, constant(piece.front[c]),
                               hn::MulAdd(back, constant(piece.back[c]), sums.color[c]));
  }
  if constexpr (kSize == 8) {
    const V at_front = hn::Mul(before, constant(cells_before + piece.begin));
    const V at_back = hn::Mul(before, constant(cells_before + piece.end));
    const V ramped_front = hn::MulAdd(at_front, w.front_front, hn::Mul(at_back, w.front_back));
    const V ramped_back = hn::MulAdd(at_front, w.front_back, hn::Mul(at_back, w.back_back));
    for (std::size_t c = 0; c < 3; ++c) {
      sums.ramped[c] = hn::MulAdd(ramped_front, constant(piece.front[c]),
                                  hn::MulAdd(ramped_back, constant(piece.back[c]), sums.ramped[c]));
    }
    sums.ramped[3] = hn::Add(sums.ramped[3], hn::Add(ramped_front, ramped_back));
    sums.opacity = hn::Add(sums.opacity, hn::Add(front, back));
  }
  sums.transmittance = hn::Mul(before, transmitted(depth));
}

/// Writes the spans that begin at `begin`, each where its end belongs.
template <std::size_t kSize>
HWY_INLINE void write(const Sums<kSize>& sums, std::size_t begin, std::size_t count, const Run& run,
                      double* spans) {
  const Doubles d;
  HWY_ALIGN double values[kSize][kMostLanes] = {};
  for (std::size_t c = 0; c < 3; ++c) hn::Store(sums.color[c], d, values[c]);
  hn::Store(kSize == 4 ? sums.transmittance : sums.opacity, d, values[3]);
  for (std::size_t c = 4; c < kSize; ++c) hn::Store(sums.ramped[c - 4], d, values[c]);
  for (std::size_t lane = 0; lane < run.lanes; ++lane) {
    const std::size_t end = begin + run.width(lane);
    if (end > count) continue;
    for (std::size_t c = 0; c < kSize; ++c) {
      spans[span_offset(kSize, run.lanes, end, lane, c / 4) + c % 4] = values[c][lane];
    }
  }
}

template <std::size_t kSize>
void subranges(const CellPieces& cells, Run run, const double* lengths, double tolerance,
               double* spans) {
  const Doubles d;
  const std::size_t count = cells.first.size() - 1;
  const Precision& precision = precision_for(tolerance);
  HWY_ALIGN double widths[kMostLanes] = {};
  for (std::size_t j = 0; j < run.lanes; ++j) widths[j] = static_cast<double>(run.width(j));
  const V width = hn::Load(d, widths);
  const V all_lengths = hn::LoadU(d, lengths);
  const double longest = *std::max_element(lengths, lengths + run.lanes);
  const std::size_t widest = run.narrowest + run.lanes - 1;
  for (std::size_t begin = 0; begin + run.narrowest <= count; ++begin) {
    const V zero = constant(0);
    Sums<kSize> sums{{zero, zero, zero}, constant(1), zero, {zero, zero, zero, zero}};
    for (std::size_t cell = begin; cell < std::min(begin + widest, count); ++cell) {
      const auto cells_before = static_cast<double>(cell - begin);
      // Lanes whose range has ended see nothing.
      const V length = hn::IfThenElseZero(hn::Lt(constant(cells_before), width), all_lengths);
      for (std::size_t p = cells.first[cell]; p < cells.first[cell + 1]; ++p) {
        add_piece(cells.pieces[p], cells_before, length, longest, precision, sums);
      }
    }
    write(sums, begin, count, run, spans);
  }
}

void subranges_light(const CellPieces& cells, Run run, const double* lengths, double tolerance,
                     double* spans) {
  subranges<4>(cells, run, lengths, tolerance, spans);
}
void subranges_ramped(const CellPieces& cells, Run run, const double* lengths, double tolerance,
                      double* spans) {
  subranges<8>(cells, run, lengths, tolerance, spans);
}

}  // namespace tetraglass::preint::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tetraglass::preint {

HWY_EXPORT(subranges_light);
HWY_EXPORT(subranges_ramped);

CellPieces cell_pieces(const TransferFunction& tf, const std::vector<double>& nodes) {
  CellPieces result;
  for (std::size_t cell = 0; cell + 1 < nodes.size(); ++cell) {
    result.first.push_back(result.pieces.size());
    double begin = 0;
    for_each_piece(tf, {nodes[cell], nodes[cell + 1], 1}, [&](const Piece& piece) {
      CellPiece p{begin, std::min(1.0, begin + piece.length), piece.length, piece.front.extinction,
                  piece.back.extinction};
      for (int c = 0; c < 3; ++c) {
        p.front[c] = piece.front.color[c];
        p.back[c] = piece.back.color[c];
      }
      result.pieces.push_back(p);
      begin = p.end;
    });
  }
  result.first.push_back(result.pieces.size());
  return result;
}

void brute_force_subranges(const CellPieces& cells, std::size_t span_size, Run run,
                           const double* lengths, double tolerance, double* spans) {
  if (span_size == 4) {
    HWY_DYNAMIC_DISPATCH(subranges_light)(cells, run, lengths, tolerance, spans);
  } else {
    HWY_DYNAMIC_DISPATCH(subranges_ramped)(cells, run, lengths, tolerance, spans);
  }
}

}  // namespace tetraglass::preint
#endif  // HWY_ONCE
