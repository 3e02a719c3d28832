#pragma once

#include "mesh/import.h"

namespace CLI {
class App;
}

namespace tetraglass::apps {

/// The options of every subcommand that reads a mesh: what is taken from the file, and how
/// tetrahedra are made of it. `options` must outlive the parsing.
void add_import_options(CLI::App& app, mesh::ImportOptions& options);

}  // namespace tetraglass::apps
