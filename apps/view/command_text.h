#pragma once

#include <string>
#include <vector>

#include "apps/render_arguments.h"

namespace CLI {
class App;
}

namespace tetraglass::apps::view {

/// An option as typed: "--clip" and its values, one for each time that it was given; none for a
/// flag.
struct TypedOption {
  std::string name;
  std::vector<std::string> values;
  bool flag = false;
};

/// The options that were given to a subcommand.
[[nodiscard]] std::vector<TypedOption> typed_options(const CLI::App& app);

/// The words after "tetraglass" that make the picture `output` of these arguments: what the window
/// can change is taken from `arguments`, all other options as they were typed.
[[nodiscard]] std::vector<std::string> render_words(const RenderArguments& arguments,
                                                    const std::vector<TypedOption>& typed,
                                                    const std::string& output);

/// Words as a shell reads them, quoted where they must be.
[[nodiscard]] std::string shell_line(const std::vector<std::string>& words);

}  // namespace tetraglass::apps::view
