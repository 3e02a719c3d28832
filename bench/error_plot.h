#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/output_file.h"

namespace tetraglass::bench {

/// Error against time, both logarithmic, as an SVG picture: one line for each way to draw, one
/// point on it for each size.
class ErrorPlot {
 public:
  /// `way` at a size took `ms` and was off by `error`; sizes ascending.
  void add(const std::string& way, int size, double error, double ms) {
    if (lines_.count(way) == 0) order_.push_back(way);
    lines_[way].push_back({size, error, ms});
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
    int size;
    double error;
    double ms;
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
  [[nodiscard]] double x(double ms) const {
    const auto [low, high] = decades(&Point::ms);
    return kLeft + (std::log10(ms) - low) / (high - low) * (kWidth - kLeft - kRight);
  }
  [[nodiscard]] double y(double error) const {
    const auto [low, high] = decades(&Point::error);
    return kHeight - kBottom -
           (std::log10(error) - low) / (high - low) * (kHeight - kTop - kBottom);
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
    const auto [fast, slow] = decades(&Point::ms);
    for (int power = fast; power <= slow; ++power) {
      const double at = x(std::pow(10, power));
      tick(at, kTop, at, kHeight - kBottom);
      text(at, kHeight - kBottom + 16, "middle", fmt::format("{:g}", std::pow(10, power)));
    }
    const auto [right, wrong] = decades(&Point::error);
    for (int power = right; power <= wrong; ++power) {
      const double at = y(std::pow(10, power));
      tick(kLeft, at, kWidth - kRight, at);
      text(kLeft - 6, at + 4, "end", fmt::format("1e{}", power));
    }
    text(0.5 * (kLeft + kWidth - kRight), kHeight - 8, "middle", "milliseconds a frame");
    text(kLeft, kTop - 3, "start", "RMS error");
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
      path += fmt::format("{:.1f},{:.1f} ", x(point.ms), y(point.error));
      svg += fmt::format(
          "<circle cx=\"{0:.1f}\" cy=\"{1:.1f}\" r=\"3\" fill=\"{2}\"/>\n<text x=\"{3:.1f}\" "
          "y=\"{4:.1f}\" fill=\"{2}\" font-size=\"10\">{5}</text>\n",
          x(point.ms), y(point.error), color, x(point.ms) + 5, y(point.error) - 4, point.size);
    }
    svg += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\"/>\n", path, color);
    svg += fmt::format("<text x=\"{}\" y=\"{}\" fill=\"{}\">{}</text>\n", kWidth - kRight + 12,
                       kTop + 12 + 18 * static_cast<int>(i), color, order_[i]);
    return svg;
  }

  std::vector<std::string> order_;
  std::map<std::string, std::vector<Point>> lines_;
};

}  // namespace tetraglass::bench
