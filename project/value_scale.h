#pragma once

#include "mesh/field.h"

namespace tetraglass::project {

/// Takes a field's range to [-1, 1], where floats are finest. Monotonic: equal values stay equal
/// and greater ones at least as great.
class ValueScale {
 public:
  explicit ValueScale(const mesh::ScalarField& field);

  /// Within [-1, 1] for values of the field; others may lie outside, but are finite.
  [[nodiscard]] float scaled(double value) const;

  /// What the values at the ends of a segment are compared with to tell whether it crosses an
  /// isosurface: 2^-21 lower than `scaled`. Where rays pass exactly through edges of the mesh, the
  /// faces there give the same value only up to rounding, and an isovalue equal to it (that of a
  /// vertex, often) would lie between them: met by no segment, or by two. Values equal to the
  /// isovalue stay above it. Where on the segment the surface lies is found with `scaled`.
  [[nodiscard]] float isovalue_threshold(double value) const;

  /// The inverse.
  [[nodiscard]] double value(double scaled) const { return middle_ + half_range_ * scaled; }

 private:
  double middle_;
  double half_range_;  // > 0; 1 for a constant field
};

}  // namespace tetraglass::project
