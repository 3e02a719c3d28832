#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/subcommands.h"
#include "base/output_file.h"
#include "mesh/samples.h"
#include "mesh/write.h"

namespace tetraglass::apps {

void add_sample(CLI::App& program) {
  struct Arguments {
    std::string name;
    std::string output;
    std::size_t cells = 0;
  };
  CLI::App* app = program.add_subcommand("sample", "Make a test mesh with a known field");
  auto arguments = std::make_shared<Arguments>();
  app->footer("usage: tetraglass sample NAME -o OUT.vtu [--cells N]");
  app->add_option("NAME", arguments->name,
                  fmt::format("One of: {}", fmt::join(mesh::sample_names(), ", ")))
      ->required();
  app->add_option("-o,--output", arguments->output, "The .vtu file to write")->required();
  app->add_option("--cells", arguments->cells,
                  "About how many cells (default: the size of the published data sets)")
      ->check(CLI::Range(std::size_t{1}, std::size_t{200'000'000}));
  app->callback([arguments] {
    { const base::OutputFile probe(arguments->output); }
    const mesh::TetMesh mesh = mesh::make_sample(arguments->name, arguments->cells);
    mesh::write_vtu(mesh, arguments->output);
    fmt::print(stderr, "{}: {} tetrahedra, {} points\n", arguments->output, mesh.cells.size(),
               mesh.points.size());
    fmt::print("{}\n", arguments->output);
  });
}

}  // namespace tetraglass::apps
