// The native projector: what a frame costs against the number of cells, pixels and threads, and by
// instruction set, and the memory that it takes besides the mesh. Prints Markdown; draws plots.
//   scaling_study [cells|pixels|threads|instructions ...] [--most CELLS] [--plots FOLDER]
// FOLDER: of cells.svg and pixels.svg, of what is measured.
// With 2e7 cells it needs some 4 GB of memory and minutes.

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <hwy/targets.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>

#include "base/errors.h"
#include "base/median.h"
#include "base/stopwatch.h"
#include "bench/log_plot.h"
#include "mesh/samples.h"
#include "preint/transfer_function.h"
#include "project/cpu/cell_projector.h"

namespace {

using namespace tetraglass;
using project::Mode;

constexpr int kFrames = 5;
constexpr double kTurn = 0.05;  // radians a frame

struct Medium {
  std::string name;
  Mode mode;
  bool peaks = false;
};

const std::vector<Medium> kMedia = {{"thickness", Mode::thickness},
                                    {"emission", Mode::emission},
                                    {"full", Mode::full},
                                    {"full, peaks", Mode::full, true}};

/// Over the range of the field, opacities relative to the diagonal.
preint::TransferFunction transfer_function(const mesh::ScalarField& field, double diagonal,
                                           bool peaks) {
  const auto at = [&](double t) { return field.min + t * (field.max - field.min); };
  std::vector<preint::ControlPoint> points;
  if (!peaks) {  // 17 control points, nowhere 0
    for (int i = 0; i <= 16; ++i) {
      const double t = i / 16.0;
      points.push_back(
          {at(t), preint::Color(t, 1 - t, 0.5), (2 + 1.5 * std::sin(11 * t)) / diagonal});
    }
    return preint::TransferFunction(points);
  }
  for (int i = 0; i < 5; ++i) {
    const double t = 0.1 + 0.2 * i;
    points.push_back({at(t - 0.02), preint::Color(t, 1 - t, 0.5), 0});
    points.push_back({at(t), preint::Color(t, 1 - t, 0.5), 40 / diagonal});
    points.push_back({at(t + 0.02), preint::Color(t, 1 - t, 0.5), 0});
  }
  return preint::TransferFunction(points);
}

project::Scene make_scene(const mesh::TetMesh& mesh, const Medium& medium) {
  project::Scene scene;
  scene.mesh = &mesh;
  scene.field = mesh::select_scalar(mesh, "");
  scene.drawable = mesh::find_drawable(mesh, scene.field);
  scene.transfer_function =
      transfer_function(scene.field, mesh::bounds(mesh).diagonal().norm(), medium.peaks);
  scene.mode = medium.mode;
  return scene;
}

/// Medians of the frames of a turning camera.
struct Cost {
  double ms = 0;
  double fragments = 0;
  double bytes = 0;  ///< what the projector holds
};

Cost draw(const project::Scene& scene, project::cpu::CellProjector& projector, int size) {
  std::vector<double> times;
  Cost cost;
  for (int i = -1; i < kFrames; ++i) {  // the first one is not counted: it finds its memory
    const double angle = 0.7 + kTurn * i;
    const project::Camera camera =
        project::frame_camera(mesh::bounds(*scene.mesh), {std::cos(angle), std::sin(angle), 0.6},
                              Eigen::Vector3d::UnitZ(), 30, 1);
    project::Stats stats;
    const base::Stopwatch clock;
    (void)projector.draw(project::Frame(camera, size, size), stats);
    if (i >= 0) times.push_back(clock.milliseconds());
    // What is set up once is told with the first frame.
    double bytes = 0;
    for (const auto& [effect, work] : stats.work) bytes += static_cast<double>(work.bytes);
    if (i < 0) cost.bytes = bytes;
    cost.fragments = static_cast<double>(stats.fragments);
  }
  cost.ms = base::median(times);
  return cost;
}

project::cpu::CellProjector make_projector(const project::Scene& scene) {
  project::Request request;
  request.projector = project::Projector::cpu;
  return {scene, project::plan(scene, request)};
}

void print_cells(std::size_t most, bench::LogPlot& plot) {
  fmt::print(
      "## Cells, 512 x 512 pixels\n\nSample `orbital`; set-up: what is kept for all views; bytes: "
      "all that the projector holds besides the mesh, buffers of the tiles included.\n\n"
      "| cells | mode | set-up ms | ... of other values | ms a frame | ns a cell | fragments | "
      "bytes "
      "a cell |\n|---:|---|---:|---:|---:|---:|---:|---:|\n");
  for (const std::size_t wanted : {100000, 300000, 1000000, 3000000, 10000000, 20000000}) {
    if (wanted > most) break;
    const mesh::TetMesh mesh = mesh::make_sample("orbital", wanted);
    const auto cells = static_cast<double>(mesh.cells.size());
    for (const Medium& medium : kMedia) {
      const project::Scene scene = make_scene(mesh, medium);
      const base::Stopwatch clock;
      project::cpu::CellProjector projector = make_projector(scene);
      const double set_up = clock.milliseconds();
      const Cost cost = draw(scene, projector, 512);
      const base::Stopwatch updating;
      projector.update();
      const double update = updating.milliseconds();
      fmt::print("| {} | {} | {:.0f} | {:.0f} | {:.1f} | {:.0f} | {:.3g} | {:.1f} |\n",
                 mesh.cells.size(), medium.name, set_up, update, cost.ms, 1e6 * cost.ms / cells,
                 cost.fragments, cost.bytes / cells);
      std::fflush(stdout);
      plot.add(medium.name, cells, cost.ms);
    }
  }
  fmt::print("\n");
}

void print_pixels(bench::LogPlot& plot) {
  fmt::print(
      "## Pixels, sphere of 148,955 cells\n\n"
      "| size | mode | ms a frame | ns a pixel | fragments | ns a fragment |\n"
      "|---:|---|---:|---:|---:|---:|\n");
  const mesh::TetMesh mesh = mesh::make_sample("sphere");
  for (const int size : {256, 512, 1024, 2048, 4096}) {
    for (const Medium& medium : kMedia) {
      const project::Scene scene = make_scene(mesh, medium);
      project::cpu::CellProjector projector = make_projector(scene);
      const Cost cost = draw(scene, projector, size);
      fmt::print("| {0} x {0} | {1} | {2:.1f} | {3:.0f} | {4:.3g} | {5:.1f} |\n", size, medium.name,
                 cost.ms, 1e6 * cost.ms / (double{1} * size * size), cost.fragments,
                 1e6 * cost.ms / cost.fragments);
      std::fflush(stdout);
      plot.add(medium.name, double{1} * size * size, cost.ms);
    }
  }
  fmt::print("\n");
}

void print_threads() {
  fmt::print(
      "## Threads, sphere of 148,955 cells, 512 x 512 pixels\n\n"
      "| threads | mode | ms a frame | times as fast as one |\n|---:|---|---:|---:|\n");
  const mesh::TetMesh mesh = mesh::make_sample("sphere");
  const int all = tbb::info::default_concurrency();
  for (const Medium& medium : kMedia) {
    const project::Scene scene = make_scene(mesh, medium);
    double alone = 0;
    for (int threads = 1; threads <= all; threads *= 2) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(threads));
      project::cpu::CellProjector projector = make_projector(scene);
      const double ms = draw(scene, projector, 512).ms;
      if (threads == 1) alone = ms;
      fmt::print("| {} | {} | {:.1f} | {:.2f} |\n", threads, medium.name, ms, alone / ms);
    }
  }
  fmt::print("\n");
}

