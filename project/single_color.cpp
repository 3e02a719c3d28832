#include "project/single_color.h"

namespace tetraglass::project {
namespace {

using preint::Color;
using preint::ControlPoint;

/// Whether the piece between two points has the color found so far, or none; takes its color.
bool agrees(const ControlPoint& a, const ControlPoint& b, std::optional<Color>& color) {
  if (a.extinction == 0 && b.extinction == 0) return true;
  if (!color) color = a.color;
  return (a.color == *color).all() && (b.color == *color).all();
}

}  // namespace

std::optional<Color> single_color(const Scene& scene) {
  if (scene.mode != Mode::full || is_lit_medium(scene)) return std::nullopt;
  const std::vector<ControlPoint>& points = scene.transfer_function.points();
  const double low = scene.field.min;
  const double high = scene.field.max;
  std::optional<Color> color;
  bool one = true;
  // The function is constant below its first and above its last point.
  if (low < points.front().value) one = agrees(points.front(), points.front(), color);
  for (std::size_t i = 0; i + 1 < points.size() && one; ++i) {
    if (points[i + 1].value >= low && points[i].value <= high) {
      one = agrees(points[i], points[i + 1], color);
    }
  }
  if (one && (high > points.back().value || points.size() == 1)) {
    one = agrees(points.back(), points.back(), color);
  }
  if (!one) return std::nullopt;
  return color.value_or(Color::Zero());
}

}  // namespace tetraglass::project
