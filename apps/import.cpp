#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "apps/import_options.h"
#include "apps/mesh_input.h"
#include "apps/options.h"
#include "apps/subcommands.h"
#include "base/errors.h"
#include "base/output_file.h"
#include "mesh/expression.h"
#include "mesh/gradients.h"
#include "mesh/write.h"

namespace tetraglass::apps {
namespace {

struct ImportArguments {
  std::string input;
  std::string output;
  std::vector<std::string> new_fields;
  std::vector<std::string> gradients_of;
  std::string gradient_by = "volume";
  mesh::ImportOptions options;
};

/// Adds the fields that are asked for as NAME=EXPRESSION.
void add_fields(mesh::TetMesh& mesh, const std::vector<std::string>& definitions) {
  for (const std::string& definition : definitions) {
    const std::size_t equals = definition.find('=');
    if (equals == 0 || equals == std::string::npos) {
      throw base::UsageError("--add-field needs NAME=EXPRESSION, not '" + definition + "'");
    }
    const std::string name = CLI::detail::trim_copy(definition.substr(0, equals));
    mesh.fields.push_back(mesh::evaluate_expression(mesh, name, definition.substr(equals + 1)));
  }
}

using Gradients = std::vector<Eigen::Vector3d> (*)(const mesh::TetMesh&, const mesh::ScalarField&);

/// Adds the gradients of fields, each as 'gradient of NAME'.
void add_gradients(const std::string& file, mesh::TetMesh& mesh,
                   const std::vector<std::string>& names, Gradients gradients) {
  const bool of_cells = gradients == mesh::cell_gradients;
  for (const std::string& name : names) {
    const mesh::ScalarField field = select_scalar_of(file, mesh, name);
    if (field.location == mesh::Location::cell) {
      throw base::InputError("the field '" + name +
                             "' is constant in each cell and has no gradient");
    }
    mesh::Field out{
        "gradient of " + name, of_cells ? mesh::Location::cell : mesh::Location::point, 3, {}};
    for (const Eigen::Vector3d& g : gradients(mesh, field)) {
      out.values.insert(out.values.end(), g.data(), g.data() + 3);
    }
    mesh.fields.push_back(std::move(out));
  }
}

void import(const ImportArguments& arguments) {
  const auto gradients =
      parse_choice<Gradients>(arguments.gradient_by, "--gradient-by",
                              {{"cell", mesh::cell_gradients},
                               {"volume", mesh::vertex_gradients},
                               {"least-squares", mesh::least_squares_gradients}});
  { const base::OutputFile probe(arguments.output); }  // tell before the work, not after it
  mesh::Import imported = import_and_tell(arguments.input, arguments.options);
  add_fields(imported.mesh, arguments.new_fields);
  add_gradients(arguments.input, imported.mesh, arguments.gradients_of, gradients);
  mesh::write_vtu(imported.mesh, arguments.output);
  fmt::print(stderr, "{}: {} tetrahedra, {} points, {} fields\n", arguments.output,
             imported.mesh.cells.size(), imported.mesh.points.size(), imported.mesh.fields.size());
  fmt::print("{}\n", arguments.output);
}

}  // namespace

void add_import(CLI::App& program) {
  CLI::App* app =
      program.add_subcommand("import", "Read anything, make tetrahedra of it, write them as .vtu");
  auto arguments = std::make_shared<ImportArguments>();
  app->footer("usage: tetraglass import INPUT -o OUT.vtu [options]");
  app->add_option("INPUT", arguments->input, "A mesh, surface, point cloud, grid or volume")
      ->type_name("FILE")
      ->required();
  app->add_option("-o,--output", arguments->output, "The .vtu file to write")
      ->type_name("FILE")
      ->required();
  add_import_options(*app, arguments->options);
  app->add_option("--add-field", arguments->new_fields,
                  "NAME=EXPRESSION in x, y, z, radius and point fields, e.g. 'hot=max(0, T - "
                  "400)'; repeatable")
      ->take_all()
      ->expected(1);
  app->add_option("--add-gradient", arguments->gradients_of,
                  "Add the gradient of this point field, per unit of length; repeatable")
      ->take_all()
      ->expected(1);
  app->add_option("--gradient-by", arguments->gradient_by,
                  "cell (constant in each) | volume (at points: the mean of the cells around, by "
                  "volume) | least-squares (at points: fitted to their neighbours)")
      ->capture_default_str();
  app->callback([arguments] { import(*arguments); });
}

}  // namespace tetraglass::apps
