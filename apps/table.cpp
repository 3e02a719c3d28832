#include "preint/table.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/options.h"
#include "apps/subcommands.h"
#include "apps/transfer_function_input.h"
#include "base/output_file.h"
#include "base/stopwatch.h"
#include "preint/psi_table.h"
#include "preint/ramped_table.h"
#include "preint/segment_integral.h"
#include "project/npy.h"

namespace tetraglass::apps {
namespace {

using preint::TransferFunction;

enum class Kind { emission, mip, iso, full2d, full3d, weighted, material, psi };
enum class Method { incremental, brute_force, exact };

// Entries that are checked against the exact integral: all of a table of 256 x 256, evenly spread
// ones of a larger table.
constexpr std::size_t kCheckedEntries = 65536;

struct TableArguments {
  std::string transfer_function = "viridis";
  std::string range;
  std::string length = "1";
  std::string kind;
  std::string size = "256";
  std::string method;
  std::vector<std::string> isovalues;
  std::string output;
  bool json = false;
};

/// What is to be built, read from the arguments.
struct Task {
  Kind kind = Kind::emission;
  Method method = Method::incremental;
  TransferFunction tf{{preint::ControlPoint{}}};
  double low = 0;
  double high = 1;
  double length = 1;
  int n = 0;
  int m = 1;
  std::vector<preint::Isosurface> surfaces;
};

/// A finished table: its entries, and what the exact integral gives for entry i.
struct Result {
  std::vector<std::size_t> shape;
  std::vector<float> values;
  std::size_t channels = 4;
  std::function<std::vector<double>(std::size_t entry)> exact;
};

preint::TableMethod table_method(Method method) {
  return method == Method::incremental ? preint::TableMethod::incremental
                                       : preint::TableMethod::brute_force;
}

std::vector<double> rgba(const preint::Color& color, double alpha) {
  return {color.x(), color.y(), color.z(), alpha};
}

std::vector<double> full_light(const Task& task, const preint::Segment& segment) {
  const preint::Radiance light = integrate_full(task.tf, segment);
  return rgba(light.color, 1 - light.transmittance);
}

/// The exact entry i of a table over (front, back), or over (front, back, length).
std::vector<double> exact_entry(const Task& task, std::size_t i) {
  const auto n = static_cast<std::size_t>(task.n);
  const auto node = [&](std::size_t k) {
    return preint::table_node(task.low, task.high, task.n, static_cast<int>(k));
  };
  const double front = node(i % n);
  const double back = node(i / n % n);
  switch (task.kind) {
    case Kind::emission:
      return rgba(integrate_emission(task.tf, {front, back, 1}),
                  optical_depth(task.tf, {front, back, 1}));
    case Kind::mip:
      return rgba(max_color(task.tf, front, back), 1);
    case Kind::full2d:
      return full_light(task, {front, back, task.length});
    case Kind::full3d: {
      const auto l = static_cast<double>(i / (n * n));
      return full_light(
          task,
          {front, back, preint::length_at(preint::LengthAxis::linear, task.length, task.m, l)});
    }
    case Kind::weighted: {
      const preint::RampedRadiance light = integrate_ramped(task.tf, {front, back, task.length});
      const bool is_front = i < n * n;
      return is_front ? rgba(light.front, 1 - light.transmittance)
                      : rgba(light.back, light.white_back);
    }
    case Kind::psi: {
      // gamma = k / (k + 1) at equal steps: k = gamma / (1 - gamma), infinite at the last sample.
      const auto k = [&](std::size_t sample) {
        const double gamma = static_cast<double>(sample) / static_cast<double>(n - 1);
        return gamma / (1 - gamma);
      };
      return {preint::psi(k(i % n), k(i / n))};
    }
    case Kind::iso:
    case Kind::material:
      break;
  }
  return {};
}

Result from_2d(const preint::Table2D& table) {
  const auto n = static_cast<std::size_t>(table.n);
  return {{n, n, 4}, {table.rgba.begin(), table.rgba.end()}, 4, {}};
}

Result from_exact_entries(const Task& task, Result layout) {
  const std::size_t entries = layout.values.size() / layout.channels;
  for (std::size_t i = 0; i < entries; ++i) {
    const std::vector<double> entry = exact_entry(task, i);
    std::transform(entry.begin(), entry.end(),
                   layout.values.begin() + static_cast<std::ptrdiff_t>(i * layout.channels),
                   [](double value) { return static_cast<float>(value); });
  }
  return layout;
}

/// An empty table of the right shape.
Result layout_of(const Task& task) {
  const auto n = static_cast<std::size_t>(task.n);
  Result result;
  result.shape = {n, n, 4};
  if (task.kind == Kind::full3d) result.shape = {static_cast<std::size_t>(task.m), n, n, 4};
  if (task.kind == Kind::weighted) result.shape = {2, n, n, 4};
  if (task.kind == Kind::psi) {
    result.shape = {n, n};
    result.channels = 1;
  }
  std::size_t count = 1;
  for (const std::size_t extent : result.shape) count *= extent;
  result.values.resize(count);
  return result;
}

Result build(const Task& task) {
  if (task.method == Method::exact) return from_exact_entries(task, layout_of(task));
  const preint::TableMethod method = table_method(task.method);
  switch (task.kind) {
    case Kind::emission:
      return from_2d(emission_table(task.tf, task.low, task.high, task.n, method));
    case Kind::mip:
      return from_2d(mip_table(task.tf, task.low, task.high, task.n, method));
    case Kind::iso:
      return from_2d(iso_table(task.surfaces, task.low, task.high, task.n));
    case Kind::full2d:
      return from_2d(slab_table(task.tf, task.low, task.high, task.length, task.n, method));
    case Kind::material:
      return from_2d(material_table(task.tf, task.low, task.high, task.length, task.n, method));
    case Kind::full3d: {
      const preint::Table3D table =
          full_table(task.tf, task.low, task.high, task.length, task.n, task.m, method);
      Result result = layout_of(task);
      result.values.assign(table.rgba.begin(), table.rgba.end());
      return result;
    }
    case Kind::weighted: {
      const preint::RampedTables tables =
          ramped_tables(task.tf, task.low, task.high, task.length, task.n, method);
      Result result = layout_of(task);
      const auto middle =
          std::copy(tables.front.rgba.begin(), tables.front.rgba.end(), result.values.begin());
      std::copy(tables.back.rgba.begin(), tables.back.rgba.end(), middle);
      return result;
    }
    case Kind::psi: {
      Result result = layout_of(task);
      result.values = preint::psi_table(task.n).psi;
      return result;
    }
  }
  return {};
}

/// The largest difference of the entries from their exact values; for materials from those of brute
/// force, for isosurfaces (which are looked up, not integrated) 0.
double largest_error(const Task& task, const Result& result) {
  const std::size_t entries = result.values.size() / result.channels;
  double largest = 0;
  if (task.kind == Kind::iso) return 0;
  if (task.kind == Kind::material) {
    const preint::Table2D expected = material_table(task.tf, task.low, task.high, task.length,
                                                    task.n, preint::TableMethod::brute_force);
    for (std::size_t i = 0; i < result.values.size(); ++i) {
      largest = std::max<double>(largest, std::abs(result.values[i] - expected.rgba[i]));
    }
    return largest;
  }
  const std::size_t step =
      std::max<std::size_t>(1, entries / kCheckedEntries) | 1U;  // odd: meets every row and column
  for (std::size_t i = 0; i<entries; i += entries> kCheckedEntries ? step : 1) {
    const std::vector<double> expected = exact_entry(task, i);
    for (std::size_t c = 0; c < result.channels; ++c) {
      largest = std::max(largest, std::abs(result.values[i * result.channels + c] - expected[c]));
    }
  }
  return largest;
}

const std::vector<std::pair<std::string, Kind>>& kinds() {
  static const std::vector<std::pair<std::string, Kind>> kKinds = {
      {"emission", Kind::emission}, {"mip", Kind::mip},       {"iso", Kind::iso},
      {"full2d", Kind::full2d},     {"full3d", Kind::full3d}, {"weighted", Kind::weighted},
      {"material", Kind::material}, {"psi", Kind::psi}};
  return kKinds;
}

const std::vector<std::pair<std::string, Method>>& methods() {
  static const std::vector<std::pair<std::string, Method>> kMethods = {
      {"incremental", Method::incremental},
      {"brute-force", Method::brute_force},
      {"exact", Method::exact}};
  return kMethods;
}

template <class Value>
std::string name_of(Value value, const std::vector<std::pair<std::string, Value>>& choices) {
  return std::find_if(choices.begin(), choices.end(),
                      [&](const auto& choice) { return choice.second == value; })
      ->first;
}

/// Isosurfaces and psi have one way to be made each; all others default to the incremental one.
Method choose_method(const TableArguments& arguments, Kind kind) {
  const Method usual = kind == Kind::iso   ? Method::brute_force
                       : kind == Kind::psi ? Method::exact
                                           : Method::incremental;
  if (arguments.method.empty()) return usual;
  const Method method = parse_choice(arguments.method, "--method", methods());
  const bool single = kind == Kind::iso || kind == Kind::psi;
  if ((single && method != usual) || (kind == Kind::material && method == Method::exact)) {
    throw base::UsageError(
        fmt::format("a table of kind {} is made by {} only", arguments.kind,
                    single ? name_of(usual, methods()) : "incremental and brute-force"));
  }
  return method;
}

Task read_task(const TableArguments& arguments) {
  Task task;
  task.kind = parse_choice(arguments.kind, "--kind", kinds());
  task.method = choose_method(arguments, task.kind);
  const std::size_t cross = arguments.size.find('x');
  task.n = parse_count(arguments.size.substr(0, cross), "--size", 2);
  if ((task.kind == Kind::full3d) != (cross != std::string::npos)) {
    throw base::UsageError(task.kind == Kind::full3d
                               ? "--kind full3d needs --size NxM, values x lengths"
                               : "--size needs one number here; NxM is for --kind full3d");
  }
  if (task.kind == Kind::full3d)
    task.m = parse_count(arguments.size.substr(cross + 1), "--size", 2);
  task.length = parse_number(arguments.length, "--length");
  std::optional<std::pair<double, double>> range;
  if (!arguments.range.empty()) range = parse_range(arguments.range, "--range");
  const auto [low, high] = range.value_or(std::make_pair(0.0, 1.0));
  task.tf = read_named_transfer_function(arguments.transfer_function, low, high, 1);
  task.low = range ? low : task.tf.points().front().value;
  task.high = range ? high : task.tf.points().back().value;
  for (const std::string& text : arguments.isovalues)
    task.surfaces.push_back({parse_number(text, "--isovalue")});
  if (task.kind == Kind::iso && task.surfaces.empty())
    task.surfaces.push_back({(task.low + task.high) / 2});
  for (preint::Isosurface& surface : task.surfaces) surface.color = task.tf.at(surface.value).color;
  return task;
}

void table(const TableArguments& arguments) {
  const Task task = read_task(arguments);
  if (!arguments.output.empty()) const base::OutputFile probe(arguments.output);
  const base::Stopwatch clock;
  const Result result = build(task);
  const double ms = clock.milliseconds();
  const auto entries = static_cast<double>(result.values.size() / result.channels);
  const double error = largest_error(task, result);
  if (!arguments.output.empty()) {
    base::OutputFile output(arguments.output);
    output.write(project::to_npy(result.shape, result.values));
    output.commit();
  }
  const std::string method = name_of(task.method, methods());
  if (arguments.json) {
    const nlohmann::ordered_json json = {{"kind", arguments.kind},
                                         {"method", method},
                                         {"size", arguments.size},
                                         {"ms", ms},
                                         {"entries_per_s", entries / ms * 1000},
                                         {"max_error", error}};
    fmt::print("{}\n", json.dump());
  } else {
    fmt::print("{} table of {}, {}: {:.3g} ms, {:.3g} entries/s, largest error {:.3g}\n",
               arguments.kind, arguments.size, method, ms, entries / ms * 1000, error);
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
  app->add_option("--size", a->size, "N values, or NxM values x lengths (full3d)")
      ->capture_default_str();
  app->add_option("--tf", a->transfer_function, transfer_function_help())->capture_default_str();
  app->add_option("--range", a->range,
                  "LO:HI, the values of the table. Default: those of the transfer function");
  app->add_option(
         "--length", a->length,
         "Length of the segments; the largest one (full3d). The unit is the preset's diagonal")
      ->capture_default_str();
  app->add_option("--method", a->method, "incremental (default) | brute-force | exact");
  app->add_option("--isovalue", a->isovalues, "For --kind iso; repeatable. Default: the middle")
      ->take_all()
      ->expected(1);
  app->add_option("-o,--output", a->output,
                  ".npy of float32, [back][front][RGBA]; full3d: a length axis first; weighted: "
                  "front, back first; psi: "
                  "[back][front]");
  app->add_flag("--json", a->json, "Print JSON");
  app->callback([a] { table(*a); });
}

}  // namespace tetraglass::apps
