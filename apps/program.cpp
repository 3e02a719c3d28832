#include "apps/program.h"

#include <new>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/described_commands.h"
#include "apps/man_page.h"
#include "apps/shell_completion.h"
#include "apps/subcommands.h"
#include "base/errors.h"
#include "base/suggest.h"

namespace tetraglass::apps {
namespace {

constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

/// What is linked, and its licence: first what the binary as a whole falls under.
std::string version_text() {
  std::string text = "tetraglass " TETRAGLASS_VERSION "\nSources: BSD-3-Clause.";
  std::string parts;
#ifdef TETRAGLASS_WITH_TETGEN
  parts += "\n  TetGen   AGPL-3.0-or-later (fills closed surfaces)";
#endif
#ifdef TETRAGLASS_WITH_CGAL
  parts += "\n  CGAL     GPL-3.0-or-later (tetrahedra of points, repair; its kernel alone: LGPL)";
#endif
#ifdef TETRAGLASS_WITH_GMSH
  parts += "\n  Gmsh     GPL-2.0-or-later (reads its formats)";
#endif
  if (parts.empty()) {
    text += " This binary holds no GPL or AGPL library.";
  } else {
    text += " This binary also holds, and falls as a whole under the licences of:" + parts +
            "\nEach can be left out: cmake -DTETRAGLASS_WITH_{TETGEN,CGAL,GMSH}=OFF";
  }
  text +=
      "\nUnder licences that ask for less it holds:"
      "\n  LGPL-3.0-or-later    MED, GMP, MPFR"
#ifndef TETRAGLASS_WITH_CGAL
      ", CGAL's kernel"
#endif
      "\n  LGPL-2.1 or MPL-1.1  Cairo"
      "\n  MPL-2.0              Eigen"
      "\n  Apache-2.0           oneTBB, Highway"
      "\n  BSD-3-Clause         VTK with Exodus, NetCDF, OpenEXR, CLI11"
#ifdef TETRAGLASS_WITH_CGAL
      ", OpenMesh"
#endif
      "\n  MIT                  fmt, JSON for Modern C++, expat, libcerf, Fontconfig, Mesa's "
      "OSMesa, EGL"
#ifdef TETRAGLASS_WITH_WINDOW
      ", Dear ImGui, stb, libX11"
      "\n  zlib                 GLFW, zlib"
#else
      "\n  zlib                 zlib"
#endif
      "\n  their own            libpng (PNG Reference Library), bzip2 (BSD-like), Boost (BSL-1.0)";
  return text;
}

std::vector<std::string> subcommand_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* sub : program.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(sub->get_name());
  }
  return names;
}

/// The options of a subcommand, with their dashes.
std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// The innermost subcommand that the user named, else the program itself.
const CLI::App& used_app(const CLI::App& program) {
  const auto used = program.get_subcommands();
  return used.empty() ? program : *used.front();
}

int report_usage(const CLI::App& program, const std::string& what) {
  const CLI::App& app = used_app(program);
  const std::string name = &app == &program ? "tetraglass" : "tetraglass " + app.get_name();
  const std::string footer = app.get_footer();
  // What stands below the usage is for --help.
  fmt::print(stderr, "tetraglass: error: {}\n{}\nall options: {} --help\n", what,
             footer.substr(0, footer.find("\n\n")), name);
  return kWrongUsage;
}

/// Says which word is wrong and which ones may have been meant.
std::string explain(const CLI::App& program, const CLI::ParseError& error, int argc, char** argv) {
  const CLI::App& app = used_app(program);
  if (&app == &program && argc > 1 && argv[1][0] != '-') {
    return fmt::format("there is no subcommand '{}'{}", argv[1],
                       base::suggestion(argv[1], subcommand_names(program)));
  }
  if (&app == &program && argc == 1) {
    return fmt::format("a subcommand is required: {}", fmt::join(subcommand_names(program), ", "));
  }
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
    for (const std::string& extra : app.remaining(true)) {
      if (extra.rfind("--", 0) == 0) {
        const std::string name = extra.substr(0, extra.find('='));
        return fmt::format("{} has no option {}{}", app.get_name(), name,
                           base::suggestion(name, option_names(app)));
      }
    }
    const bool has_output = app.get_option_no_throw("-o") != nullptr;
    return fmt::format("'{}' is one word too many{}", app.remaining(true).front(),
                       has_output ? "; what is to be written stands behind -o" : "");
  }
  return error.what();
}

/// What a package installs beside the program, made of its help; printed instead of any work.
void add_documents(CLI::App& program) {
  program
      .add_flag_callback("--man-page",
                         [&program] {
                           throw CLI::CallForVersion(
                               man_page(describe(program), TETRAGLASS_VERSION), 0);
                         })
      ->group("");
  program
      .add_option_function<std::string>("--completion",
                                        [&program](const std::string& shell) {
                                          throw CLI::CallForVersion(
                                              shell_completion(describe(program), shell), 0);
                                        })
      ->group("");
}

int report_failure(const std::string& what) {
  fmt::print(stderr, "tetraglass: error: {}\n", what);
  return kFailed;
}

}  // namespace

int run(int argc, char** argv) {
  CLI::App program("Looks into tetrahedral meshes: exact cell projection, with its error stated.",
                   "tetraglass");
  program.set_version_flag("--version", version_text(),
                           "Version, and the licences of what is built in");
  program.require_subcommand(1);
  program.footer("usage: tetraglass SUBCOMMAND ...   (tetraglass SUBCOMMAND --help tells more)");
  add_render(program);
  add_import(program);
  add_info(program);
  add_sample(program);
  add_compare(program);
  add_order(program);
  add_table(program);
  add_accuracy(program);
  add_view(program);
  add_documents(program);
  try {
    program.parse(argc, argv);
    return 0;
  } catch (const CLI::Success& success) {  // --help, --version
    return program.exit(success);
  } catch (const CLI::ParseError& error) {
    return report_usage(program, explain(program, error, argc, argv));
  } catch (const base::UsageError& error) {
    return report_usage(program, error.what());
  } catch (const std::bad_alloc&) {
    return report_failure("not enough memory for this; try a smaller picture, mesh or table");
  } catch (const std::exception& error) {
    return report_failure(error.what());
  }
}

}  // namespace tetraglass::apps
