#include "apps/box_axes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "apps/ticks.h"

namespace tetraglass::apps {
namespace {

constexpr std::array<const char*, 3> kNames = {"x", "y", "z"};

/// Centres of pixels at halves, as the ink has them; none behind the eye.
std::optional<Eigen::Vector2d> seen(const Eigen::Vector3d& point, const project::Frame& frame) {
  const Eigen::Vector3d p = frame.to_camera(point);
  if (!frame.parallel() && !(p.z() > 0)) return std::nullopt;
  const Eigen::Vector2d plane =
      frame.parallel() ? p.head<2>().eval() : (p.head<2>() / p.z()).eval();
  const Eigen::Vector2d pixel = frame.pixel(plane);
  if (!pixel.allFinite()) return std::nullopt;
  return Eigen::Vector2d(pixel.array() + 0.5);
}

/// Whether the side of the box across `axis`, the lower or the upper one, is turned to the viewer.
bool faces_viewer(const Eigen::AlignedBox3d& box, const project::Frame& frame, int axis,
                  bool upper) {
  const double sign = upper ? 1 : -1;
  if (frame.parallel()) return -sign * frame.axes()(2, axis) > 0;
  return sign * (frame.eye()[axis] - (upper ? box.max() : box.min())[axis]) > 0;
}

Eigen::Vector3d corner(const Eigen::AlignedBox3d& box, unsigned bits) {
  return box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(bits));
}

}  // namespace

BoxAxes::BoxAxes(const Eigen::AlignedBox3d& box, const project::Frame& frame, double scale)
    : scale_(scale), font_{13 * scale, false}, name_font_{15 * scale, true} {
  Eigen::AlignedBox2d corners;
  for (unsigned bits = 0; bits < 8; ++bits) {
    const std::optional<Eigen::Vector2d> p = seen(corner(box, bits), frame);
    if (!p) return;
    corners.extend(*p);
  }
  const Eigen::Vector2d middle = corners.center();
  extent_ = corners;
  for (unsigned axis = 0; axis < 3; ++axis) {
    const std::array<unsigned, 2> others = {(axis + 1) % 3, (axis + 2) % 3};
    std::optional<Edge> best;
    double best_place = 0;
    for (unsigned side = 0; side < 4; ++side) {
      const std::array<bool, 2> upper = {(side & 1U) != 0, (side & 2U) != 0};
      // On the outline: between a side that is seen and one that is not.
      if (faces_viewer(box, frame, static_cast<int>(others[0]), upper[0]) ==
          faces_viewer(box, frame, static_cast<int>(others[1]), upper[1])) {
        continue;
      }
      const unsigned bits = (upper[0] ? 1U << others[0] : 0U) | (upper[1] ? 1U << others[1] : 0U);
      const Edge edge{corner(box, bits), corner(box, bits | 1U << axis)};
      const Eigen::Vector2d a = *seen(edge.from, frame);
      const Eigen::Vector2d b = *seen(edge.to, frame);
      // Lines that run up are read at the left, others at the bottom.
      const bool upright = std::abs(a.y() - b.y()) > 2 * std::abs(a.x() - b.x());
      const double place = upright ? -(a.x() + b.x()) : a.y() + b.y();
      if (!best || place > best_place) {
        best = edge;
        best_place = place;
      }
    }
    if (best) add_axis(static_cast<int>(axis), *best, frame, middle);
  }
}

void BoxAxes::add_axis(int axis, const Edge& edge, const project::Frame& frame,
                       const Eigen::Vector2d& middle) {
  const Eigen::Vector2d a = *seen(edge.from, frame);
  const Eigen::Vector2d b = *seen(edge.to, frame);
  const double length = (b - a).norm();
  if (length < 30 * scale_) return;  // seen end on: no room for two labels
  Eigen::Vector2d outwards = Eigen::Vector2d(a.y() - b.y(), b.x() - a.x()) / length;
  if (outwards.dot((a + b) / 2 - middle) < 0) outwards = -outwards;
  const double low = edge.from[axis];
  const double high = edge.to[axis];
  // Labels side by side need more room than labels on top of each other.
  const double spacing = (34 + 28 * std::abs(b.x() - a.x()) / length) * scale_;
  const Ticks ticks = linear_ticks(low, high, std::max(2, static_cast<int>(length / spacing)));
  shown_.push_back(axis);
  lines_.push_back({a, b});
  double farthest = 0;
  for (std::size_t i = 0; i < ticks.values.size(); ++i) {
    const double t = (ticks.values[i] - low) / (high - low);
    const std::optional<Eigen::Vector2d> at = seen(edge.from + t * (edge.to - edge.from), frame);
    if (!at) continue;
    lines_.push_back({*at, *at + 6 * scale_ * outwards});
    const Eigen::Vector2d half = text_size(ticks.labels[i], font_) / 2;
    const double reach = std::abs(outwards.x()) * half.x() + std::abs(outwards.y()) * half.y();
    const double away = 11 * scale_ + reach;
    add_label({ticks.labels[i], *at + away * outwards, false});
    farthest = std::max(farthest, away + reach);
  }
  const std::string name = ticks.exponent == 0
                               ? std::string(kNames[static_cast<std::size_t>(axis)])
                               : std::string(kNames[static_cast<std::size_t>(axis)]) + " (×" +
                                     power_of_ten(ticks.exponent) + ")";
  const Eigen::Vector2d half = text_size(name, name_font_) / 2;
  const double reach = std::abs(outwards.x()) * half.x() + std::abs(outwards.y()) * half.y();
  add_label({name, (a + b) / 2 + (farthest + 8 * scale_ + reach) * outwards, true});
}

void BoxAxes::add_label(const Label& label) {
  const Eigen::Vector2d half = text_size(label.text, label.is_name ? name_font_ : font_) / 2;
  const Eigen::AlignedBox2d box(Eigen::Vector2d(label.middle - half),
                                Eigen::Vector2d(label.middle + half));
  // Where two axes meet, the number of one says enough; its tick stays.
  const double gap = 12 * scale_;
  const Eigen::AlignedBox2d wide(Eigen::Vector2d(box.min().array() - gap),
                                 Eigen::Vector2d(box.max().array() + gap));
  for (const Eigen::AlignedBox2d& other : places_) {
    if (wide.intersects(other)) return;
  }
  places_.push_back(box);
  extent_.extend(box);
  labels_.push_back(label);
}

void BoxAxes::draw(const Eigen::Vector2d& origin, Ink& ink) const {
  for (const Line& line : lines_) {
    ink.line(line.from + origin, line.to + origin, 1.3 * std::max(scale_, 0.75));
  }
  for (const Label& label : labels_) {
    ink.text(label.text, label.is_name ? name_font_ : font_, label.middle + origin);
  }
}

}  // namespace tetraglass::apps
