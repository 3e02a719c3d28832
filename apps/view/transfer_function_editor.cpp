#include "apps/view/transfer_function_editor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tetraglass::apps::view {
namespace {

using Points = TransferFunctionEditor::Points;

/// How far point `i` is from the line between `first` and `last`, in parts of the largest values.
double distance(const Points& points, std::size_t first, std::size_t last, std::size_t i,
                double most_extinction) {
  const preint::ControlPoint& a = points[first];
  const preint::ControlPoint& b = points[last];
  const double span = b.value - a.value;
  const double t = span > 0 ? (points[i].value - a.value) / span : 0;
  const double extinction = (1 - t) * a.extinction + t * b.extinction;
  const preint::Color color = (1 - t) * a.color + t * b.color;
  const double of_color = (points[i].color - color).abs().maxCoeff();
  const double of_extinction =
      most_extinction > 0 ? std::abs(points[i].extinction - extinction) / most_extinction : 0;
  return std::max(of_color, of_extinction);
}

struct Simplified {
  Points points;
  double error = 0;
};

/// The ends, and then again and again the point that is farthest from the lines so far (Ramer,
/// 1972; Douglas and Peucker, 1973), to a number of points or a small error. A jump keeps both its
/// points or is sloped within that error.
Simplified simplified(const Points& points, std::size_t most_points) {
  constexpr double kInvisible = 0.01;
  double most_extinction = 0;
  for (const preint::ControlPoint& point : points) {
    most_extinction = std::max(most_extinction, point.extinction);
  }
  std::vector<std::size_t> kept = {0};
  if (points.size() > 1) kept.push_back(points.size() - 1);
  while (true) {
    double most = 0;
    std::size_t farthest = 0;
    std::size_t segment = 0;
    for (std::size_t i = 0; i + 1 < kept.size(); ++i) {
      for (std::size_t p = kept[i] + 1; p < kept[i + 1]; ++p) {
        const double d = distance(points, kept[i], kept[i + 1], p, most_extinction);
        if (d > most) {
          most = d;
          farthest = p;
          segment = i;
        }
      }
    }
    if (most <= kInvisible || kept.size() >= most_points) {
      Simplified result{{}, most};
      for (const std::size_t p : kept) result.points.push_back(points[p]);
      return result;
    }
    kept.insert(kept.begin() + static_cast<std::ptrdiff_t>(segment) + 1, farthest);
  }
}

}  // namespace

double TransferFunctionEditor::follow(const preint::TransferFunction& tf,
                                      const std::string& source) {
  if (!now_.source.empty() && (now_.edited || source != now_.source)) {
    past_.push_back(now_);
    future_.clear();
  }
  const std::size_t selected = source == now_.source && !now_.edited ? now_.selected : 0;
  Simplified few{tf.points()};
  if (tf.points().size() > kMostPoints) few = simplified(tf.points(), kMostPoints);
  now_ = {std::move(few.points), 0, false, source};
  select(selected);
  remembered_ = false;
  return few.error;
}

void TransferFunctionEditor::forget() {
  now_ = {};
  past_.clear();
  future_.clear();
  remembered_ = false;
}

void TransferFunctionEditor::select(std::size_t point) {
  now_.selected = std::min(point, now_.points.size() - 1);
}

void TransferFunctionEditor::begin() {
  remembered_ = false;
}

void TransferFunctionEditor::remember() {
  if (!remembered_) past_.push_back(now_);
  remembered_ = true;
  future_.clear();
  now_.edited = true;
}

void TransferFunctionEditor::add(double value) {
  const auto above = std::ranges::upper_bound(now_.points, value, {}, &preint::ControlPoint::value);
  const auto same = static_cast<std::size_t>(
      std::ranges::count(now_.points, value, &preint::ControlPoint::value));
  if (same > 1 || !std::isfinite(value)) return;  // a jump is there
  remember();
  const preint::TransferFunction tf = function();
  const preint::Medium medium = tf.at(value);
  const auto place = above - now_.points.begin();
  now_.points.insert(above, {value, medium.color, medium.extinction, tf.material_at(value)});
  now_.selected = static_cast<std::size_t>(place);
}

void TransferFunctionEditor::move(double value, double extinction) {
  if (!std::isfinite(value) || !std::isfinite(extinction)) return;
  remember();
  preint::ControlPoint& point = now_.points[now_.selected];
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double low = now_.selected > 0 ? now_.points[now_.selected - 1].value : -kInfinity;
  double high =
      now_.selected + 1 < now_.points.size() ? now_.points[now_.selected + 1].value : kInfinity;
  // Two points of one value are a jump; a third one there says nothing.
  if (now_.selected > 1 && now_.points[now_.selected - 2].value == low)
    low = std::nextafter(low, point.value);
  if (now_.selected + 2 < now_.points.size() && now_.points[now_.selected + 2].value == high)
    high = std::nextafter(high, point.value);
  point.value = std::clamp(value, std::min(low, high), high);
  point.extinction = std::max(0.0, extinction);
}

void TransferFunctionEditor::set_color(const preint::Color& color) {
  remember();
  now_.points[now_.selected].color = color;
}

void TransferFunctionEditor::remove() {
  if (now_.points.size() == 1) return;
  remember();
  now_.points.erase(now_.points.begin() + static_cast<std::ptrdiff_t>(now_.selected));
  select(now_.selected);
}

void TransferFunctionEditor::undo() {
  if (past_.empty()) return;
  future_.push_back(now_);
  now_ = std::move(past_.back());
  remembered_ = false;
  past_.pop_back();
}

void TransferFunctionEditor::redo() {
  if (future_.empty()) return;
  past_.push_back(now_);
  now_ = std::move(future_.back());
  remembered_ = false;
  future_.pop_back();
}

}  // namespace tetraglass::apps::view
