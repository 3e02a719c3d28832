#include "apps/import_options.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace tetraglass::apps {

void add_import_options(CLI::App& app, mesh::ImportOptions& options) {
  app.add_option("--time", options.time, "Time step: a time, 'last' (default) or 'index:N'");
  app.add_flag("--refine-quadratic", options.refine_quadratic,
               "Cut quadratic cells along the points on their edges, instead of drawing their "
               "corners");
  app.add_option("--raw", options.raw,
                 "Layout of a file of bare values: WIDTHxHEIGHTxDEPTH:TYPE[:little|big]");
  app.add_flag("--repair", options.repair,
               "Mend a surface before it is filled: doubled and flat triangles, directions, seams, "
               "small holes; what was done is told");
  app.add_option("--largest-hole", options.largest_hole,
                 fmt::format("The largest hole that --repair closes, in parts of the surface's "
                             "diagonal (default {:g})",
                             mesh::kUsualLargestHole))
      ->check(CLI::Range(0.0, 1.0))
      ->needs("--repair");
}

}  // namespace tetraglass::apps
