#pragma once

#include <span>

#include "preint/piece_series.h"

namespace tetraglass::preint {

/// Linear pieces of segments in float, many at once (structure of arrays, all of one length).
struct PieceBatch {
  std::span<const float> k_front;  ///< extinction times length of the piece at its front, >= 0
  std::span<const float> k_back;   ///< ... and at its back
  std::span<float> front;          ///< result: share of the color at the front of the piece ...
  std::span<float> back;  ///< ... and of that at the back, in the light that leaves its front
  std::span<float> transmittance;  ///< result: exp(-optical depth)
};

/// The light of all pieces, in the widest vectors of the machine, each vector by the cheapest form
/// for its deepest piece (PieceBounds in piece_series.h; the same for use inside vector code:
/// piece_light-inl.h). For any extinction from 0 on. Error of each result: at most the tolerance
/// (1e-6 or more), of the shares of light also relative to the opacity of the piece.
void piece_lights(const PieceBatch& batch, double tolerance = kFinestPiece);

}  // namespace tetraglass::preint
