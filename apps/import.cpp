#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "apps/mesh_input.h"
#include "apps/subcommands.h"
#include "base/output_file.h"
#include "mesh/write.h"

namespace tetraglass::apps {
namespace {

struct ImportArguments {
  std::string input;
  std::string output;
  mesh::ImportOptions options;
};

void import(const ImportArguments& arguments) {
  { const base::OutputFile probe(arguments.output); }  // tell before the work, not after it
  const mesh::Import imported = import_and_tell(arguments.input, arguments.options);
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
  app->add_option("INPUT", arguments->input, "A mesh, surface, point cloud or grid")->required();
  app->add_option("-o,--output", arguments->output, "The .vtu file to write")->required();
  app->add_option("--time", arguments->options.time,
                  "Time step: a time, 'last' (default) or 'index:N'");
  app->callback([arguments] { import(*arguments); });
}

}  // namespace tetraglass::apps
