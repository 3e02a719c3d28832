// Ways to light a medium: how wrong each is, against the reference that lights every point of every
// ray, and what it costs; and cube maps of lights against their sum. Prints Markdown.
//   lighting_study [media | maps]    (default: both)

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/errors.h"
#include "base/stopwatch.h"
#include "mesh/samples.h"
#include "project/compare.h"
#include "project/cpu/cell_projector.h"
#include "project/render.h"

namespace {

using namespace tetraglass;
using preint::Color;
using preint::ControlPoint;
using preint::TransferFunction;
using project::Projector;
using project::Shading;

constexpr int kCheckedSize = 96;  // pixels each way, against the reference
constexpr int kTimedSize = 512;
constexpr int kFrames = 5;

struct Medium {
  std::string name;
  TransferFunction tf;
};

/// Narrow, translucent shells at these parts of the field's range, in clear space: a ray keeps half
/// of its light through each, seen face on in cells of ordinary size.
TransferFunction shells(const project::Scene& scene, const std::vector<double>& places,
                        double diagonal) {
  const double low = scene.field.min;
  const double range = scene.field.max - low;
  constexpr double kHalfWidth = 0.015;
  std::vector<ControlPoint> points;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double t = places[i];
    const Color color = i % 2 == 0 ? Color(0.9, 0.5, 0.15) : Color(0.15, 0.6, 0.9);
    points.push_back({low + (t - kHalfWidth) * range, color, 0});
    points.push_back({low + t * range, color, 60 / diagonal});
    points.push_back({low + (t + kHalfWidth) * range, color, 0});
  }
  return TransferFunction(points);
}

std::vector<Medium> media(const project::Scene& scene, double diagonal) {
  const double low = scene.field.min;
  const double range = scene.field.max - low;
  const TransferFunction smooth({{low, Color(0.1, 0.2, 0.8), 0.2 / diagonal},
                                 {low + 0.4 * range, Color(0.2, 0.8, 0.4), 2 / diagonal},
                                 {low + range, Color(1, 0.8, 0.3), 8 / diagonal}});
  return {{"two shells", shells(scene, {0.3, 0.36}, diagonal)},
          {"five shells", shells(scene, {0.15, 0.21, 0.3, 0.5, 0.56}, diagonal)},
          {"smooth", smooth}};
}

project::Scene make_scene(const mesh::TetMesh& mesh) {
  project::Scene scene;
  scene.mesh = &mesh;
  scene.field = mesh::select_scalar(mesh, "");
  scene.drawable = mesh::find_drawable(mesh, scene.field);
  scene.camera = project::frame_camera(mesh.points, Eigen::Vector3d(1, 0.8, 0.6),
                                       Eigen::Vector3d::UnitZ(), 30, 1);
  project::Lights lights;
  lights.lights.emplace_back(
      project::DirectionalLight{Eigen::Vector3d(-1, -0.3, -0.8), Color(1, 0.95, 0.9)});
  scene.lights = lights;
  return scene;
}

project::Image draw(const project::Scene& scene, Projector projector) {
  project::Request request;
  request.projector = projector;
  project::Stats stats;
  return project::render(scene, project::plan(scene, request), stats);
}

double median_ms(project::Scene scene) {
  scene.width = scene.height = kTimedSize;
  project::Request request;
  request.projector = Projector::cpu;
  project::cpu::CellProjector projector(scene, project::plan(scene, request));
  std::vector<double> times;
  for (int i = 0; i < kFrames; ++i) {
    project::Stats stats;
    const base::Stopwatch clock;
    static_cast<void>(projector.draw(project::make_frame(scene), stats));
    times.push_back(clock.milliseconds());
  }
  std::nth_element(times.begin(), times.begin() + kFrames / 2, times.end());
  return times[kFrames / 2];
}

