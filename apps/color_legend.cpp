#include "apps/color_legend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace tetraglass::apps {
namespace {

using project::Mode;

/// Lays a color over whole pixels of a picture.
void paint(const Eigen::AlignedBox2d& box, const preint::Color& color, double alpha,
           project::Image& image) {
  const int bottom = std::min(static_cast<int>(std::lround(box.max().y())), image.height);
  const int right = std::min(static_cast<int>(std::lround(box.max().x())), image.width);
  for (int y = std::max(0, static_cast<int>(std::lround(box.min().y()))); y < bottom; ++y) {
    for (int x = std::max(0, static_cast<int>(std::lround(box.min().x()))); x < right; ++x) {
      float* rgba = image.pixel(x, y);
      for (int c = 0; c < 4; ++c) {
        const double own = c < 3 ? color[c] : 1;
        rgba[c] = static_cast<float>(alpha * own + (1 - alpha) * static_cast<double>(rgba[c]));
      }
    }
  }
}

void frame(const Eigen::AlignedBox2d& box, Ink& ink) {
  // On the middles of the pixels around it: sharp.
  const Eigen::Vector2d low = box.min().array().round() - 0.5;
  const Eigen::Vector2d high = box.max().array().round() + 0.5;
  ink.line(low, {high.x(), low.y()}, 1);
  ink.line({high.x(), low.y()}, high, 1);
  ink.line(high, {low.x(), high.y()}, 1);
  ink.line({low.x(), high.y()}, low, 1);
}

void text_from(double left, double middle, const std::string& text, const Font& font, Ink& ink) {
  ink.text(text, font, {left + text_size(text, font).x() / 2, middle});
}

}  // namespace

ColorLegend::ColorLegend(const project::Scene& scene, const std::string& title, bool logarithmic,
                         double scale, double most_width)
    : scene_(scene),
      logarithmic_(logarithmic),
      has_curve_(scene.mode == Mode::full || scene.mode == Mode::emission),
      scale_(scale),
      title_font_{15 * scale, true},
      label_font_{14 * scale, false} {
  title_ = shortened(title, title_font_, most_width);
  const std::vector<preint::ControlPoint>& points = scene.transfer_function.points();
  low_ = points.front().value;
  high_ = points.back().value;
  if (!(low_ < high_)) {
    low_ = scene.field.min;
    high_ = scene.field.max;
  }
  logarithmic_ = logarithmic && low_ > 0;
  path_ = mesh::bounds(*scene.mesh).diagonal().norm() / 10;
  if (scene.mode == Mode::iso) {
    for (const preint::Isosurface& surface : scene.isosurfaces) {
      ticks_.values.push_back(surface.value);
      ticks_.labels.push_back(number_text(surface.value));
    }
  } else {
    constexpr int kMostTicks = 7;
    ticks_ = logarithmic_ ? logarithmic_ticks(low_, high_, kMostTicks)
                          : linear_ticks(low_, high_, kMostTicks);
  }
  if (ticks_.exponent != 0) multiplier_ = "×" + power_of_ten(ticks_.exponent);
  double labels = 0;
  for (const std::string& label : ticks_.labels) {
    labels = std::max(labels, text_size(label, label_font_).x());
  }
  const double marks =
      scene.mode == Mode::iso ? 28 * scale : curve_width() + bar_width() + 10 * scale;
  width_ = std::max({marks + labels, text_size(title_, title_font_).x(),
                     multiplier_.empty() ? 0 : text_size(multiplier_, label_font_).x()});
}

double ColorLegend::position(double value) const {
  if (!(low_ < high_)) return 0.5;
  return logarithmic_ ? std::log(value / low_) / std::log(high_ / low_)
                      : (value / 2 - low_ / 2) / (high_ / 2 - low_ / 2);
}

double ColorLegend::value_at(double position) const {
  return logarithmic_ ? low_ * std::pow(high_ / low_, position)
                      : (1 - position) * low_ + position * high_;
}

double ColorLegend::opacity(double extinction) const {
  return -std::expm1(-extinction * path_);
}

