#include "project/value_scale.h"

#include <algorithm>

namespace tetraglass::project {

// Halved before they are added or subtracted: numbers near the largest double must not overflow.
ValueScale::ValueScale(const mesh::ScalarField& field)
    : middle_(0.5 * field.min + 0.5 * field.max), half_range_(0.5 * field.max - 0.5 * field.min) {
  if (!(half_range_ > 0)) half_range_ = 1;
}

float ValueScale::scaled(double value) const {
  // Far outside the range a value only has to stay there: its differences and products stay finite.
  return static_cast<float>(std::clamp((value - middle_) / half_range_, -1e30, 1e30));
}

float ValueScale::isovalue_threshold(double value) const {
  return scaled(value) - 0x1p-21F;
}

}  // namespace tetraglass::project
