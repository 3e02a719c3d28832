#include "apps/ink.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

#include <cairo.h>
#include <fmt/format.h>
#include <fontconfig/fontconfig.h>

#include "apps/mesh_input.h"
#include "base/errors.h"

namespace tetraglass::apps {
namespace {

constexpr const char* kFamily = "DejaVu Sans";

/// The family that the system has for ours; empty where it has no font.
std::string installed_family() {
  FcPattern* wanted = FcPatternCreate();
  FcPatternAddString(wanted, FC_FAMILY, reinterpret_cast<const FcChar8*>(kFamily));
  FcConfigSubstitute(nullptr, wanted, FcMatchPattern);
  FcDefaultSubstitute(wanted);
  FcResult result = FcResultNoMatch;
  FcPattern* found = FcFontMatch(nullptr, wanted, &result);
  std::string family;
  FcChar8* name = nullptr;
  if (found != nullptr && FcPatternGetString(found, FC_FAMILY, 0, &name) == FcResultMatch) {
    family = reinterpret_cast<const char*>(name);
  }
  if (found != nullptr) FcPatternDestroy(found);
  FcPatternDestroy(wanted);
  return family;
}

void check_font() {
  static const std::string kInstalled = [] {
    std::string name = installed_family();
    if (!name.empty() && name != kFamily)
      warn(fmt::format("the font {} is not installed: text is set in {}", kFamily, name));
    return name;
  }();
  if (kInstalled.empty()) {
    throw base::UnavailableError(
        "there is no font for the text around the picture: install fonts-dejavu-core, or leave out "
        "--legend, --axes and --title");
  }
}

/// A sheet of coverage and the pen over it.
class Pen {
 public:
  Pen(int width, int height)
      : surface_(cairo_image_surface_create(CAIRO_FORMAT_A8, width, height)),
        cairo_(cairo_create(surface_)) {
    if (cairo_status(cairo_) != CAIRO_STATUS_SUCCESS) {
      const std::string why = cairo_status_to_string(cairo_status(cairo_));
      cairo_destroy(cairo_);
      cairo_surface_destroy(surface_);
      throw base::UnavailableError(
          fmt::format("no text can be drawn over {} x {} pixels: {}", width, height, why));
    }
  }
  ~Pen() {
    cairo_destroy(cairo_);
    cairo_surface_destroy(surface_);
  }
  Pen(const Pen&) = delete;
  Pen& operator=(const Pen&) = delete;

  [[nodiscard]] cairo_t* get() const { return cairo_; }

  void set_font(const Font& font) const {
    cairo_select_font_face(cairo_, kFamily, CAIRO_FONT_SLANT_NORMAL,
                           font.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo_, font.size);
  }

  /// 0 to 255 of a pixel.
  [[nodiscard]] int coverage(int x, int y) const {
    return cairo_image_surface_get_data(surface_)[y * cairo_image_surface_get_stride(surface_) + x];
  }
  void finish() const { cairo_surface_flush(surface_); }

 private:
  cairo_surface_t* surface_;
  cairo_t* cairo_;
};

}  // namespace

std::string printable(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const std::size_t length = byte < 0x80 ? 1 : byte >= 0xf0 ? 4 : byte >= 0xe0 ? 3 : 2;
    bool good = i + length <= text.size();
    std::uint32_t code = length == 1 ? byte : byte & (0xffU >> (length + 1));
    for (std::size_t k = 1; good && k < length; ++k) {
      const auto next = static_cast<unsigned char>(text[i + k]);
      good = (next & 0xc0U) == 0x80U;
      code = code << 6U | (next & 0x3fU);
    }
    // Not longer than need be, no surrogates, none beyond the last: as RFC 3629 has it.
    constexpr std::array<std::uint32_t, 5> kLeast = {0, 0, 0x80, 0x800, 0x10000};
    good = good && (byte < 0x80 || (byte >= 0xc2 && byte < 0xf8)) && code >= kLeast[length] &&
           code <= 0x10ffff && (code < 0xd800 || code > 0xdfff);
    if (!good) {
      result += '?';
      ++i;
      continue;
    }
    result += code < 0x20 || code == 0x7f ? " " : text.substr(i, length);
    i += length;
  }
  return result;
}

Eigen::Vector2d text_size(const std::string& text, const Font& font) {
  check_font();
  const Pen pen(1, 1);
  pen.set_font(font);
  cairo_text_extents_t line;
  cairo_text_extents_t figure;
  cairo_text_extents(pen.get(), text.c_str(), &line);
  cairo_text_extents(pen.get(), "0", &figure);
  return {line.x_advance, figure.height};
}

