#include "preint/transfer_function_file.h"

#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/errors.h"
#include "base/json_file.h"
#include "base/output_file.h"

namespace tetraglass::preint {
namespace {

ControlPoint read_point(const base::JsonValue& json) {
  json.allow_only({"value", "color", "extinction", "ambient", "diffuse", "specular", "shininess"});
  ControlPoint result;
  result.value = json.member("value").number();
  result.extinction = json.member("extinction").number();
  const std::vector<double> color =
      json.member("color").numbers(3, "three numbers: red, green, blue");
  result.color = {color[0], color[1], color[2]};
  const auto optional = [&](const char* key, double& coefficient) {
    if (const auto found = json.find(key)) coefficient = found->number();
  };
  optional("ambient", result.material.ambient);
  optional("diffuse", result.material.diffuse);
  optional("specular", result.material.specular);
  optional("shininess", result.material.shininess);
  return result;
}

}  // namespace

TransferFunction read_transfer_function(const std::string& file) {
  const base::JsonValue root = base::JsonValue::read(file);
  root.allow_only({"points"});
  std::vector<ControlPoint> points;
  for (const base::JsonValue& json : root.member("points").list("points")) {
    points.push_back(read_point(json));
  }
  try {
    return TransferFunction(std::move(points));
  } catch (const base::InputError& error) {
    throw base::ReadError(file, error.what());
  }
}

void write_transfer_function(const TransferFunction& tf, const std::string& file) {
  const Material usual;
  std::string text = "{\"points\": [";
  std::string separator = "\n";
  for (const ControlPoint& point : tf.points()) {
    text +=
        fmt::format("{}  {{\"value\": {}, \"color\": [{}, {}, {}], \"extinction\": {}", separator,
                    point.value, point.color[0], point.color[1], point.color[2], point.extinction);
    const auto coefficient = [&](const char* key, double value, double default_value) {
      if (value != default_value) text += fmt::format(", \"{}\": {}", key, value);
    };
    coefficient("ambient", point.material.ambient, usual.ambient);
    coefficient("diffuse", point.material.diffuse, usual.diffuse);
    coefficient("specular", point.material.specular, usual.specular);
    coefficient("shininess", point.material.shininess, usual.shininess);
    text += "}";
    separator = ",\n";
  }
  base::OutputFile output(file);
  output.write(text + "\n]}\n");
  output.commit();
}

}  // namespace tetraglass::preint
