// The layouts of project/gl side by side: what each costs, unsorted and sorted (the data sets and
// columns of weiler2002, Tables 1 to 3), and how wrong its pictures are. Prints Markdown.
//   gl_layouts [FRAMES] [osmesa|egl] [costs|errors]        (scripts/gl-layouts calls it)

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/errors.h"
#include "base/median.h"
#include "base/stopwatch.h"
#include "mesh/import.h"
#include "mesh/samples.h"
#include "preint/transfer_function.h"
#include "project/gl/cell_layout.h"
#include "project/gl/cell_projector.h"

namespace {

using namespace tetraglass;
using project::GlRequest;
using project::Layout;
using project::Minimum;
using project::Mode;

constexpr int kSize = 512;

struct Variant {
  std::string name;
  GlRequest request;
};

Variant variant(const std::string& name, Layout layout, std::optional<bool> edge_fix = {},
                std::optional<Minimum> minimum = {}, std::optional<bool> interpolate = {}) {
  Variant result{name, {}};
  result.request.layout = layout;
  result.request.edge_fix = edge_fix;
  result.request.minimum = minimum;
  result.request.interpolate_lengths = interpolate;
  return result;
}

project::Scene make_scene(const mesh::TetMesh& mesh, Mode mode) {
  project::Scene scene;
  scene.mesh = &mesh;
  scene.field = mesh::select_scalar(mesh, "");
  scene.drawable = mesh::find_drawable(mesh, scene.field);
  scene.transfer_function = preint::preset("viridis", scene.field.min, scene.field.max,
                                           mesh::bounds(mesh).diagonal().norm());
  scene.mode = mode;
  scene.camera = project::frame_camera(mesh.points, Eigen::Vector3d(1, 0.8, 0.6),
                                       Eigen::Vector3d::UnitZ(), 30, 1);
  scene.width = scene.height = kSize;
  return scene;
}

project::Plan plan_of(const project::Scene& scene, const GlRequest& request,
                      project::ContextKind context) {
  project::Request all;
  all.projector = project::Projector::gl;
  all.context = context;
  all.gl = request;
  // As in the paper: a two-dimensional table of the emission, unsorted; sorted, mode full by the
  // exact order and the exact integral, but for cells in rings.
  if (scene.mode == Mode::full) all.sort = project::SortMethod::mpvo;
  if (scene.mode == Mode::emission) all.integrator = project::Integrator::table2d;
  return project::plan(scene, all);
}

// The camera turned by a part of a full turn around the mesh's vertical axis.
project::Camera turned(const project::Camera& camera, double part) {
  project::Camera result = camera;
  const Eigen::AngleAxisd turn(2 * 3.141592653589793 * part, Eigen::Vector3d::UnitZ());
  result.eye = camera.target + turn * (camera.eye - camera.target);
  return result;
}

// A row of weiler2002's Tables 1 to 3.
struct Published {
  double frames_per_s;
  double kilocells_per_s;
  double megabytes_per_s;
};

struct Data {
  std::string name;
  int published_cells;
  std::array<Published, 3> published;  // GeForce3, floats; GeForce3, shorts; GeForce4, shorts
  mesh::TetMesh mesh;
};

constexpr std::array<Published, 3> kOrbital = {
    {{1.65, 245, 177}, {2.53, 377, 168}, {3.23, 481, 214}}};
constexpr std::array<Published, 3> kSphere = {
    {{1.65, 245, 176}, {2.53, 377, 168}, {3.23, 481, 214}}};
constexpr std::array<Published, 3> kHeatSink = {
    {{2.01, 244, 175}, {3.02, 367, 163}, {3.81, 464, 207}}};
constexpr std::array<Published, 3> kBluntFin = {
    {{1.08, 242, 174}, {1.67, 375, 167}, {2.13, 479, 213}}};

std::vector<Data> data_sets() {
  std::vector<Data> sets;
  const char* folder = std::getenv("TETRAGLASS_DATA");
  const std::filesystem::path file =
      std::filesystem::path(folder != nullptr ? folder : "../shared/data") /
      "classics/bluntfinxyz.bin";
  if (std::filesystem::exists(file)) {
    sets.push_back({"blunt fin", 224874, kBluntFin, mesh::import_mesh(file.string()).mesh});
  } else {
    fmt::print(stderr, "no {}: the blunt fin is left out (TETRAGLASS_DATA names its folder)\n",
               file.string());
  }
  sets.push_back({"heat sink", 121668, kHeatSink, mesh::make_sample("heat-sink")});
  sets.push_back({"orbital", 148955, kOrbital, mesh::make_sample("orbital")});
  sets.push_back({"sphere", 148955, kSphere, mesh::make_sample("sphere")});
  return sets;
}

void print_published(const Data& data) {
  const std::array<const char*, 3> tables = {"*paper's Table 1: GeForce3, floats*",
                                             "*paper's Table 2: GeForce3, shorts*",
                                             "*paper's Table 3: GeForce4, shorts*"};
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const int bytes_per_cell = i == 0 ? 720 : 456;
    const Published& row = data.published[i];
    fmt::print("| {} | {} | {} | {:.1f} | {:.2f} | {:.0f} | {:.0f} | | | |\n", data.name, tables[i],
               data.published_cells, 1e-6 * bytes_per_cell * data.published_cells, row.frames_per_s,
               row.kilocells_per_s, row.megabytes_per_s);
  }
}

