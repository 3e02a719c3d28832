#include "preint/paraview_color_map.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include <expat.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "base/suggest.h"
#include "preint/color_spaces.h"
#include "preint/preset_scale.h"
#include "preint/transfer_function_edit.h"

namespace tetraglass::preint {
namespace {

using Json = nlohmann::json;

struct MapPoint {
  double x = 0;
  double opacity = -1;  ///< none
  Color srgb = Color::Zero();
};

struct ParaviewMap {
  std::string name;
  std::string space = "RGB";
  bool categories = false;
  std::vector<MapPoint> points;
  std::vector<std::pair<double, double>>
      opacities;  ///< (x, opacity), where they have places of their own
};

std::string content(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in.is_open()) throw base::ReadError(file, "cannot be read");
  try {
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  } catch (const std::ios_base::failure&) {
    throw base::ReadError(file, "cannot be read");
  }
}

std::vector<ParaviewMap> parse_json(const std::string& file, const std::string& text) {
  Json root;
  try {
    root = Json::parse(text);
    if (root.is_object()) root = Json::array({root});
    std::vector<ParaviewMap> maps;
    for (const Json& entry : root) {
      ParaviewMap map;
      map.name = entry.value("Name", "");
      map.space = entry.value("ColorSpace", "RGB");
      map.categories = entry.contains("IndexedColors") && !entry.contains("RGBPoints");
      const auto rgb = entry.value("RGBPoints", std::vector<double>{});
      const auto points = entry.value("Points", std::vector<double>{});
      if (rgb.size() % 4 != 0)
        throw base::ReadError(file, "'RGBPoints' must be x, r, g, b, x, r, ...");
      if (points.size() % 4 != 0)
        throw base::ReadError(file, "'Points' must be x, opacity, 0.5, 0, x, ...");
      for (std::size_t i = 0; i < rgb.size(); i += 4) {
        map.points.push_back({rgb[i], -1, {rgb[i + 1], rgb[i + 2], rgb[i + 3]}});
      }
      for (std::size_t i = 0; i < points.size(); i += 4)
        map.opacities.emplace_back(points[i], points[i + 1]);
      maps.push_back(std::move(map));
    }
    return maps;
  } catch (const Json::exception& error) {
    const std::string what = error.what();
    const std::size_t bracket = what.find("] ");
    throw base::ReadError(file,
                          "is no ParaView color map: " +
                              (bracket == std::string::npos ? what : what.substr(bracket + 2)));
  }
}

/// Collects maps while expat calls back; the first complaint is kept, for exceptions must not cross
/// C.
struct XmlReader {
  XML_Parser parser = nullptr;
  std::vector<ParaviewMap> maps;
  std::string complaint;

  void start(const std::string& element, const std::map<std::string, std::string>& attributes) {
    const auto text = [&](const char* key) {
      const auto found = attributes.find(key);
      return found == attributes.end() ? std::string() : found->second;
    };
    if (element == "ColorMap") {
      ParaviewMap map;
      map.name = text("name");
      if (!text("space").empty()) map.space = text("space");
      map.categories = text("indexedlookup") == "true" || text("indexedLookup") == "1";
      maps.push_back(std::move(map));
    } else if (element == "Point" && !maps.empty()) {
      MapPoint p{number(text("x"), "x"),
                 -1,
                 {number(text("r"), "r"), number(text("g"), "g"), number(text("b"), "b")}};
      if (!text("o").empty()) p.opacity = number(text("o"), "o");
      maps.back().points.push_back(p);
    }
  }

  double number(const std::string& text, const char* key) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if ((text.empty() || *end != '\0') && complaint.empty()) {
      complaint = fmt::format("line {}: a Point needs a number for {}, not '{}'",
                              XML_GetCurrentLineNumber(parser), key, text);
    }
    return value;
  }
};

void XMLCALL start_element(void* user, const XML_Char* element, const XML_Char** attributes) {
  std::map<std::string, std::string> values;
  for (const XML_Char** a = attributes; *a != nullptr; a += 2) values[a[0]] = a[1];
  static_cast<XmlReader*>(user)->start(element, values);
}

std::vector<ParaviewMap> parse_xml(const std::string& file, const std::string& text) {
  const std::unique_ptr<std::remove_pointer_t<XML_Parser>, decltype(&XML_ParserFree)> parser(
      XML_ParserCreate(nullptr), &XML_ParserFree);
  XmlReader reader;
  reader.parser = parser.get();
  XML_SetUserData(parser.get(), &reader);
  XML_SetElementHandler(parser.get(), &start_element, nullptr);
  if (XML_Parse(parser.get(), text.data(), static_cast<int>(text.size()), 1) != XML_STATUS_OK) {
    throw base::ReadError(file, fmt::format("is not XML: line {}, column {}: {}",
                                            XML_GetCurrentLineNumber(parser.get()),
                                            XML_GetCurrentColumnNumber(parser.get()),
                                            XML_ErrorString(XML_GetErrorCode(parser.get()))));
  }
  if (!reader.complaint.empty()) throw base::ReadError(file, reader.complaint);
  return std::move(reader.maps);
}

const ParaviewMap& choose(const std::string& file, const std::vector<ParaviewMap>& maps,
                          const std::string& name) {
  if (maps.empty()) throw base::ReadError(file, "has no color map");
  if (name.empty()) return maps.front();
  std::vector<std::string> names;
  for (const ParaviewMap& map : maps) {
    if (map.name == name) return map;
    names.push_back(map.name);
  }
  throw base::UsageError(
      fmt::format("{} has no color map '{}'{}", file, name, base::suggestion(name, names)));
}

