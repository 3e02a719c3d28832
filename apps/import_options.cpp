#include "apps/import_options.h"

#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "apps/options.h"
#include "base/errors.h"

namespace tetraglass::apps {
namespace {

double positive(const std::string& text, const std::string& option) {
  const double value = parse_number(text, option);
  if (!(value > 0)) throw base::UsageError(option + " needs a number above 0, not '" + text + "'");
  return value;
}

/// RATIO[:DEGREES].
void parse_quality(const std::string& text, mesh::FillOptions& fill) {
  const std::size_t colon = text.find(':');
  fill.radius_edge_ratio = parse_number(text.substr(0, colon), "--quality");
  if (colon != std::string::npos) {
    fill.min_dihedral = parse_number(text.substr(colon + 1), "--quality");
  }
  // Of a regular tetrahedron the ratio is sqrt(6) / 4, and all angles are 70.5 degrees.
  if (!(fill.radius_edge_ratio > 1) || !(fill.min_dihedral >= 0 && fill.min_dihedral < 60)) {
    throw base::UsageError(
        fmt::format("--quality needs RATIO[:DEGREES], a ratio above 1 and degrees from 0 to below "
                    "60, not '{}'",
                    text));
  }
}

mesh::VolumeRegions& regions_of(mesh::ImportOptions& options) {
  if (!options.regions) options.regions.emplace();
  return *options.regions;
}

void add_surface_options(CLI::App& app, mesh::ImportOptions& options) {
  using mesh::Tetrahedralizer;
  app.add_flag("--repair", options.repair,
               "Mend a surface before it is filled: doubled and flat triangles, directions, seams, "
               "small holes; what was done is told");
  app.add_option("--largest-hole", options.largest_hole,
                 fmt::format("The largest hole that --repair closes, in parts of the surface's "
                             "diagonal (default {:g})",
                             mesh::kUsualLargestHole))
      ->check(CLI::Range(0.0, 1.0))
      ->needs("--repair");
  app.add_option_function<std::string>(
      "--tetrahedralize",
      [&options](const std::string& name) {
        options.tetrahedralizer =
            parse_choice<Tetrahedralizer>(name, "--tetrahedralize",
                                          {{"tetgen", Tetrahedralizer::tetgen},
                                           {"cgal", Tetrahedralizer::cgal},
                                           {"delaunay", Tetrahedralizer::delaunay}});
      },
      "tetgen (default for surfaces: constrained to its triangles) | cgal (the surface is meshed "
      "anew) | delaunay (default for points: their convex hull)");
  app.add_option_function<std::string>(
      "--quality", [&options](const std::string& text) { parse_quality(text, options.fill); },
      "Shape of new tetrahedra, RATIO[:DEGREES]: the largest ratio of circumradius to shortest "
      "edge "
      "(default 2), the smallest dihedral angle to aim at (tetgen)");
  app.add_option_function<std::string>(
      "--max-volume",
      [&options](const std::string& text) {
        options.fill.max_volume = positive(text, "--max-volume");
      },
      "The largest volume of new tetrahedra, in the input's units (default: so that there are "
      "about "
      "100,000)");
  app.add_option_function<std::vector<std::string>>(
         "--hole",
         [&options](const std::vector<std::string>& places) {
           for (const std::string& place : places) {
             options.fill.holes.emplace_back(parse_vector(place, "--hole"));
           }
         },
         "X,Y,Z: leave the region of the surface's inside empty that this place lies in; "
         "repeatable "
         "(tetgen)")
      ->take_all()
      ->expected(1);
  app.add_flag("--keep-surface", options.fill.keep_surface,
               "Add no points on the surface: its triangles stay as they are (tetgen)");
}

void add_image_options(CLI::App& app, mesh::ImportOptions& options) {
  app.add_flag_callback(
      "--labels", [&options] { regions_of(options).labels = true; },
      "Mesh an image whose values are labels: every label but 0 is a region (cell field 'region')");
  app.add_option_function<std::string>(
         "--surface-at",
         [&options](const std::string& text) {
           regions_of(options).level = parse_number(text, "--surface-at");
         },
         "Mesh the part of an image whose values are at least this")
      ->excludes("--labels");
  app.add_option_function<std::string>(
      "--image-field", [&options](const std::string& name) { regions_of(options).field = name; },
      "The field that --labels and --surface-at look at (default: the first scalar)");
}

}  // namespace

void add_import_options(CLI::App& app, mesh::ImportOptions& options) {
  app.add_option(
      "--time", options.time,
      "Time step: a time, 'last' (default) or 'index:N'; of render 'all', too: a frame each");
  app.add_flag("--refine-quadratic", options.refine_quadratic,
               "Cut quadratic cells along the points on their edges, instead of drawing their "
               "corners");
  app.add_option("--raw", options.raw,
                 "Layout of a file of bare values: WIDTHxHEIGHTxDEPTH:TYPE[:little|big]");
  app.add_option_function<std::string>(
      "--weld",
      [&options](const std::string& text) {
        const double distance = parse_number(text, "--weld");
        if (distance < 0) throw base::UsageError("--weld needs a distance of at least 0");
        options.weld = distance;
      },
      "Make points one that lie within this distance of each other (0: that are equal)");
  add_surface_options(app, options);
  add_image_options(app, options);
}

}  // namespace tetraglass::apps
