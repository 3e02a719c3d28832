#pragma once

#include <string>

#include "project/slices_plan.h"

namespace CLI {
class App;
}

namespace tetraglass::apps {

/// The options of --projector slices as typed; empty where not given.
struct SlicesArguments {
  std::string slices;
  std::string distance;
  std::string stack;
  std::string filter;
  std::string texel_bits;
  std::string classify;
  std::string skip_empty;
  std::string compress;
  std::string brick;
};

/// Adds them to a subcommand; `arguments` outlive it.
void add_slices_options(CLI::App& app, SlicesArguments& arguments);

/// What they force. Throws UsageError.
[[nodiscard]] project::SlicesRequest make_slices_request(const SlicesArguments& arguments);

}  // namespace tetraglass::apps