std::string shortened(const std::string& text, const Font& font, double width) {
  if (text_size(text, font).x() <= width) return text;
  std::string part = text;
  while (!part.empty()) {
    // Whole characters: UTF-8 continues with bytes 10xxxxxx.
    while (!part.empty() && (static_cast<unsigned char>(part.back()) & 0xC0U) == 0x80U)
      part.pop_back();
    if (!part.empty()) part.pop_back();
    while (!part.empty() && part.back() == ' ') part.pop_back();
    if (text_size(part + "…", font).x() <= width) break;
  }
  return part + "…";
}

InkColor ink_for(const project::Background& background) {
  if (background.alpha < 0.5) return {0.01, 1, true};
  const double luminance =
      0.2126 * background.rgb[0] + 0.7152 * background.rgb[1] + 0.0722 * background.rgb[2];
  // A little softer than black and white where that leaves contrast enough.
  if (luminance > 0.18) return {luminance > 0.5 ? 0.01 : 0, luminance, false};
  return {luminance < 0.05 ? 0.83 : 1, luminance, false};
}

struct Ink::Sheet {
  Sheet(int w, int h) : width(w), height(h), ink(w, h), halo(w, h) {}
  int width;
  int height;
  Pen ink;
  Pen halo;  ///< the same, wider
};

Ink::Ink(int width, int height) : sheet_(std::make_unique<Sheet>(width, height)) {}
Ink::~Ink() = default;

void Ink::text(const std::string& text, const Font& font, const Eigen::Vector2d& middle) {
  const Eigen::Vector2d size = text_size(text, font);
  // The base line on whole pixels: figures and capitals are then as sharp as they can be.
  const double x = std::round(middle.x() - size.x() / 2);
  const double y = std::round(middle.y() + size.y() / 2);
  for (const Pen* pen : {&sheet_->ink, &sheet_->halo}) {
    pen->set_font(font);
    cairo_move_to(pen->get(), x, y);
    if (pen == &sheet_->ink) {
      cairo_show_text(pen->get(), text.c_str());
      continue;
    }
    cairo_text_path(pen->get(), text.c_str());
    cairo_set_line_join(pen->get(), CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_width(pen->get(), std::max(2.0, font.size / 6));
    cairo_stroke(pen->get());
  }
}

void Ink::line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width) {
  for (const Pen* pen : {&sheet_->ink, &sheet_->halo}) {
    cairo_set_line_width(pen->get(), pen == &sheet_->ink ? width : width + 2);
    cairo_set_line_cap(pen->get(), CAIRO_LINE_CAP_ROUND);
    cairo_move_to(pen->get(), from.x(), from.y());
    cairo_line_to(pen->get(), to.x(), to.y());
    cairo_stroke(pen->get());
  }
}

void Ink::fill(const std::vector<Eigen::Vector2d>& corners, double strength) {
  cairo_t* cairo = sheet_->ink.get();
  for (const Eigen::Vector2d& corner : corners) cairo_line_to(cairo, corner.x(), corner.y());
  cairo_close_path(cairo);
  cairo_set_source_rgba(cairo, 0, 0, 0, strength);
  cairo_fill(cairo);
  cairo_set_source_rgba(cairo, 0, 0, 0, 1);
}

void Ink::print(const InkColor& color, project::Image& image) const {
  sheet_->ink.finish();
  sheet_->halo.finish();
  // A pixel half covered should look half way between paper and ink: the part of the ink that gives
  // that in linear light.
  const double paper = project::srgb_encode(std::clamp(color.paper, 0.0, 1.0));
  const double ink = project::srgb_encode(color.ink);
  const auto part = [&](double coverage) {
    if (color.halo || std::abs(color.ink - color.paper) < 1e-3) return coverage;
    const double wanted = project::srgb_decode(paper + coverage * (ink - paper));
    return std::clamp((wanted - color.paper) / (color.ink - color.paper), 0.0, 1.0);
  };
  const auto over = [](double gray, double alpha, float* rgba) {
    for (int c = 0; c < 4; ++c) {
      rgba[c] = static_cast<float>(alpha * (c < 3 ? gray : 1) +
                                   (1 - alpha) * static_cast<double>(rgba[c]));
    }
  };
  for (int y = 0; y < sheet_->height; ++y) {
    for (int x = 0; x < sheet_->width; ++x) {
      if (color.halo) {
        const int rim = sheet_->halo.coverage(x, y);
        if (rim > 0) over(1, 0.85 * rim / 255.0, image.pixel(x, y));
      }
      const int covered = sheet_->ink.coverage(x, y);
      if (covered > 0) over(color.ink, part(covered / 255.0), image.pixel(x, y));
    }
  }
}

}  // namespace tetraglass::apps
