#include <cmath>
#include <initializer_list>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/import_options.h"
#include "apps/mesh_input.h"
#include "apps/subcommands.h"
#include "mesh/check.h"

namespace tetraglass::apps {
namespace {

using Json = nlohmann::ordered_json;

struct InfoArguments {
  std::string input;
  mesh::ImportOptions options;
  bool json = false;
};

Json describe_fields(const mesh::TetMesh& mesh) {
  Json fields = Json::array();
  for (const mesh::Field& field : mesh.fields) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const double value : field.values) {
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
    fields.push_back({{"name", field.name},
                      {"location", field.location == mesh::Location::point ? "point" : "cell"},
                      {"components", field.components},
                      {"min", low},  // null where there is no finite value
                      {"max", high}});
  }
  return fields;
}

Json describe(const mesh::Import& imported) {
  const mesh::TetMesh& mesh = imported.mesh;
  const mesh::Soundness soundness = mesh::check(mesh);
  Json cells = Json::object();
  for (const auto& [type, count] : imported.report.input_cells)
    cells[mesh::to_string(type)] = count;
  const mesh::Box box = mesh::bounds(mesh);
  Json limits = Json::array();
  for (int axis = 0; axis < 3; ++axis) {
    limits.push_back(box.isEmpty() ? 0.0 : box.min()[axis]);
    limits.push_back(box.isEmpty() ? 0.0 : box.max()[axis]);
  }
  return {{"points", imported.report.input_points},
          {"cells", cells},
          {"tetrahedra", mesh.cells.size()},
          {"fields", describe_fields(mesh)},
          {"bounds", limits},
          {"degenerate", soundness.degenerate},
          {"inverted", imported.report.inverted},
          {"nan_values", soundness.nan_values},
          {"parts", soundness.parts},
          {"boundary_faces", soundness.boundary_faces},
          {"crowded_faces", soundness.crowded_faces},
          {"convex", soundness.convex},
          {"delaunay", soundness.delaunay},
          {"quality",
           {{"min_dihedral_deg", soundness.min_dihedral_degrees},
            {"histogram", soundness.dihedral_histogram},
            {"min_radius_ratio", soundness.min_radius_ratio},
            {"radius_ratio_histogram", soundness.radius_ratio_histogram}}},
          {"notes", imported.report.notes}};
}

/// What part of the cells lies below each bound of a histogram over [0, last].
std::string shares(const Json& histogram, double last, std::initializer_list<double> bounds) {
  const std::vector<std::size_t> counts = histogram.get<std::vector<std::size_t>>();
  const double all =
      static_cast<double>(std::accumulate(counts.begin(), counts.end(), std::size_t{0}));
  std::string text;
  for (const double bound : bounds) {
    const auto bins = std::lround(bound / last * static_cast<double>(counts.size()));
    const std::size_t below =
        std::accumulate(counts.begin(), counts.begin() + bins, std::size_t{0});
    text += fmt::format(", {:.3g} % below {:g}",
                        all > 0 ? 100 * static_cast<double>(below) / all : 0.0, bound);
  }
  return text;
}

void print_for_people(const std::string& file, const Json& json) {
  fmt::print("{}\n  {} points, {} tetrahedra", file, json["points"].get<std::size_t>(),
             json["tetrahedra"].get<std::size_t>());
  std::string cells;
  for (const auto& [type, count] : json["cells"].items()) {
    cells += fmt::format("{}{} {}", cells.empty() ? "" : ", ", count.get<std::size_t>(), type);
  }
  const std::vector<double> b = json["bounds"].get<std::vector<double>>();
  fmt::print(
      " (in the file: {})\n  bounds x [{:.6g}, {:.6g}]  y [{:.6g}, {:.6g}]  z [{:.6g}, {:.6g}]\n",
      cells, b[0], b[1], b[2], b[3], b[4], b[5]);
  for (const Json& field : json["fields"]) {
    fmt::print("  field '{}': {}, {}", field["name"].get<std::string>(),
               field["location"].get<std::string>(),
               field["components"].get<int>() == 1
                   ? "scalar"
                   : fmt::format("{} components", field["components"].get<int>()));
    if (std::isfinite(field["min"].get<double>())) {
      fmt::print(", {:.6g} to {:.6g}\n", field["min"].get<double>(), field["max"].get<double>());
    } else {
      fmt::print(", no finite value\n");
    }
  }
  fmt::print(
      "  {} zero-volume, {} inverted (turned), {} values not finite, {} faces with more than two "
      "cells or with a doubled one\n",
      json["degenerate"].get<std::size_t>(), json["inverted"].get<std::size_t>(),
      json["nan_values"].get<std::size_t>(), json["crowded_faces"].get<std::size_t>());
  fmt::print("  {} part(s), {} boundary faces, {}, {}\n", json["parts"].get<std::size_t>(),
             json["boundary_faces"].get<std::size_t>(),
             json["convex"].get<bool>() ? "convex" : "not convex",
             json["delaunay"].get<bool>() ? "Delaunay" : "not Delaunay");
  const Json& quality = json["quality"];
  fmt::print("  smallest dihedral angle of a cell: {:.3g} degrees at least{}\n",
             quality["min_dihedral_deg"].get<double>(),
             shares(quality["histogram"], 90, {10, 20, 30}));
  fmt::print("  radius ratio (1: regular): {:.3g} at least{}\n",
             quality["min_radius_ratio"].get<double>(),
             shares(quality["radius_ratio_histogram"], 1, {0.1, 0.3, 0.6}));
}

}  // namespace

void add_info(CLI::App& program) {
  CLI::App* app = program.add_subcommand("info", "What is in a file, and what is wrong with it");
  auto arguments = std::make_shared<InfoArguments>();
  app->footer("usage: tetraglass info INPUT [--json]");
  app->add_option("INPUT", arguments->input, "A mesh, surface, point cloud, grid or volume")
      ->type_name("FILE")
      ->required();
  add_import_options(*app, arguments->options);
  app->add_flag("--json", arguments->json, "Print JSON");
  app->callback([arguments] {
    const mesh::Import imported = import_and_tell(arguments->input, arguments->options);
    const Json json = describe(imported);
    if (arguments->json) {
      fmt::print("{}\n", json.dump(-1, ' ', false, Json::error_handler_t::replace));
    } else {
      print_for_people(arguments->input, json);
    }
  });
}

}  // namespace tetraglass::apps