void study(const std::string& name, std::size_t cells) {
  const mesh::TetMesh mesh = mesh::make_sample(name, cells);
  project::Scene scene = make_scene(mesh);
  const double diagonal = mesh::bounds(mesh).diagonal().norm();
  for (const Medium& medium : media(scene, diagonal)) {
    scene.transfer_function = medium.tf;
    scene.width = scene.height = kCheckedSize;
    scene.shading = Shading::smooth;
    const project::Image reference = draw(scene, Projector::reference);
    for (const Shading shading : {Shading::single, Shading::weighted, Shading::surface,
                                  Shading::interpolated, Shading::smooth}) {
      scene.shading = shading;
      const project::Difference difference =
          project::compare(draw(scene, Projector::cpu), reference);
      fmt::print("| {} | {} | {} | {} | {:.1e} | {:.1e} | {:.1f} |\n", name, mesh.cells.size(),
                 medium.name, to_string(shading), difference.max, difference.rms, median_ms(scene));
      std::fflush(stdout);
    }
    project::Scene unlit = scene;
    unlit.shading = Shading::none;
    unlit.lights.reset();
    const project::Difference difference = project::compare(draw(unlit, Projector::cpu), reference);
    fmt::print("| {} | {} | {} | none | {:.1e} | {:.1e} | {:.1f} |\n", name, mesh.cells.size(),
               medium.name, difference.max, difference.rms, median_ms(unlit));
  }
}

/// So many far-away lights, spread evenly over the half of the sphere above the mesh.
project::Lights spread_lights(int count) {
  project::Lights lights;
  for (int i = 0; i < count; ++i) {
    const double z = (i + 0.5) / count;
    const double angle = 2.399963 * i;  // the golden one
    const double r = std::sqrt(1 - z * z);
    lights.lights.emplace_back(project::DirectionalLight{
        -Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), z),
        Color(0.6 + 0.4 * std::cos(angle), 0.8, 0.6 + 0.4 * std::sin(angle)) / std::sqrt(count)});
  }
  return lights;
}

struct Timed {
  project::Image image;
  double ms = 0;  ///< the median of some frames after the first
};

Timed draw_with_map(const project::Scene& scene, int light_map) {
  project::Request request;
  request.projector = Projector::gl;
  request.light_map = light_map;
  project::Stats stats;
  project::SceneProjector projector(scene, project::plan(scene, request), stats);
  Timed drawn;
  std::vector<double> times;
  for (int i = 0; i <= kFrames; ++i) {
    const base::Stopwatch clock;
    drawn.image = projector.draw(stats);
    if (i > 0) times.push_back(clock.milliseconds());
  }
  std::nth_element(times.begin(), times.begin() + kFrames / 2, times.end());
  drawn.ms = times[kFrames / 2];
  return drawn;
}

/// Cube maps (meissner2002 section 3) against the sum over the lights.
void study_maps() {
  fmt::print(
      "\n| lights | sum, ms | map of 16, ms | error | map of 64, ms | error | map of 256, ms | "
      "error "
      "|\n|---:|---:|---:|---:|---:|---:|---:|---:|\n");
  const mesh::TetMesh mesh = mesh::make_sample("orbital", 150000);
  project::Scene scene = make_scene(mesh);
  scene.mode = project::Mode::full;
  scene.shading = Shading::single;
  scene.width = scene.height = kTimedSize / 2;
  scene.transfer_function = media(scene, mesh::bounds(mesh).diagonal().norm())[2].tf;
  for (const int count : {1, 4, 16, 64}) {
    scene.lights = spread_lights(count);
    const Timed sum = draw_with_map(scene, 0);
    fmt::print("| {} | {:.0f} |", count, sum.ms);
    for (const int size : {16, 64, 256}) {
      const Timed looked_up = draw_with_map(scene, size);
      fmt::print(" {:.0f} | {:.1e} |", looked_up.ms,
                 project::compare(looked_up.image, sum.image).max);
    }
    fmt::print("\n");
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string part = argc > 1 ? argv[1] : "";
  try {
    if (part != "maps") {
      fmt::print("| mesh | cells | medium | shading | largest error | RMS error | ms |\n");
      fmt::print("|---|---:|---|---|---:|---:|---:|\n");
      study("orbital", 10000);
      study("orbital", 150000);
    }
    if (part != "media") study_maps();
  } catch (const std::exception& error) {
    fmt::print(stderr, "lighting_study: error: {}\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