/// Median time of a frame, in seconds, sorting included, of each variant; and its megabytes.
struct Cost {
  double seconds = 0;
  double megabytes = 0;
};

std::vector<Cost> costs(const project::Scene& scene, const std::vector<Variant>& variants,
                        project::ContextKind kind, int frames) {
  const std::unique_ptr<project::gl::Context> context = project::gl::Context::create(kind);
  std::vector<std::unique_ptr<project::gl::CellProjector>> projectors;
  std::vector<std::vector<double>> times(variants.size());
  project::Stats stats;
  for (const Variant& v : variants) {
    projectors.push_back(std::make_unique<project::gl::CellProjector>(
        *context, scene, plan_of(scene, v.request, kind), stats));
  }
  // Interleaved, so that a slow moment of the machine meets all of them; the first frame compiles.
  for (int frame = 0; frame <= frames; ++frame) {
    const project::Frame view(turned(scene.camera, double(frame) / (frames + 1)), kSize, kSize);
    for (std::size_t i = 0; i < variants.size(); ++i) {
      const base::Stopwatch clock;
      (void)projectors[i]->draw(view, stats);
      if (frame > 0) times[i].push_back(clock.milliseconds());
    }
  }
  std::vector<Cost> result;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    result.push_back({base::median(times[i]) / 1000, double(projectors[i]->bytes()) / 1e6});
  }
  return result;
}

void print_costs(project::ContextKind kind, int frames) {
  const std::vector<Variant> variants = {
      variant("faces12", Layout::faces12), variant("faces12-short", Layout::faces12_short),
      variant("strip", Layout::strip), variant("indexed", Layout::indexed)};
  fmt::print(
      "| data set | layout | cells | MB | frames/s | K cells/s | MB/s | sorted: frames/s | "
      "K cells/s | MB/s |\n"
      "|---|---|---:|---:|---:|---:|---:|---:|---:|---:|\n");
  for (const Data& data : data_sets()) {
    const project::Scene scene = make_scene(data.mesh, Mode::emission);
    const std::vector<Cost> unsorted = costs(scene, variants, kind, frames);
    const std::vector<Cost> sorted =
        costs(make_scene(data.mesh, Mode::full), variants, kind, frames);
    const double cells = double(scene.drawable.cells.size());
    for (std::size_t i = 0; i < variants.size(); ++i) {
      fmt::print("| {} | {} | {} | {:.1f}", data.name, variants[i].name, cells,
                 unsorted[i].megabytes);
      for (const Cost& cost : {unsorted[i], sorted[i]}) {
        fmt::print(" | {:.2f} | {:.0f} | {:.0f}", 1 / cost.seconds, cells / cost.seconds / 1000,
                   cost.megabytes / cost.seconds);
      }
      fmt::print(" |\n");
      std::fflush(stdout);
    }
    print_published(data);
  }
}

