#include "project/light/lights.h"

#include <cmath>

#include <fmt/format.h>

#include "base/json_file.h"
#include "base/suggest.h"

namespace tetraglass::project {
namespace {

using base::JsonValue;

Eigen::Vector3d read_vector(const JsonValue& json) {
  const std::vector<double> numbers = json.numbers(3, "three numbers: x, y, z");
  const Eigen::Vector3d vector(numbers[0], numbers[1], numbers[2]);
  if (!vector.allFinite()) json.fail("must be finite");
  return vector;
}

preint::Color read_color(const JsonValue& object, const char* key) {
  const std::optional<JsonValue> json = object.find(key);
  if (!json) return preint::Color::Ones();
  const std::vector<double> numbers = json->numbers(3, "three numbers: red, green, blue");
  const preint::Color color(numbers[0], numbers[1], numbers[2]);
  if (!color.allFinite() || (color < 0).any()) json->fail("must be finite and not negative");
  return color;
}

DirectionalLight read_directional(const JsonValue& json) {
  json.allow_only({"type", "direction", "color"});
  const DirectionalLight light{read_vector(json.member("direction")), read_color(json, "color")};
  if (light.direction.isZero(0)) json.member("direction").fail("must not be 0");
  return light;
}

PointLight read_point(const JsonValue& json) {
  json.allow_only({"type", "position", "color"});
  return {read_vector(json.member("position")), read_color(json, "color")};
}

RectangleLight read_rectangle(const JsonValue& json) {
  json.allow_only({"type", "corner", "edges", "color"});
  const JsonValue edges = json.member("edges");
  const std::vector<JsonValue> list = edges.list("two edges");
  if (list.size() != 2) edges.fail("must be a list of two edges");
  return {read_vector(json.member("corner")),
          {read_vector(list[0]), read_vector(list[1])},
          read_color(json, "color")};
}

}  // namespace

Lights read_lights(const std::string& file) {
  const JsonValue root = JsonValue::read(file);
  root.allow_only({"ambient", "lights"});
  Lights result;
  result.ambient = read_color(root, "ambient");
  for (const JsonValue& json : root.member("lights").list("lights")) {
    const std::string type = json.member("type").text();
    if (type == "directional") {
      result.lights.emplace_back(read_directional(json));
    } else if (type == "point") {
      result.lights.emplace_back(read_point(json));
    } else if (type == "rectangle") {
      result.lights.emplace_back(read_rectangle(json));
    } else {
      json.member("type").fail(
          fmt::format("is no light: '{}'{}", type,
                      base::suggestion(type, {"directional", "point", "rectangle"})));
    }
  }
  return result;
}

}  // namespace tetraglass::project
