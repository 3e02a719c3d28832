#include "mesh/expression.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>
#include <vtkFunctionParser.h>
#include <vtkNew.h>

#include "base/errors.h"
#include "mesh/vtk_messages.h"

namespace tetraglass::mesh {
namespace {

// What stands for an undefined value inside the parser, told apart from any value that a field has
// by its exact bits.
constexpr double kUndefined = -1.2345678901234567e+301;

bool is_identifier(const std::string& name) {
  const auto allowed = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  return !name.empty() && std::isdigit(static_cast<unsigned char>(name[0])) == 0 &&
         std::all_of(name.begin(), name.end(), allowed);
}

/// The fields that an expression can name.
std::vector<const Field*> usable_fields(const TetMesh& mesh) {
  std::vector<const Field*> result;
  for (const Field& field : mesh.fields) {
    const bool shadowed =
        field.name == "x" || field.name == "y" || field.name == "z" || field.name == "radius";
    const bool small = field.components == 1 || field.components == 3;
    if (field.location == Location::point && small && !shadowed && is_identifier(field.name)) {
      result.push_back(&field);
    }
  }
  return result;
}

void set_variables(vtkFunctionParser& parser, const std::vector<const Field*>& fields,
                   std::size_t point) {
  for (const Field* field : fields) {
    if (field->components == 1) {
      parser.SetScalarVariableValue(field->name, field->values[point]);
    } else {
      parser.SetVectorVariableValue(field->name, field->values.data() + 3 * point);
    }
  }
}

void set_coordinates(vtkFunctionParser& parser, const Eigen::Vector3d& point,
                     const Eigen::Vector3d& center) {
  parser.SetScalarVariableValue("x", point.x());
  parser.SetScalarVariableValue("y", point.y());
  parser.SetScalarVariableValue("z", point.z());
  parser.SetScalarVariableValue("radius", (point - center).norm());
}

double defined(double value) {
  return value == kUndefined ? std::numeric_limits<double>::quiet_NaN() : value;
}

}  // namespace

Field evaluate_expression(const TetMesh& mesh, const std::string& name,
                          const std::string& expression) {
  const VtkMessages silence;
  const Box box = bounds(mesh);
  const Eigen::Vector3d center = box.isEmpty() ? Eigen::Vector3d::Zero().eval() : box.center();
  const std::vector<const Field*> fields = usable_fields(mesh);
  vtkNew<vtkFunctionParser> parser;
  parser->ReplaceInvalidValuesOn();
  parser->SetReplacementValue(kUndefined);
  set_coordinates(*parser, center, center);
  if (!mesh.points.empty()) set_variables(*parser, fields, 0);
  parser->SetFunction(expression.c_str());
  int position = -1;
  char* error = nullptr;
  parser->CheckExpression(position, &error);
  if (error != nullptr) {
    throw base::UsageError(fmt::format(
        "'{}' is no expression: {} at character {}; known are x, y, z, radius and the point "
        "fields",
        expression, error, position + 1));
  }
  Field result{name, Location::point, parser->IsVectorResult() != 0 ? 3 : 1, {}};
  result.values.reserve(mesh.points.size() * static_cast<std::size_t>(result.components));
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    set_coordinates(*parser, mesh.points[i], center);
    set_variables(*parser, fields, i);
    if (result.components == 1) {
      result.values.push_back(defined(parser->GetScalarResult()));
    } else {
      const double* vector = parser->GetVectorResult();
      std::transform(vector, vector + 3, std::back_inserter(result.values), defined);
    }
  }
  return result;
}

}  // namespace tetraglass::mesh