// Against the layout by planes, which the tests hold to the reference.
void print_errors(project::ContextKind kind) {
  const std::vector<Variant> variants = {
      variant("faces12", Layout::faces12),
      variant("faces12, no edge fix", Layout::faces12, false),
      variant("faces12, 16-bit minimum texture", Layout::faces12, true, Minimum::texture16),
      variant("faces12, 8-bit minimum texture", Layout::faces12, true, Minimum::texture8),
      variant("faces12-short", Layout::faces12_short),
      variant("faces12, lengths interpolated", Layout::faces12, true, Minimum::shader, true),
      variant("strip", Layout::strip)};
  fmt::print(
      "\n| thickness, sphere | parallel: bad pixels | largest | RMS | perspective: bad pixels | "
      "largest | RMS |\n|---|---:|---:|---:|---:|---:|---:|\n");
  const mesh::TetMesh mesh = mesh::make_sample("sphere");
  project::Scene scene = make_scene(mesh, Mode::thickness);
  const std::unique_ptr<project::gl::Context> context = project::gl::Context::create(kind);
  project::Stats stats;
  const auto draw = [&](const GlRequest& request) {
    const project::Plan plan = plan_of(scene, request, kind);
    return project::gl::CellProjector(*context, scene, plan, stats)
        .draw(project::Frame(scene.camera, kSize, kSize), stats);
  };
  std::vector<std::string> lines;
  for (const Variant& v : variants) lines.push_back("| " + v.name);
  for (const bool parallel : {true, false}) {
    scene.camera.parallel = parallel;
    const project::Image expected = draw({});
    double most = 0;
    for (std::size_t p = 0; p < expected.rgba.size(); p += 4) {
      most = std::max<double>(most, expected.rgba[p]);
    }
    for (std::size_t i = 0; i < variants.size(); ++i) {
      if (parallel && variants[i].request.interpolate_lengths == true) {
        lines[i] += " | as faces12 | | ";
        continue;
      }
      const project::Image image = draw(variants[i].request);
      int bad = 0;
      double largest = 0;
      double squares = 0;
      for (std::size_t p = 0; p < image.rgba.size(); p += 4) {
        const double error = std::abs(double{image.rgba[p]} - expected.rgba[p]) / most;
        bad += error > 1e-3 ? 1 : 0;
        largest = std::max(largest, error);
        squares += error * error;
      }
      lines[i] += fmt::format(" | {} | {:.1e} | {:.1e}", bad, largest,
                              std::sqrt(squares / (kSize * kSize)));
    }
  }
  for (const std::string& line : lines) fmt::print("{} |\n", line);
}

}  // namespace

int main(int argc, char** argv) {
  const int frames = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
  const std::string part = argc > 3 ? argv[3] : "";
  const bool egl = argc > 2 && std::string(argv[2]) == "egl";
  const project::ContextKind kind = egl ? project::ContextKind::egl : project::ContextKind::osmesa;
  try {
    fmt::print("{}, {} x {} pixels, medians of {} frames of a turning camera\n\n",
               project::gl::Context::create(kind)->description(), kSize, kSize, frames);
    if (part != "errors") print_costs(kind, frames);
    if (part != "costs") print_errors(kind);
  } catch (const base::Error& error) {
    fmt::print(stderr, "gl_layouts: error: {}\n", error.what());
    return 1;
  }
  return 0;
}
