#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/camera_options.h"
#include "apps/mesh_input.h"
#include "apps/options.h"
#include "apps/subcommands.h"
#include "base/median.h"
#include "base/stopwatch.h"
#include "sort/cell_sorter.h"
#include "sort/verify.h"

namespace tetraglass::apps {
namespace {

using Eigen::Vector3d;
using sort::Method;

struct OrderArguments : CameraArguments {
  std::string input;
  std::string sort = "auto";
  std::string rays = "0";
  std::string views;
  std::string weights;
  bool json = false;
  mesh::ImportOptions import;
};

// What sorting and checking from all views came to.
struct OrderReport {
  std::string method;
  bool exact = true;
  std::size_t cells = 0;
  std::size_t views = 0;
  double prepare_ms = 0;
  std::vector<double> ms;  // of each view, the fastest of some repetitions
  std::size_t cycles = 0;
  std::vector<std::uint32_t> cyclic_cells;  // of the first view that has cycles
  std::size_t faces = 0;
  std::size_t wrong_faces = 0;
  sort::RayCheck rays;
};

// Random views in turn: parallel, an eye outside the mesh, an eye inside its bounds.
std::vector<sort::View> random_views(const mesh::TetMesh& mesh, std::size_t count) {
  const mesh::Box box = mesh::bounds(mesh);
  std::mt19937 random;  // the default seed: the same views each time
  const auto unit = [&] { return (random() + 0.5) * 0x1p-32; };
  const auto direction = [&] {
    while (true) {
      const Vector3d v(2 * unit() - 1, 2 * unit() - 1, 2 * unit() - 1);
      if (v.squaredNorm() <= 1 && v.squaredNorm() > 0) return v.normalized();
    }
  };
  std::vector<sort::View> views(count);
  for (std::size_t i = 0; i < count; ++i) {
    sort::View& view = views[i];
    view.parallel = i % 3 == 0;
    view.direction = direction();
    const Vector3d half = 0.5 * box.diagonal();
    if (i % 3 == 1) view.eye = box.center() - (1 + 3 * unit()) * half.norm() * view.direction;
    if (i % 3 == 2) {
      const Vector3d offset(2 * unit() - 1, 2 * unit() - 1, 2 * unit() - 1);
      view.eye = box.center() + offset.cwiseProduct(half);
    }
  }
  return views;
}

std::optional<Method> parse_method(const std::string& text) {
  return parse_choice<std::optional<Method>>(text, "--sort",
                                             {{"auto", std::nullopt},
                                              {"none", Method::none},
                                              {"centroid", Method::centroid},
                                              {"power", Method::power},
                                              {"mpvo", Method::mpvo},
                                              {"fragments", Method::fragments}});
}

void add(sort::RayCheck& sum, const sort::RayCheck& part) {
  sum.rays += part.rays;
  sum.wrong += part.wrong;
  sum.overlapping += part.overlapping;
  sum.pieces += part.pieces;
}

// Sorts from one view, a few times while that is quick, and checks what came out.
void sort_and_check(sort::CellSorter& sorter, const mesh::TetMesh& mesh,
                    const sort::CellLinks& links, const sort::View& view, std::size_t rays,
                    std::uint32_t seed, OrderReport& report) {
  constexpr int kRepetitions = 5;
  constexpr double kLongEnough = 200;  // ms
  double best = 0;
  double spent = 0;
  const sort::Order* sorted = nullptr;
  for (int i = 0; i < kRepetitions && spent < kLongEnough; ++i) {
    const base::Stopwatch clock;
    sorted = &sorter.sort(view);
    const double ms = clock.milliseconds();
    best = i == 0 ? ms : std::min(best, ms);
    spent += ms;
  }
  const sort::Order& order = *sorted;
  report.ms.push_back(best);
  report.method = order.method;
  report.exact = report.exact && order.exact;
  report.cycles += order.cycles;
  if (report.cyclic_cells.empty()) report.cyclic_cells = order.cyclic_cells;
  const sort::FaceCheck faces = sort::check_faces(mesh, links, order.cells, view);
  report.faces += faces.faces;
  report.wrong_faces += faces.wrong;
  if (rays > 0) add(report.rays, sort::check_rays(mesh, order.cells, view, rays, seed));
}

// By the method asked for; else by `power`, the fastest exact one, where the mesh is Delaunay, and
// by `mpvo` elsewhere.
sort::CellSorter make_sorter(std::optional<Method> method, const mesh::TetMesh& mesh,
                             const std::vector<std::uint32_t>& cells,
                             const std::vector<double>& weights) {
  if (method) return {*method, mesh, cells, weights};
  try {
    return {Method::power, mesh, cells};
  } catch (const base::InputError&) {
    return {Method::mpvo, mesh, cells};
  }
}

void sort_cells(std::optional<Method> method, const mesh::TetMesh& mesh,
                const std::vector<std::uint32_t>& cells, const std::vector<double>& weights,
                const std::vector<sort::View>& views, std::size_t rays, OrderReport& report) {
  const base::Stopwatch clock;
  sort::CellSorter sorter = make_sorter(method, mesh, cells, weights);
  report.prepare_ms = clock.milliseconds();
  const sort::CellLinks links = sort::link_cells(mesh, cells);
  for (std::size_t i = 0; i < views.size(); ++i) {
    sort_and_check(sorter, mesh, links, views[i], rays, static_cast<std::uint32_t>(i + 1), report);
  }
}

// Each ray sorts its own pieces: there are no cells to sort, and no faces to be wrong.
void check_fragments(const mesh::TetMesh& mesh, const std::vector<std::uint32_t>& cells,
                     const std::vector<sort::View>& views, std::size_t rays, OrderReport& report) {
  report.method = "fragments";
  report.exact = true;
  report.wrong_faces = 0;
  report.faces = 0;
  report.rays = {};
  report.ms.assign(views.size(), 0);
  for (std::size_t i = 0; i < views.size(); ++i) {
    add(report.rays,
        sort::check_fragments(mesh, cells, views[i], rays, static_cast<std::uint32_t>(i + 1)));
  }
}

std::string to_json(const OrderReport& report) {
  const double ms = base::median(report.ms);
  const nlohmann::ordered_json json = {
      {"method", report.method},
      {"exact", report.exact},
      {"cells", report.cells},
      {"ms", ms},
      {"cells_per_s", ms > 0 ? static_cast<double>(report.cells) / (ms * 1e-3) : 0.0},
      {"cycles", report.cycles},
      {"wrong_faces", report.wrong_faces},
      {"rays", report.rays.rays},
      {"wrong_rays", report.rays.wrong},
      {"views", report.views},
      {"prepare_ms", report.prepare_ms},
      {"faces", report.faces},
      {"overlapping_rays", report.rays.overlapping},
      {"ray_pieces", report.rays.pieces},
      {"cyclic_cells", report.cyclic_cells}};
  return json.dump();
}

void print_for_people(const OrderReport& report) {
  const double ms = base::median(report.ms);
  fmt::print("{}: {}\n", report.method, report.exact ? "exact" : "approximate");
  if (ms > 0) {
    fmt::print("  {} cells in {:.3g} ms: {:.3g} million cells/s; {:.3g} ms once per mesh\n",
               report.cells, ms, static_cast<double>(report.cells) / ms * 1e-3, report.prepare_ms);
  }
  if (report.cycles > 0) {
    fmt::print(
        "  {} cycles of cells that hide each other, over {} view(s); {} cells in the first\n",
        report.cycles, report.views, report.cyclic_cells.size());
  }
  if (report.faces > 0) {
    fmt::print("  {} of {} faces between cells in the wrong order ({:.3g} %)\n", report.wrong_faces,
               report.faces,
               100.0 * static_cast<double>(report.wrong_faces) / static_cast<double>(report.faces));
  }
  if (report.rays.rays > 0) {
    fmt::print("  {} of {} random rays meet cells in the wrong order\n", report.rays.wrong,
               report.rays.rays);
  }
  if (report.rays.overlapping > 0) {
    fmt::print("  on {} rays cells overlap: no order of theirs is right\n",
               report.rays.overlapping);
  }
}

std::vector<sort::View> chosen_views(const OrderArguments& arguments, const mesh::TetMesh& mesh) {
  if (arguments.views.empty()) {
    return {project::Frame(make_camera(arguments, mesh, 1), 1, 1).view()};
  }
  if (!arguments.eye.empty() || !arguments.view.empty() || !arguments.ortho.empty()) {
    throw base::UsageError("--views takes random views: leave out --eye, --view and --ortho");
  }
  return random_views(mesh, static_cast<std::size_t>(parse_count(arguments.views, "--views", 1)));
}

std::vector<double> chosen_weights(const OrderArguments& arguments, std::optional<Method> method,
                                   const mesh::TetMesh& mesh) {
  if (arguments.weights.empty()) return {};
  if (method != Method::power) throw base::UsageError("--weights are for --sort power");
  mesh::ScalarField field = select_scalar_of(arguments.input, mesh, arguments.weights);
  if (field.location != mesh::Location::point) {
    throw base::UsageError("--weights needs a point field; '" + field.name + "' is one of cells");
  }
  for (const double weight : field.values) {
    if (!std::isfinite(weight)) {
      throw base::InputError("the weights '" + field.name + "' are not all finite");
    }
  }
  return std::move(field.values);
}

void order(const OrderArguments& arguments) {
  const std::optional<Method> method = parse_method(arguments.sort);
  const auto rays = static_cast<std::size_t>(parse_count(arguments.rays, "--rays", 0));
  if (method == Method::none) {
    throw base::UsageError("--sort none is no order; there are: centroid, power, mpvo, fragments");
  }
  const mesh::Import imported = import_and_tell(arguments.input, arguments.import);
  const mesh::TetMesh& mesh = imported.mesh;
  // Whatever its values, a cell has its place in the order.
  const mesh::ScalarField no_field{"", mesh::Location::cell, std::vector<double>(mesh.cells.size()),
                                   0, 0};
  const mesh::Drawable drawable = mesh::find_drawable(mesh, no_field);
  if (drawable.degenerate + drawable.nan > 0) {
    warn(
        fmt::format("{} cells without volume and {} with coordinates that are not finite are left "
                    "out",
                    drawable.degenerate, drawable.nan));
  }
  const std::vector<sort::View> views = chosen_views(arguments, mesh);
  const std::vector<double> weights = chosen_weights(arguments, method, mesh);
  OrderReport report;
  report.cells = drawable.cells.size();
  report.views = views.size();
  if (method == Method::fragments) {
    check_fragments(mesh, drawable.cells, views, rays, report);
  } else {
    sort_cells(method, mesh, drawable.cells, weights, views, rays, report);
    // No order of the cells is right: each pixel has to sort its own pieces.
    if (!method && report.cycles > 0) check_fragments(mesh, drawable.cells, views, rays, report);
  }
  if (arguments.json) {
    fmt::print("{}\n", to_json(report));
  } else {
    print_for_people(report);
  }
}

}  // namespace

void add_order(CLI::App& program) {
  CLI::App* app =
      program.add_subcommand("order", "Sort the cells of a mesh by visibility, time it, verify it");
  auto arguments = std::make_shared<OrderArguments>();
  app->footer("usage: tetraglass order INPUT [camera] [--sort M] [--rays N] [--json]");
  app->option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::Throw);
  app->add_option("INPUT", arguments->input, "A mesh, surface, point cloud or grid")
      ->type_name("FILE")
      ->required();
  app->add_option(
         "--sort", arguments->sort,
         "auto (power on Delaunay meshes, else mpvo; fragments where cells hide each other in a "
         "ring) | centroid | power | mpvo | fragments")
      ->capture_default_str();
  app->add_option("--rays", arguments->rays,
                  "Check every cell that N random rays meet, by brute force")
      ->capture_default_str();
  app->add_option("--views", arguments->views,
                  "Instead of a camera N random views: parallel, from outside, from inside");
  app->add_option("--weights", arguments->weights,
                  "Point field with the weights of a regular triangulation, for --sort power");
  app->add_option("--time", arguments->import.time,
                  "Time step: a time, 'last' (default) or 'index:N'");
  app->add_flag("--json", arguments->json, "Print JSON");
  add_camera_options(app, *arguments);
  app->callback([arguments] { order(*arguments); });
}

}  // namespace tetraglass::apps
