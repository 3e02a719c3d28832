#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/output_file.h"

namespace tetraglass::bench {

/// One quantity against another, both positive, on logarithmic axes, as an SVG picture: a line for
/// each way to draw, with points on it.
class LogPlot {
 public:
  LogPlot(std::string x_title, std::string y_title)
      : x_title_(std::move(x_title)), y_title_(std::move(y_title)) {}

  /// A point of the line `way`, with a label or none; in the order of the line.
  void add(const std::string& way, double x, double y, const std::string& label = "") {
    if (lines_.count(way) == 0) order_.push_back(way);
    lines_[way].push_back({x, y, label});
  }

  void write(const std::string& file) const {
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\" "
        "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" "
        "fill=\"white\"/>\n",
        kWidth, kHeight);
    svg += axes();
    for (std::size_t i = 0; i < order_.size(); ++i) svg += line(i);
    base::OutputFile out(file);
    out.write(svg + "</svg>\n");
    out.commit();
  }

 private:
  struct Point {
    double x;
    double y;
    std::string label;
  };
  static constexpr int kWidth = 760;
  static constexpr int kHeight = 460;
  static constexpr int kLeft = 60;
  static constexpr int kRight = 190;
  static constexpr int kTop = 15;
  static constexpr int kBottom = 45;

  /// Whole powers of ten around all points.
  [[nodiscard]] std::array<int, 2> decades(double Point::*what) const {
    std::array<int, 2> range = {1000, -1000};
    for (const auto& [way, points] : lines_) {
      for (const Point& point : points) {
        const double power = std::log10(point.*what);
        range[0] = std::min(range[0], static_cast<int>(std::floor(power)));
        range[1] = std::max(range[1], static_cast<int>(std::ceil(power)));
      }
    }
    return range;
  }
  [[nodiscard]] double place_x(double x) const {
    const auto [low, high] = decades(&Point::x);
    return kLeft + (std::log10(x) - low) / (high - low) * (kWidth - kLeft - kRight);
  }
  [[nodiscard]] double place_y(double y) const {
    const auto [low, high] = decades(&Point::y);
    return kHeight - kBottom - (std::log10(y) - low) / (high - low) * (kHeight - kTop - kBottom);
  }
  [[nodiscard]] std::string axes() const {
    std::string svg;
    const auto tick = [&](double x0, double y0, double x1, double y1) {
      svg += fmt::format(
          "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#ddd\"/>\n", x0,
          y0, x1, y1);
    };
    const auto text = [&](double at_x, double at_y, const char* anchor, const std::string& what) {
      svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", at_x,
                         at_y, anchor, what);
    };
    const auto [left, right] = decades(&Point::x);
    for (int power = left; power <= right; ++power) {
      const double at = place_x(std::pow(10, power));
      tick(at, kTop, at, kHeight - kBottom);
      text(at, kHeight - kBottom + 16, "middle", fmt::format("{:g}", std::pow(10, power)));
    }
    const auto [bottom, top] = decades(&Point::y);
    for (int power = bottom; power <= top; ++power) {
      const double at = place_y(std::pow(10, power));
      tick(kLeft, at, kWidth - kRight, at);
      text(kLeft - 6, at + 4, "end", fmt::format("1e{}", power));
    }
    text(0.5 * (kLeft + kWidth - kRight), kHeight - 8, "middle", x_title_);
    text(kLeft, kTop - 3, "start", y_title_);
    return svg;
  }
  [[nodiscard]] std::string line(std::size_t i) const {
    static constexpr std::array<const char*, 6> kColors = {"#1b6ca8", "#43a2ca", "#9bcde0",
                                                           "#b30000", "#e34a33", "#fdae61"};
    const char* color = kColors[i % kColors.size()];
    const std::vector<Point>& points = lines_.at(order_[i]);
    std::string path;
    std::string svg;
    for (const Point& point : points) {
      path += fmt::format("{:.1f},{:.1f} ", place_x(point.x), place_y(point.y));
      svg += fmt::format(
          "<circle cx=\"{0:.1f}\" cy=\"{1:.1f}\" r=\"3\" fill=\"{2}\"/>\n<text x=\"{3:.1f}\" "
          "y=\"{4:.1f}\" fill=\"{2}\" font-size=\"10\">{5}</text>\n",
          place_x(point.x), place_y(point.y), color, place_x(point.x) + 5, place_y(point.y) - 4,
          point.label);
    }
    svg += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\"/>\n", path, color);
    svg += fmt::format("<text x=\"{}\" y=\"{}\" fill=\"{}\">{}</text>\n", kWidth - kRight + 12,
                       kTop + 12 + 18 * static_cast<int>(i), color, order_[i]);
    return svg;
  }

  std::string x_title_;
  std::string y_title_;
  std::vector<std::string> order_;
  std::map<std::string, std::vector<Point>> lines_;
};

}  // namespace tetraglass::bench
