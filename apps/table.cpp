#include "preint/table.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/built_table.h"
#include "apps/options.h"
#include "apps/subcommands.h"
#include "apps/transfer_function_input.h"
#include "base/output_file.h"
#include "base/stopwatch.h"
#include "project/npy.h"

namespace tetraglass::apps {
namespace {

using preint::TableMethod;
using Kind = TableKind;

struct TableArguments {
  std::string transfer_function = "viridis";
  std::string range;
  std::string length = "1";
  std::string kind;
  std::string size;
  std::string max_error;
  std::string method;
  std::string length_axis = "linear";
  std::string mip_of = "field";
  std::vector<std::string> isovalues;
  std::vector<std::string> iso_colors;
  std::string iso_opacity = "1";
  std::string thickening = "0";
  std::string output;
  bool json = false;
};

const std::vector<std::pair<std::string, Kind>>& kinds() {
  static const std::vector<std::pair<std::string, Kind>> kKinds = {
      {"emission", Kind::emission}, {"mip", Kind::mip},       {"iso", Kind::iso},
      {"full2d", Kind::full2d},     {"full3d", Kind::full3d}, {"weighted", Kind::weighted},
      {"material", Kind::material}, {"psi", Kind::psi}};
  return kKinds;
}

const std::vector<std::pair<std::string, TableMethod>>& methods() {
  static const std::vector<std::pair<std::string, TableMethod>> kMethods = {
      {"incremental", TableMethod::incremental},
      {"brute-force", TableMethod::brute_force},
      {"exact", TableMethod::exact}};
  return kMethods;
}

std::string name_of(TableMethod method) {
  return std::find_if(methods().begin(), methods().end(),
                      [&](const auto& choice) { return choice.second == method; })
      ->first;
}

/// Psi does not know a transfer function: its entries have nothing to share.
TableMethod choose_method(const TableArguments& arguments, Kind kind) {
  const bool is_psi = kind == Kind::psi;
  if (arguments.method.empty()) return is_psi ? TableMethod::exact : TableMethod::incremental;
  const TableMethod method = parse_choice(arguments.method, "--method", methods());
  if (is_psi && method == TableMethod::incremental) {
    throw base::UsageError(
        "a table of kind psi has no incremental form: every entry is integrated on its own "
        "(--method exact or brute-force, which are the same here)");
  }
  return method;
}

constexpr const char* kDefaultSize = "256";

void read_size(const TableArguments& arguments, TableTask& task) {
  if (!arguments.max_error.empty()) {
    if (task.kind != Kind::full2d && task.kind != Kind::full3d) {
      throw base::UsageError("--max-error chooses the size of --kind full2d and full3d");
    }
    if (!arguments.size.empty()) {
      throw base::UsageError("--max-error chooses the size: leave out --size");
    }
    return;
  }
  const std::string size = arguments.size.empty() ? kDefaultSize : arguments.size;
  const std::size_t cross = size.find('x');
  const bool may_have_lengths =
      task.kind == Kind::full3d || task.kind == Kind::weighted || task.kind == Kind::material;
  task.n = parse_count(size.substr(0, cross), "--size", 2);
  if (cross != std::string::npos) {
    if (!may_have_lengths) {
      throw base::UsageError(
          "--size needs one number here; NxM is for --kind full3d, weighted and material");
    }
    task.m = parse_count(size.substr(cross + 1), "--size", 2);
  } else if (task.kind == Kind::full3d) {
    throw base::UsageError("--kind full3d needs --size NxM, values x lengths");
  }
}

std::vector<preint::Isosurface> read_isosurfaces(const TableArguments& arguments,
                                                 const TableTask& task) {
  std::vector<preint::Isosurface> surfaces;
  for (const std::string& text : arguments.isovalues) {
    surfaces.push_back({parse_number(text, "--isovalue")});
  }
  if (surfaces.empty()) surfaces.push_back({0.5 * task.low + 0.5 * task.high});
  if (arguments.iso_colors.size() > surfaces.size()) {
    throw base::UsageError("there are more --iso-color than --isovalue");
  }
  const double opacity = parse_number(arguments.iso_opacity, "--iso-opacity");
  if (!(opacity >= 0 && opacity <= 1)) {
    throw base::UsageError("--iso-opacity must lie between 0 and 1");
  }
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    surfaces[i].opacity = opacity;
    surfaces[i].color = i < arguments.iso_colors.size()
                            ? parse_vector(arguments.iso_colors[i], "--iso-color").array()
                            : task.tf.at(surfaces[i].value).color;
  }
  return surfaces;
}

void read_lengths(const TableArguments& arguments, TableTask& task) {
  if (arguments.length.find(':') == std::string::npos) {
    task.length = parse_number(arguments.length, "--length");
    return;
  }
  if (task.kind != Kind::full3d || arguments.max_error.empty()) {
    throw base::UsageError("--length LO:HI is for --kind full3d with --max-error");
  }
  std::tie(task.shortest, task.length) = parse_range(arguments.length, "--length");
}

TableTask read_task(const TableArguments& arguments) {
  TableTask task;
  task.kind = parse_choice(arguments.kind, "--kind", kinds());
  task.method = choose_method(arguments, task.kind);
  read_size(arguments, task);
  read_lengths(arguments, task);
  task.axis = parse_choice<preint::LengthAxis>(
      arguments.length_axis, "--length-axis",
      {{"linear", preint::LengthAxis::linear}, {"logarithmic", preint::LengthAxis::logarithmic}});
  task.mip_of = parse_choice<preint::MipOf>(
      arguments.mip_of, "--mip-of",
      {{"field", preint::MipOf::field}, {"transfer", preint::MipOf::transfer}});
  std::optional<std::pair<double, double>> range;
  if (!arguments.range.empty()) range = parse_range(arguments.range, "--range");
  const auto [low, high] = range.value_or(std::make_pair(0.0, 1.0));
  task.tf = read_named_transfer_function(arguments.transfer_function, low, high, 1);
  task.low = range ? low : task.tf.points().front().value;
  task.high = range ? high : task.tf.points().back().value;
  task.thickening = parse_number(arguments.thickening, "--thickening");
  task.surfaces = read_isosurfaces(arguments, task);
  return task;
}

void table(const TableArguments& arguments) {
  TableTask task = read_task(arguments);
  std::optional<double> lookup_error;
  if (!arguments.max_error.empty()) {
    const double most = parse_number(arguments.max_error, "--max-error");
    if (!(most > 0)) throw base::UsageError("--max-error must be positive");
    lookup_error = choose_size(task, most);
  }
  const std::string size =
      task.m > 0 ? fmt::format("{}x{}", task.n, task.m) : std::to_string(task.n);
  if (!arguments.output.empty()) const base::OutputFile probe(arguments.output);
  const base::Stopwatch clock;
  const BuiltTable result = build(task);
  const double ms = clock.milliseconds();
  const auto entries = static_cast<double>(result.entries());
  const double error = largest_error(task, result);
  if (!lookup_error) lookup_error = largest_lookup_error(task, result);
  if (!arguments.output.empty()) {
    base::OutputFile output(arguments.output);
    std::vector<float> values;
    for (const preint::Entries& part : result.parts) {
      values.insert(values.end(), part.begin(), part.end());
    }
    output.write(project::to_npy(result.shape, values));
    output.commit();
  }
  const std::string method = name_of(task.method);
  if (arguments.json) {
    const nlohmann::ordered_json json = {{"kind", arguments.kind},
                                         {"method", method},
                                         {"size", size},
                                         {"ms", ms},
                                         {"entries_per_s", entries / ms * 1000},
                                         {"max_error", error},
                                         {"lookup_error", *lookup_error}};
    fmt::print("{}\n", json.dump());
  } else {
    fmt::print(
        "{} table of {}, {}: {:.3g} ms, {:.3g} entries/s, largest error {:.3g}, of lookups "
        "{:.3g}\n",
        arguments.kind, size, method, ms, entries / ms * 1000, error, *lookup_error);
    if (!arguments.output.empty()) fmt::print("{}\n", arguments.output);
  }
}

}  // namespace

