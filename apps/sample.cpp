#include <memory>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/options.h"
#include "apps/subcommands.h"
#include "base/output_file.h"
#include "mesh/samples.h"
#include "mesh/write.h"

namespace tetraglass::apps {

void add_sample(CLI::App& program) {
  struct Arguments {
    std::string name;
    std::string output;
    std::optional<std::string> cells;
  };
  CLI::App* app = program.add_subcommand("sample", "Make a test mesh with a known field");
  auto arguments = std::make_shared<Arguments>();
  app->footer("usage: tetraglass sample NAME -o OUT.vtu [--cells N]");
  app->add_option("NAME", arguments->name,
                  fmt::format("One of: {}", fmt::join(mesh::sample_names(), ", ")))
      ->required();
  app->add_option("-o,--output", arguments->output, "The .vtu file to write")
      ->type_name("FILE")
      ->required();
  app->add_option("--cells", arguments->cells,
                  "About how many cells, such as 1e6 (default: the size of the published data "
                  "sets)");
  app->callback([arguments] {
    const std::size_t cells =
        !arguments->cells ? 0
                          : static_cast<std::size_t>(parse_count(*arguments->cells, "--cells", 1));
    { const base::OutputFile probe(arguments->output); }
    const mesh::TetMesh mesh = mesh::make_sample(arguments->name, cells);
    mesh::write_vtu(mesh, arguments->output);
    fmt::print(stderr, "{}: {} tetrahedra, {} points\n", arguments->output, mesh.cells.size(),
               mesh.points.size());
    fmt::print("{}\n", arguments->output);
  });
}

}  // namespace tetraglass::apps