void check(const std::string& file, const ParaviewMap& map) {
  if (map.categories)
    throw base::ReadError(file, "'" + map.name + "' colors categories, not a range of values");
  if (map.points.size() < 2)
    throw base::ReadError(file, "'" + map.name + "' has fewer than two points");
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    const MapPoint& p = map.points[i];
    const bool right =
        std::isfinite(p.x) && (p.srgb >= 0).all() && (p.srgb <= 1).all() && p.opacity <= 1;
    if (!right) {
      throw base::ReadError(
          file, fmt::format("'{}': point {} has no finite x, or a color or opacity outside [0, 1]",
                            map.name, i));
    }
    if (i > 0 && p.x < map.points[i - 1].x) {
      throw base::ReadError(file, fmt::format("'{}': x must not decrease, {} comes after {}",
                                              map.name, p.x, map.points[i - 1].x));
    }
  }
  if (!(map.points.front().x < map.points.back().x))
    throw base::ReadError(file, "'" + map.name + "' spans no range");
}

/// The color space, none for steps.
std::optional<ColorSpace> color_space(const std::string& file, const ParaviewMap& map) {
  static const std::map<std::string, std::optional<ColorSpace>> kSpaces = {
      {"RGB", ColorSpace::rgb},
      {"HSV", ColorSpace::hsv},
      {"Lab", ColorSpace::lab},
      {"Diverging", ColorSpace::diverging},
      {"Step", std::nullopt}};
  const auto found = kSpaces.find(map.space);
  if (found != kSpaces.end()) return found->second;
  std::vector<std::string> names;
  names.reserve(kSpaces.size());
  for (const auto& [name, space] : kSpaces) names.push_back(name);
  throw base::ReadError(file, fmt::format("'{}' has an unknown color space '{}'{}", map.name,
                                          map.space, base::suggestion(map.space, names)));
}

/// (x, extinction) in the map's own x, ascending; empty where the file has no opacities.
std::vector<ControlPoint> extinctions(const std::string& file, const ParaviewMap& map,
                                      double diagonal) {
  std::vector<std::pair<double, double>> list = map.opacities;
  if (list.empty() && map.points.front().opacity >= 0) {
    for (const MapPoint& p : map.points) list.emplace_back(p.x, std::max(0.0, p.opacity));
  }
  std::vector<ControlPoint> result;
  for (const auto& [x, opacity] : list) {
    if (!(opacity >= 0 && opacity <= 1))
      throw base::ReadError(file,
                            fmt::format("'{}': opacity {} is outside [0, 1]", map.name, opacity));
    result.push_back({x, Color::Zero(), -std::log1p(-std::min(opacity, 0.999)) * 10 / diagonal});
  }
  return result;
}

Color linear(const Color& srgb) {
  return srgb.unaryExpr(&linear_from_srgb);
}

/// The colors at the map's own x, with points between so that linear RGB follows the map's space.
std::vector<ControlPoint> colors(const std::string& file, const ParaviewMap& map) {
  const std::optional<ColorSpace> space = color_space(file, map);
  const std::size_t intervals = map.points.size() - 1;
  const std::size_t parts = std::max<std::size_t>(2, (128 + intervals - 1) / intervals);
  std::vector<ControlPoint> result;
  for (std::size_t i = 0; i < intervals; ++i) {
    const MapPoint& a = map.points[i];
    const MapPoint& b = map.points[i + 1];
    result.push_back({a.x, linear(a.srgb), 0});
    if (!space) {
      result.push_back({b.x, linear(a.srgb), 0});
      continue;
    }
    for (std::size_t part = 1; part < parts; ++part) {
      const double t = static_cast<double>(part) / static_cast<double>(parts);
      const double x = a.x * (1 - t) + b.x * t;
      if (x > a.x && x < b.x)
        result.push_back({x, linear(interpolate_srgb(*space, a.srgb, b.srgb, t)), 0});
    }
  }
  result.push_back({map.points.back().x, linear(map.points.back().srgb), 0});
  return result;
}

}  // namespace

TransferFunction read_paraview_color_map(const std::string& file, const std::string& name,
                                         double low, double high, double diagonal) {
  if (!(low < high))
    throw base::UsageError(
        fmt::format("a color map needs a range with low < high, not {}:{}", low, high));
  if (!(diagonal > 0))
    throw base::InputError(fmt::format("the mesh's diagonal must be positive, not {}", diagonal));
  const std::string text = content(file);
  const std::size_t first = text.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  const bool xml = first != std::string::npos && text[first] == '<';
  const std::vector<ParaviewMap> maps = xml ? parse_xml(file, text) : parse_json(file, text);
  const ParaviewMap& map = choose(file, maps, name);
  check(file, map);

  std::vector<ControlPoint> points = colors(file, map);
  const double x0 = points.front().value;
  const double x1 = points.back().value;
  try {
    std::vector<ControlPoint> ramp = extinctions(file, map, diagonal);
    if (ramp.empty()) ramp = {{x0, Color::Zero(), 0}, {x1, Color::Zero(), kDepthAtTop / diagonal}};
    points = with_extinction_of(TransferFunction(points), TransferFunction(ramp)).points();
    for (ControlPoint& p : points) {
      const double t = (p.value - x0) / (x1 - x0);
      p.value = low * (1 - t) + high * t;
    }
    return TransferFunction(std::move(points));
  } catch (const base::InputError& error) {
    throw base::ReadError(file, fmt::format("'{}': {}", map.name, error.what()));
  }
}

}  // namespace tetraglass::preint
