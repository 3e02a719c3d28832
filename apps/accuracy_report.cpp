#include "apps/accuracy_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "base/errors.h"

namespace tetraglass::apps {
namespace {

using project::Study;
using project::StudyPoint;

// Below this an error cannot be told from that of the floats in a picture.
constexpr double kLeastError = 1e-7;

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string base64(const std::string& bytes) {
  static constexpr std::array<char, 65> kDigits = {
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"};
  std::string result;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      result += i + k <= bytes.size() ? kDigits[word >> (18 - 6 * k) & 63U] : '=';
    }
  }
  return result;
}

/// A folder for the pictures on their way into the page.
class Scratch {
 public:
  Scratch() {
    std::string pattern = (std::filesystem::temp_directory_path() / "tetraglass-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) {
      throw base::WriteError(pattern, "cannot make a temporary folder");
    }
    path_ = pattern;
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  [[nodiscard]] std::string png(const project::Image& image,
                                const project::Background& background) const {
    const std::string file = (path_ / "picture.png").string();
    (void)project::write_image(image, file, background);
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

 private:
  std::filesystem::path path_;
};

/// Logarithmic from the lowest to the highest power of ten around the values.
struct Axis {
  int first = 0;
  int last = 0;
  double from = 0;  ///< position of `first`
  double to = 0;

  Axis(double least, double most, double start, double end)
      : first(static_cast<int>(std::floor(std::log10(least)))),
        last(std::max(first + 1, static_cast<int>(std::ceil(std::log10(most))))),
        from(start),
        to(end) {}

  [[nodiscard]] double at(double value) const {
    return from + (to - from) * (std::log10(value) - first) / (last - first);
  }
};

double shown_error(const StudyPoint& point) {
  return std::max(point.error.max, kLeastError);
}

std::vector<const StudyPoint*> drawn(const Study& study) {
  std::vector<const StudyPoint*> result;
  for (const StudyPoint& point : study.points) {
    if (point.failure.empty()) result.push_back(&point);
  }
  return result;
}

std::string color_of(const std::string& knob) {
  static const std::map<std::string, std::string> kColors = {
      {"projector", "#222222"}, {"opaque at", "#7a7a7a"}, {"integrator", "#0b62c4"},
      {"order", "#c4410b"},     {"layout", "#0b8a3d"},    {"target", "#9a0bc4"},
      {"shading", "#00838f"},   {"slices", "#b0126a"}};
  const auto found = kColors.find(knob);
  return found == kColors.end() ? "#b08a00" : found->second;
}

std::string grid_lines(const Axis& x, const Axis& y) {
  std::string svg;
  for (int i = x.first; i <= x.last; ++i) {
    const double at = x.at(std::pow(10.0, i));
    svg += fmt::format(
        "<line x1='{0:.1f}' y1='{1:.1f}' x2='{0:.1f}' y2='{2:.1f}' class='grid'/><text x='{0:.1f}' "
        "y='{3:.1f}' text-anchor='middle'>{4:g} ms</text>\n",
        at, y.from, y.to, y.from + 18, std::pow(10.0, i));
  }
  for (int i = y.first; i <= y.last; ++i) {
    const double at = y.at(std::pow(10.0, i));
    svg += fmt::format(
        "<line x1='{1:.1f}' y1='{0:.1f}' x2='{2:.1f}' y2='{0:.1f}' class='grid'/><text x='{3:.1f}' "
        "y='{4:.1f}' text-anchor='end'>{5:g}</text>\n",
        at, x.from, x.to, x.from - 6, at + 4, std::pow(10.0, i));
  }
  return svg;
}

/// Through the points that come nearest to one of the references in their time.
std::string front_line(const std::vector<const StudyPoint*>& points, bool of_grid, const Axis& x,
                       const Axis& y) {
  std::vector<const StudyPoint*> front;
  std::copy_if(points.begin(), points.end(), std::back_inserter(front),
               [&](const StudyPoint* point) {
                 return point->on_front && draws_grid(point->what) == of_grid;
               });
  std::sort(front.begin(), front.end(),
            [](const StudyPoint* a, const StudyPoint* b) { return a->frame_ms < b->frame_ms; });
  std::string line;
  for (const StudyPoint* point : front) {
    line += fmt::format("{:.1f},{:.1f} ", x.at(std::max(point->frame_ms, 1e-3)),
                        y.at(shown_error(*point)));
  }
  return fmt::format("<polyline class='front{}' points='{}'/>\n", of_grid ? " of-grid" : "", line);
}

std::string diagram(const Study& study) {
  const std::vector<const StudyPoint*> points = drawn(study);
  double least = points.front()->frame_ms;
  double most = least;
  double worst = kLeastError;
  for (const StudyPoint* point : points) {
    least = std::min(least, point->frame_ms);
    most = std::max(most, point->frame_ms);
    worst = std::max(worst, shown_error(*point));
  }
  const Axis x(std::max(least, 1e-3), std::max(most, 1e-3), 80, 940);
  const Axis y(kLeastError, worst, 480, 20);
  std::string svg = "<svg viewBox='0 0 1120 520' role='img'>\n" + grid_lines(x, y);
  for (const bool of_grid : {false, true}) svg += front_line(points, of_grid, x, y);
  for (const StudyPoint* point : points) {
    const double px = x.at(std::max(point->frame_ms, 1e-3));
    const double py = y.at(shown_error(*point));
    svg += fmt::format(
        "<circle cx='{:.1f}' cy='{:.1f}' r='{}' fill='{}'><title>{}: {:.3g} ms, largest error "
        "{:.2g}</title></circle>\n",
        px, py, point->on_front ? 6 : 4, color_of(point->what.knob), escaped(point->what.name),
        point->frame_ms, point->error.max);
    if (point->on_front) {
      svg += fmt::format("<text x='{:.1f}' y='{:.1f}' class='name'>{}</text>\n", px + 9, py - 6,
                         escaped(point->what.name));
    }
  }
  return svg + "</svg>\n";
}

std::string table(const Study& study) {
  std::string html =
      "<table><tr><th>knob<th>case<th>frame, ms<th>set-up, ms<th>largest error<th>RMS<th>PSNR, "
      "dB<th>front</tr>\n";
  for (const StudyPoint& point : study.points) {
    html += fmt::format("<tr><td style='color:{}'>{}<td>{}", color_of(point.what.knob),
                        escaped(point.what.knob), escaped(point.what.name));
    if (!point.failure.empty()) {
      html += "<td colspan='6'>" + escaped(point.failure) + "</tr>\n";
      continue;
    }
    html += fmt::format("<td>{:.1f}<td>{:.1f}<td>{:.2g}<td>{:.2g}<td>{:.1f}<td>{}</tr>\n",
                        point.frame_ms, point.set_up_ms, point.error.max, point.error.rms,
                        point.error.psnr_db, point.on_front ? "on it" : "");
  }
  return html + "</table>\n";
}

std::string figure(const Scratch& scratch, const project::Image& image,
                   const project::Background& background, const std::string& caption) {
  return "<figure><img alt='' src='data:image/png;base64," +
         base64(scratch.png(image, background)) + "'><figcaption>" + escaped(caption) +
         "</figcaption></figure>\n";
}

std::string pictures(const Study& study, const project::Background& background) {
  const Scratch scratch;
  std::string html;
  for (const StudyPoint& point : study.points) {
    if (!point.failure.empty()) continue;
    html += "<div class='pair'>" +
            figure(scratch, point.image, background,
                   fmt::format("{}, {:.1f} ms", point.what.name, point.frame_ms)) +
            figure(scratch, difference_image(point.image, study.judge(point), point.error), {},
                   point.error.max > 0 ? fmt::format("difference; white is {:.2g}", point.error.max)
                                       : "no difference") +
            "</div>\n";
  }
  return html;
}

constexpr const char* kStyle =
    "body{font:15px/1.5 system-ui,sans-serif;margin:2em auto;max-width:1160px;color:#222}"
    "svg{width:100%;font:12px system-ui,sans-serif}.grid{stroke:#e2e2e2}"
    ".front{fill:none;stroke:#d9a400;stroke-width:2}.of-grid{stroke-dasharray:5 "
    "4}.name{font-weight:600}"
    "table{border-collapse:collapse}td,th{padding:2px 12px;text-align:right;border-bottom:1px "
    "solid "
    "#e2e2e2}td:nth-child(-n+2),th:nth-child(-n+2){text-align:left}"
    ".pair{display:inline-block;margin:0 12px 12px 0}figure{display:inline-block;margin:0}"
    "img{width:270px;display:block}figcaption{font-size:12px;max-width:270px}";

}  // namespace

std::string accuracy_html(const Study& study, const std::string& title,
                          const std::string& description, const project::Background& background) {
  std::string knobs;
  std::vector<std::string> told;
  for (const StudyPoint& point : study.points) {
    if (std::find(told.begin(), told.end(), point.what.knob) != told.end()) continue;
    told.push_back(point.what.knob);
    knobs += fmt::format("<b style='color:{}'>{}</b> ", color_of(point.what.knob),
                         escaped(point.what.knob));
  }
  const char* of_grid = study.grid_reference.rgba.empty()
                            ? ""
                            : " Slices draw the trilinear field of the grid instead of its cells: "
                              "they have a reference and a line (dashed) of their own.";
  return fmt::format(
      "<!DOCTYPE html>\n<html lang='en'><head><meta charset='utf-8'><title>{0}</title>"
      "<style>{1}</style></head><body>\n<h1>{0}</h1>\n<p>{2}</p>\n"
      "<p>Largest error of any channel against the time of a frame (medians of rounds in which the "
      "cases take turns). The line is the Pareto front: no other case is both faster and nearer to "
      "the reference.{7} Knobs: {3}</p>\n{4}{5}<h2>Pictures</h2>\n{6}</body></html>\n",
      escaped(title), kStyle, escaped(description), knobs, diagram(study), table(study),
      pictures(study, background), of_grid);
}

std::string accuracy_csv(const Study& study) {
  std::string csv = "knob,case,frame_ms,set_up_ms,max_error,rms_error,psnr_db,on_front,failure\n";
  for (const StudyPoint& point : study.points) {
    std::string failure = point.failure;
    std::replace(failure.begin(), failure.end(), '"', '\'');
    csv += fmt::format("{},\"{}\",{:.4g},{:.4g},{:.4g},{:.4g},{:.2f},{},\"{}\"\n", point.what.knob,
                       point.what.name, point.frame_ms, point.set_up_ms, point.error.max,
                       point.error.rms, point.error.psnr_db, point.on_front ? 1 : 0, failure);
  }
  return csv;
}

}  // namespace tetraglass::apps
