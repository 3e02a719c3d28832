#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "apps/options.h"
#include "apps/render_arguments.h"
#include "apps/subcommands.h"
#include "base/errors.h"
#ifdef TETRAGLASS_WITH_WINDOW
#include "apps/view/controls.h"
#include "apps/view/session.h"
#include "apps/view/window.h"
#endif

namespace tetraglass::apps {
namespace {

void add_options(CLI::App& app, RenderArguments& arguments) {
  app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::Throw);
  app.add_option(
         "INPUT", arguments.input,
         "A mesh with fields, a surface, a point cloud, a grid, or a session that the window "
         "saved (.session.json)")
      ->type_name("FILE")
      ->required();
  add_scene_options(&app, arguments);
  add_figure_options(&app, arguments.figure);
  add_camera_options(&app, arguments);
  add_method_options(&app, arguments);
}

void explore(const CLI::App& app, const RenderArguments& arguments) {
#ifdef TETRAGLASS_WITH_WINDOW
  if (view::is_session_name(arguments.input)) {
    CLI::App saved;
    RenderArguments of_session;
    add_options(saved, of_session);
    saved.add_option("-o", of_session.outputs);
    std::vector<std::string> words = view::read_session_words(arguments.input);
    std::reverse(words.begin(), words.end());  // as CLI11 wants them
    try {
      saved.parse(words);
    } catch (const CLI::ParseError& error) {
      throw base::ReadError(arguments.input, error.what());
    }
    if (view::is_session_name(of_session.input)) {
      throw base::ReadError(arguments.input, "is a session of a session");
    }
    of_session.outputs.clear();
    return explore(saved, of_session);
  }
#endif
  if (!arguments.region.empty()) {
    throw base::UsageError("view shows whole pictures: --region is for render");
  }
  if (draws_all_times(arguments)) {
    throw base::UsageError("view shows one time step after the other: --time all is for render");
  }
  (void)make_request(arguments);  // wrong words are told before a window opens
  std::error_code ignored;
  if (!std::filesystem::exists(arguments.input, ignored)) {
    throw base::ReadError(arguments.input, "there is no such file");
  }
#ifdef TETRAGLASS_WITH_WINDOW
  view::show_window(arguments, view::typed_options(app));
#else
  (void)app;
  throw base::UnavailableError(
      "this build has no window (-DTETRAGLASS_WITH_WINDOW=ON); use 'tetraglass render'");
#endif
}

std::string footer() {
  std::string text =
      "usage: tetraglass view INPUT [options as of render]\n\n"
      "Opens a window to explore; what is seen is saved, and copied as a command line of render.\n";
#ifdef TETRAGLASS_WITH_WINDOW
  text += "Mouse and keys:\n" + view::controls_text();
#endif
  return text;
}

}  // namespace

void add_view(CLI::App& program) {
  CLI::App* app = program.add_subcommand("view", "Explore in a window");
  auto arguments = std::make_shared<RenderArguments>();
  app->footer(footer());
  add_options(*app, *arguments);
  app->callback([app, arguments] { explore(*app, *arguments); });
}

}  // namespace tetraglass::apps
