#include "project/light/surface_value.h"

#include <algorithm>

namespace tetraglass::project {

double surface_value(const preint::TransferFunction& tf) {
  const std::vector<preint::ControlPoint>& points = tf.points();
  const auto less = [](const preint::ControlPoint& a, const preint::ControlPoint& b) {
    return a.extinction < b.extinction;
  };
  const auto first = std::max_element(points.begin(), points.end(), less);
  auto last = first;
  while (last + 1 != points.end() && (last + 1)->extinction == first->extinction) ++last;
  return 0.5 * first->value + 0.5 * last->value;
}

}  // namespace tetraglass::project