void ColorLegend::draw(const Eigen::AlignedBox2d& place, Ink& ink, project::Image& image) const {
  const double title_height = text_size("0", title_font_).y();
  const double label_height = text_size("0", label_font_).y();
  const double above =
      title_height + 14 * scale_ + (multiplier_.empty() ? 0 : 10 * scale_ + label_height);
  const double rows = 26 * scale_;
  const double room = place.sizes().y();
  const double body =
      scene_.mode == Mode::iso
          ? std::min(rows * static_cast<double>(scene_.isosurfaces.size()), room - above)
          : std::min({0.62 * room, room - above, 420 * scale_});
  const double top = place.min().y() + std::max(0.0, (room - body - above) / 2);
  const double left = place.min().x();
  text_from(left, top + title_height / 2, title_, title_font_, ink);
  if (!multiplier_.empty()) {
    text_from(left, top + title_height + 10 * scale_ + label_height / 2, multiplier_, label_font_,
              ink);
  }
  const Eigen::AlignedBox2d below(Eigen::Vector2d(left, top + above),
                                  Eigen::Vector2d(left + width_, top + above + body));
  if (scene_.mode == Mode::iso) {
    draw_swatches(below, ink, image);
    return;
  }
  Eigen::AlignedBox2d bar = below;
  bar.min().x() += std::round(curve_width());
  bar.max().x() = bar.min().x() + std::round(bar_width());
  bar.min() = bar.min().array().round();
  bar.max() = bar.max().array().round();
  draw_bar(bar, ink, image);
  for (std::size_t i = 0; i < ticks_.values.size(); ++i) {
    const double y = bar.max().y() - position(ticks_.values[i]) * bar.sizes().y();
    ink.line({bar.max().x() + 1, y}, {bar.max().x() + 5 * scale_, y}, std::max(1.0, scale_));
    text_from(bar.max().x() + 10 * scale_, y, ticks_.labels[i], label_font_, ink);
  }
}

void ColorLegend::draw_bar(const Eigen::AlignedBox2d& bar, Ink& ink, project::Image& image) const {
  const int rows = static_cast<int>(bar.sizes().y());
  std::vector<Eigen::Vector2d> curve = {{bar.min().x() - 1, bar.max().y()}};
  for (int row = rows - 1; row >= 0; --row) {
    const preint::Medium medium = scene_.transfer_function.at(value_at((rows - row - 0.5) / rows));
    const double y = bar.min().y() + row;
    const Eigen::AlignedBox2d strip(Eigen::Vector2d(bar.min().x(), y),
                                    Eigen::Vector2d(bar.max().x(), y + 1));
    if (scene_.mode == Mode::absorption) {
      paint(strip, preint::Color::Zero(), opacity(medium.extinction), image);
    } else {
      paint(strip, medium.color.max(0.0).min(1.0), 1, image);
    }
    curve.emplace_back(
        bar.min().x() - 1 - (curve_width() - 4 * scale_) * opacity(medium.extinction), y + 0.5);
  }
  frame(bar, ink);
  if (!has_curve_) return;
  curve.emplace_back(bar.min().x() - 1, bar.min().y());
  constexpr double kShade = 0.3;
  ink.fill(curve, kShade);
  for (std::size_t i = 2; i + 1 < curve.size(); ++i) {
    ink.line(curve[i - 1], curve[i], std::max(1.0, scale_));
  }
}

void ColorLegend::draw_swatches(const Eigen::AlignedBox2d& place, Ink& ink,
                                project::Image& image) const {
  std::vector<preint::Isosurface> surfaces = scene_.isosurfaces;
  std::sort(surfaces.begin(), surfaces.end(),
            [](const auto& a, const auto& b) { return a.value > b.value; });
  const double row = place.sizes().y() / static_cast<double>(surfaces.size());
  const double side = std::round(std::min(18 * scale_, 0.8 * row));
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const double middle = std::round(place.min().y() + (static_cast<double>(i) + 0.5) * row);
    const Eigen::Vector2d low(std::round(place.min().x()), std::round(middle - side / 2));
    const Eigen::AlignedBox2d swatch(low, Eigen::Vector2d(low.array() + side));
    paint(swatch, surfaces[i].color.max(0.0).min(1.0), surfaces[i].opacity, image);
    frame(swatch, ink);
    text_from(place.min().x() + 28 * scale_, middle, number_text(surfaces[i].value), label_font_,
              ink);
  }
}

}  // namespace tetraglass::apps