void add_table(CLI::App& program) {
  CLI::App* app =
      program.add_subcommand("table", "Build a pre-integration table, time it, check it");
  auto a = std::make_shared<TableArguments>();
  app->footer(
      "usage: tetraglass table --kind K --size N[xM] [--tf T] [--method M] [-o T.npy] [--json]");
  app->add_option("--kind", a->kind,
                  "emission | mip | iso | full2d | full3d | weighted | material | psi")
      ->required();
  app->add_option("--size", a->size,
                  "N values, or NxM values x lengths (full3d, weighted, material). Default: 256");
  app->add_option("--max-error", a->max_error,
                  "Instead of --size: the smallest table whose lookups err by no more (full2d, "
                  "full3d)");
  app->add_option("--tf", a->transfer_function, transfer_function_help())
      ->type_name("NAME|FILE")
      ->capture_default_str();
  app->add_option("--range", a->range,
                  "LO:HI, the values of the table. Default: those of the transfer function");
  app->add_option(
         "--length", a->length,
         "Length of the segments; the largest one (NxM); LO:HI with --max-error, where only these "
         "lengths count. The unit is the preset's diagonal")
      ->capture_default_str();
  app->add_option("--length-axis", a->length_axis, "linear | logarithmic: fine for short segments")
      ->capture_default_str();
  app->add_option("--method", a->method,
                  "incremental (default) | brute-force (every entry over all cells between its "
                  "ends) | exact (every entry split at the control points; psi: default)");
  app->add_option("--mip-of", a->mip_of, "For --kind mip: field | transfer")->capture_default_str();
  app->add_option("--isovalue", a->isovalues, "For --kind iso; repeatable. Default: the middle")
      ->take_all()
      ->expected(1);
  app->add_option("--iso-color", a->iso_colors,
                  "R,G,B (linear) of each --isovalue; repeatable. Default: the transfer function's")
      ->take_all()
      ->expected(1);
  app->add_option("--iso-opacity", a->iso_opacity, "0 to 1")->capture_default_str();
  app->add_option("--thickening", a->thickening,
                  "For --kind iso: how far from the isovalue still counts; 0: exactly one of two "
                  "adjacent segments has the crossing")
      ->capture_default_str();
  app->add_option(
         "-o,--output", a->output,
         ".npy of float32, [back][front][RGBA]; NxM: a length axis first; weighted: front- "
         "and back-weighted first of all; psi: [back][front]")
      ->type_name("FILE");
  app->add_flag("--json", a->json, "Print JSON");
  app->callback([a] { table(*a); });
}

}  // namespace tetraglass::apps