void print_instructions() {
  fmt::print(
      "## Instruction sets, sphere of 148,955 cells, 512 x 512 pixels\n\n"
      "| set | lanes | mode | ms a frame | fragments/s |\n|---|---:|---|---:|---:|\n");
  struct Set {
    std::string name;
    std::int64_t target;
    int lanes;
  };
  const mesh::TetMesh mesh = mesh::make_sample("sphere");
  for (const Set& set : {Set{"AVX-512", HWY_AVX3, 16},
                         {"AVX2", HWY_AVX2, 8},
                         {"SSE4", HWY_SSE4, 4},
                         {"NEON", HWY_NEON, 4}}) {
    if ((hwy::SupportedTargets() & set.target) != set.target) continue;
    for (const Medium& medium : kMedia) {
      const project::Scene scene = make_scene(mesh, medium);
      project::cpu::CellProjector projector = make_projector(scene);
      hwy::GetChosenTarget().Update(set.target);
      const Cost cost = draw(scene, projector, 512);
      hwy::GetChosenTarget().DeInit();
      fmt::print("| {} | {} | {} | {:.1f} | {:.3g} |\n", set.name, set.lanes, medium.name, cost.ms,
                 1e3 * cost.fragments / cost.ms);
    }
  }
  fmt::print("\n");
}

}  // namespace

int main(int argc, char** argv) {
  std::set<std::string> parts;
  std::string plots;
  double most = 2e7;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--most" && i + 1 < argc) {
      most = std::atof(argv[++i]);
    } else if (argument == "--plots" && i + 1 < argc) {
      plots = argv[++i];
    } else {
      parts.insert(argument);
    }
  }
  const auto wants = [&](const char* part) { return parts.empty() || parts.count(part) > 0; };
  try {
    fmt::print("Medians of {} frames of a turning camera, {} threads.\n\n", kFrames,
               tbb::info::default_concurrency());
    const auto study = [&](const char* part, const auto& print) {
      if (!wants(part)) return;
      bench::LogPlot plot(part, "milliseconds a frame");
      print(plot);
      if (!plots.empty()) plot.write(plots + "/" + part + ".svg");
    };
    study("cells", [&](bench::LogPlot& p) { print_cells(static_cast<std::size_t>(most), p); });
    study("pixels", [](bench::LogPlot& p) { print_pixels(p); });
    if (wants("threads")) print_threads();
    if (wants("instructions")) print_instructions();
  } catch (const base::Error& error) {
    fmt::print(stderr, "scaling_study: error: {}\n", error.what());
    return 1;
  }
  return 0;
}
