#pragma once

#include <string>

#include <Eigen/Geometry>

#include "apps/ink.h"
#include "apps/ticks.h"
#include "project/image.h"
#include "project/scene.h"

namespace tetraglass::apps {

/// What the colors of a picture stand for: a bar of the transfer function with its values, and
/// beside it the opacity of a path of a tenth of the mesh's diagonal at each value; in mode
/// absorption, whose light is black, the bar itself has that opacity; in mode mip, which is opaque,
/// there is none. In mode iso a swatch for each isosurface, as it looks on the background.
class ColorLegend {
 public:
  /// Of the scene, which outlives this. `title`: above, cut to `most_width`. `scale`: 1 in a
  /// picture of 800 x 600 pixels.
  ColorLegend(const project::Scene& scene, const std::string& title, bool logarithmic, double scale,
              double most_width);

  /// Pixels, without margins.
  [[nodiscard]] double width() const { return width_; }

  /// Draws it into the place of this width, its height as it needs or fits; colors go to the image,
  /// everything else to the ink.
  void draw(const Eigen::AlignedBox2d& place, Ink& ink, project::Image& image) const;

 private:
  [[nodiscard]] double bar_width() const { return 18 * scale_; }
  [[nodiscard]] double curve_width() const { return has_curve_ ? 30 * scale_ : 0; }
  /// Of a value, from 0 to 1.
  [[nodiscard]] double position(double value) const;
  [[nodiscard]] double value_at(double position) const;
  [[nodiscard]] double opacity(double extinction) const;
  void draw_bar(const Eigen::AlignedBox2d& bar, Ink& ink, project::Image& image) const;
  void draw_swatches(const Eigen::AlignedBox2d& place, Ink& ink, project::Image& image) const;

  const project::Scene& scene_;
  std::string title_;
  double low_ = 0;
  double high_ = 1;
  bool logarithmic_;
  bool has_curve_;
  double scale_;
  double path_ = 1;  ///< length
  Ticks ticks_;
  Font title_font_;
  Font label_font_;
  std::string multiplier_;  ///< of the labels; empty: 1
  double width_ = 0;
};

}  // namespace tetraglass::apps
