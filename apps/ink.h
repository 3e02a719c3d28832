#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "preint/transfer_function.h"
#include "project/image.h"
#include "project/image_file.h"

namespace tetraglass::apps {

/// How text is set.
struct Font {
  double size = 14;  ///< pixels
  bool bold = false;
};

/// The text with a question mark in the place of each byte that is no UTF-8, and a space in that of
/// each control character.
[[nodiscard]] std::string printable(const std::string& text);

/// The width of a line of text and the height of its capitals and figures, in pixels.
[[nodiscard]] Eigen::Vector2d text_size(const std::string& text, const Font& font);

/// The text, or as much of it as fits into the width, with an ellipsis.
[[nodiscard]] std::string shortened(const std::string& text, const Font& font, double width);

/// What text and lines are drawn with so that they can be read on a background.
struct InkColor {
  double ink = 1;     ///< linear gray
  double paper = 0;   ///< that of the background, as it matters for the ink
  bool halo = false;  ///< the background is not known: a thin rim of the other color around it
};

/// Dark on light backgrounds (a luminance above 0.18, which looks half as bright as white), light
/// on dark ones; dark with a halo where the background lets through more than half.
[[nodiscard]] InkColor ink_for(const project::Background& background);

/// Text and lines, to be laid over a picture. Coordinates in pixels from the top left corner of the
/// picture. Throws UnavailableError where there is no font at all; tells on stderr, once, where
/// another than DejaVu Sans is taken.
class Ink {
 public:
  Ink(int width, int height);
  ~Ink();
  Ink(const Ink&) = delete;
  Ink& operator=(const Ink&) = delete;

  /// One line of text around its middle: across the half height of its figures.
  void text(const std::string& text, const Font& font, const Eigen::Vector2d& middle);
  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width);
  /// A closed shape, covered to a part.
  void fill(const std::vector<Eigen::Vector2d>& corners, double strength);

  /// Lays the ink over the picture of the same size: linear, premultiplied; edges are as they look
  /// best after sRGB encoding on the paper.
  void print(const InkColor& color, project::Image& image) const;

 private:
  struct Sheet;
  std::unique_ptr<Sheet> sheet_;
};

}  // namespace tetraglass::apps
