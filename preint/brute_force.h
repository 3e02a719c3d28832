#pragma once

#include <cstddef>
#include <vector>

#include "preint/subranges.h"
#include "preint/transfer_function.h"

namespace tetraglass::preint {

/// A linear piece of a cell between two neighbouring samples of a table's axis.
struct CellPiece {
  double begin = 0;  ///< where it begins, as a part of the cell
  double end = 1;
  double length = 1;                   ///< the same difference without the rounding of both
  double k_front = 0, k_back = 0;      ///< extinction
  double front[3] = {}, back[3] = {};  ///< color
};

/// The pieces of all cells, those of cell i from first[i] to first[i + 1].
struct CellPieces {
  std::vector<std::size_t> first;
  std::vector<CellPiece> pieces;
};

/// `nodes` ascending; cells are cut at the control points that lie inside.
[[nodiscard]] CellPieces cell_pieces(const TransferFunction& tf, const std::vector<double>& nodes);

/// What compose_subranges computes, by brute force: each range on its own, from its front to its
/// back over all of its pieces, each of them by Gauss-Legendre quadrature (the rules and tolerances
/// of the segment integral). `lengths` are those of a cell, [lane]. Cost: proportional to the width
/// of the range.
void brute_force_subranges(const CellPieces& cells, std::size_t span_size, Run run,
                           const double* lengths, double tolerance, double* spans);

}  // namespace tetraglass::preint
