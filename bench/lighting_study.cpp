// Ways to light a medium: how wrong each is, against the reference that lights every point of every
// ray, and what it costs; the same of the projectors that draw by OpenGL; cube maps of lights
// against their sum; and what becomes of normals that are not normalized after interpolation.
// Prints Markdown.
//   lighting_study [media | gl | slices | maps | normals [FOLDER]]
//   (default: all; FOLDER gets two pictures)

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
#include "project/gl/cell_projector.h"
#include "project/image_file.h"
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

struct Timed {
  project::Image image;
  double ms = 0;  ///< the median of some frames after the first
};

Timed draw_frames(const project::Scene& scene, const project::Request& request) {
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

/// One row for each way to light that OpenGL has, and one without light: errors of pictures of
/// kCheckedSize, times of such of kTimedSize / 2.
void study_projector(const std::string& drawn, project::Scene scene,
                     const project::Request& request, const std::string& medium,
                     const project::Image& reference) {
  for (const Shading shading : {Shading::single, Shading::weighted, Shading::surface,
                                Shading::interpolated, Shading::none}) {
    scene.shading = shading;
    if (shading == Shading::none) scene.lights.reset();
    scene.width = scene.height = kCheckedSize;
    project::Stats stats;
    const project::Difference difference =
        project::compare(project::render(scene, project::plan(scene, request), stats), reference);
    scene.width = scene.height = kTimedSize / 2;
    fmt::print("| {} | {} | {} | {:.1e} | {:.1e} | {:.0f} |\n", drawn, medium, to_string(shading),
               difference.max, difference.rms, draw_frames(scene, request).ms);
    std::fflush(stdout);
  }
}

void print_head_of_projectors() {
  fmt::print(
      "\n| drawn | medium | shading | largest error | RMS error | ms |\n"
      "|---|---|---|---:|---:|---:|\n");
}

/// Cells by OpenGL, and by the cpu projector at the same size.
void study_gl() {
  print_head_of_projectors();
  const mesh::TetMesh mesh = mesh::make_sample("orbital", 10000);
  project::Scene scene = make_scene(mesh);
  for (const Medium& medium : media(scene, mesh::bounds(mesh).diagonal().norm())) {
    scene.transfer_function = medium.tf;
    scene.width = scene.height = kCheckedSize;
    scene.shading = Shading::smooth;
    const project::Image reference = draw(scene, Projector::reference);
    for (const Projector projector : {Projector::cpu, Projector::gl}) {
      project::Request request;
      request.projector = projector;
      study_projector(fmt::format("{} cells by {}", mesh.cells.size(), to_string(projector)), scene,
                      request, medium.name, reference);
    }
  }
}

/// The points of the same sample as a grid, by slabs of several lengths.
void study_slices() {
  print_head_of_projectors();
  const mesh::TetMesh mesh = mesh::make_sample("orbital", 10000);
  project::Scene scene = make_scene(mesh);
  scene.grid = mesh::rectilinear_grid(mesh);
  for (const Medium& medium : media(scene, mesh::bounds(mesh).diagonal().norm())) {
    scene.transfer_function = medium.tf;
    scene.width = scene.height = kCheckedSize;
    scene.shading = Shading::single;
    const project::Image reference = draw(scene, Projector::grid_reference);
    for (const int slices : {25, 100}) {
      project::Request request;
      request.projector = Projector::slices;
      request.slices.slices = slices;
      study_projector(fmt::format("grid by {} slices", slices), scene, request, medium.name,
                      reference);
    }
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

Timed draw_with_map(const project::Scene& scene, int light_map) {
  project::Request request;
  request.projector = Projector::gl;
  request.light_map = light_map;
  return draw_frames(scene, request);
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

/// Lit with interpolated gradients that are normalized, or that only were at the vertices.
project::Image draw_normals(const project::Scene& scene, bool normalized) {
  using project::gl::CellProjector;
  project::Request request;
  request.projector = Projector::gl;
  const project::Plan plan = project::plan(scene, request);
  const auto context = project::gl::Context::create(plan.context);
  project::Stats stats;
  CellProjector projector(*context, scene, plan, stats, CellProjector::kLargestTile,
                          project::gl::FragmentLists::kMost,
                          normalized ? CellProjector::Gradients::normalized
                                     : CellProjector::Gradients::of_unit_vertices);
  return average(projector.draw(project::make_frame(scene), stats), scene.samples);
}

/// The darkening that meissner2002 (section 2.1) warns of, on an isosurface.
void study_normals(const std::string& folder) {
  fmt::print(
      "\n| mesh | cells | normals | largest error | RMS error | mean color |\n"
      "|---|---:|---|---:|---:|---:|\n");
  for (const std::size_t cells : {std::size_t{1500}, std::size_t{12000}, std::size_t{150000}}) {
    const mesh::TetMesh mesh = mesh::make_sample("orbital", cells);
    project::Scene scene = make_scene(mesh);
    scene.mode = project::Mode::iso;
    scene.isosurfaces = {
        {scene.field.min + 0.3 * (scene.field.max - scene.field.min), Color(0.9, 0.55, 0.2), 1}};
    scene.shading = Shading::smooth;
    scene.width = scene.height = 2 * kCheckedSize;
    const project::Image reference = draw(scene, Projector::reference);
    for (const bool normalized : {true, false}) {
      const project::Image image = draw_normals(scene, normalized);
      const project::Difference difference = project::compare(image, reference);
      double sum = 0;
      double covered = 0;
      for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        sum += double{image.rgba[i]} + image.rgba[i + 1] + image.rgba[i + 2];
        covered += image.rgba[i + 3];
      }
      fmt::print("| orbital | {} | {} | {:.1e} | {:.1e} | {:.4f} |\n", mesh.cells.size(),
                 normalized ? "normalized after interpolation" : "normalized at the vertices only",
                 difference.max, difference.rms, sum / (3 * covered));
    }
    if (folder.empty() || cells != 1500) continue;
    scene.samples = 4;
    scene.width = scene.height = 300;
    project::write_image(draw_normals(scene, true), folder + "/normalized.png");
    project::write_image(draw_normals(scene, false), folder + "/not-normalized.png");
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string part = argc > 1 ? argv[1] : "";
  try {
    if (part.empty() || part == "media") {
      fmt::print("| mesh | cells | medium | shading | largest error | RMS error | ms |\n");
      fmt::print("|---|---:|---|---|---:|---:|---:|\n");
      study("orbital", 10000);
      study("orbital", 150000);
    }
    if (part.empty() || part == "gl") study_gl();
    if (part.empty() || part == "slices") study_slices();
    if (part.empty() || part == "maps") study_maps();
    if (part.empty() || part == "normals") study_normals(argc > 2 ? argv[2] : "");
  } catch (const std::exception& error) {
    fmt::print(stderr, "lighting_study: error: {}\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
