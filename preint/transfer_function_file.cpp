#include <utility>

#include "base/errors.h"
#include "base/json_file.h"
#include "preint/transfer_function.h"

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

}  // namespace tetraglass::preint
