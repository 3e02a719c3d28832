#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "apps/accuracy_report.h"
#include "apps/import_options.h"
#include "apps/mesh_input.h"
#include "apps/options.h"
#include "apps/render_arguments.h"
#include "apps/subcommands.h"
#include "base/errors.h"
#include "base/output_file.h"
#include "base/progress.h"
#include "mesh/rectilinear_grid.h"

namespace tetraglass::apps {
namespace {

// The quick form takes some half a minute for Weiler's data sets on two cores without a GPU.
constexpr const char* kQuickSize = "240x180";
constexpr project::StudyLength kQuick = {3, 45};
constexpr const char* kFullSize = "512x384";
constexpr project::StudyLength kFull = {7, 3600};

struct AccuracyArguments {
  RenderArguments render;
  std::string output;
  bool full = false;
};

std::string csv_beside(const std::string& html) {
  const std::size_t dot = html.rfind('.');
  const std::size_t slash = html.rfind('/');
  const bool has_extension =
      dot != std::string::npos && (slash == std::string::npos || dot > slash);
  return (has_extension ? html.substr(0, dot) : html) + ".csv";
}

void write(const std::string& file, const std::string& text) {
  base::OutputFile output(file);
  output.write(text);
  output.commit();
}

/// Slices can draw the scene beside its cells, where these are those of a grid.
void add_grid(project::Scene& scene) {
  const bool whole = scene.field.location == mesh::Location::point && scene.drawable.nan == 0;
  if (!whole) return;
  try {
    scene.grid = mesh::rectilinear_grid(*scene.mesh);
  } catch (const base::InputError&) {  // most meshes are none
  }
}

void study(AccuracyArguments arguments) {
  RenderArguments& wanted = arguments.render;
  if (wanted.size.empty()) wanted.size = arguments.full ? kFullSize : kQuickSize;
  const std::string csv = csv_beside(arguments.output);
  if (csv == arguments.output) throw base::UsageError("-o names the page: OUT.html");
  for (const std::string& file : {arguments.output, csv}) const base::OutputFile probe(file);

  const mesh::Import imported = import_and_tell(wanted.input, wanted.import);
  project::Scene scene = make_scene(wanted, imported.mesh);
  add_grid(scene);
  const std::vector<project::StudyCase> cases = project::study_cases(scene, arguments.full);
  const project::StudyLength length = arguments.full ? kFull : kQuick;
  base::Progress progress("accuracy", cases.size() * static_cast<std::size_t>(length.rounds));
  const project::Study result =
      project::study_accuracy(scene, cases, length, [&] { progress.advance(); });
  const std::string description = fmt::format(
      "{} tetrahedra, field {}, mode {}, {} x {} pixels, {} view; medians of {} rounds; the "
      "reference took {:.0f} ms.",
      scene.mesh->cells.size(), scene.field.name, to_string(scene.mode), scene.width, scene.height,
      scene.camera.parallel ? "parallel" : "perspective", result.rounds, result.reference_ms);
  write(arguments.output, accuracy_html(result, "What accuracy costs: " + wanted.input, description,
                                        make_background(wanted, scene.mode)));
  write(csv, accuracy_csv(result));
  fmt::print("{}\n{}\n", arguments.output, csv);
}

}  // namespace

void add_accuracy(CLI::App& program) {
  CLI::App* app = program.add_subcommand(
      "accuracy", "What accuracy costs: error against time for every knob, as a page");
  auto arguments = std::make_shared<AccuracyArguments>();
  arguments->render.size.clear();
  app->footer("usage: tetraglass accuracy INPUT -o REPORT.html [--full] [options of the scene]");
  app->option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::Throw);
  app->add_option("INPUT", arguments->render.input,
                  "A mesh with fields, a surface, a point cloud or a grid")
      ->type_name("FILE")
      ->required();
  app->add_option("-o,--output", arguments->output,
                  "The page, self-contained; its numbers go to a .csv beside it")
      ->type_name("FILE")
      ->required();
  const std::string quick_form =
      fmt::format("{} pixels, up to {} rounds, what {} s suffice for (default)", kQuickSize,
                  kQuick.rounds, kQuick.seconds);
  auto* quick = app->add_flag("--quick", quick_form);
  app->add_flag("--full", arguments->full,
                fmt::format("{} pixels, {} rounds, more tables", kFullSize, kFull.rounds))
      ->excludes(quick);
  add_scene_options(app, arguments->render);
  add_camera_options(app, arguments->render);
  app->callback([arguments] { study(*arguments); });
}

}  // namespace tetraglass::apps
