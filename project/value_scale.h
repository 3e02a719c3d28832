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

  /// The inverse.
  [[nodiscard]] double value(double scaled) const { return middle_ + half_range_ * scaled; }

 private:
  double middle_;
  double half_range_;  // > 0; 1 for a constant field
};

}  // namespace tetraglass::project
