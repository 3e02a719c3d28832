// The native projector: time of a frame of a projector that is kept, and fragments per second. The
// view turns a little from frame to frame.

#include <cmath>
#include <string>

#include <benchmark/benchmark.h>

#include "bench/random_delaunay.h"
#include "mesh/samples.h"
#include "preint/transfer_function.h"
#include "project/cpu/cell_projector.h"

namespace {

using namespace tetraglass;
using project::Mode;

/// A transfer function of the field's range, opacities relative to the diagonal.
preint::TransferFunction medium(const std::string& name, const mesh::ScalarField& field,
                                double diagonal) {
  const auto at = [&](double t) { return field.min + t * (field.max - field.min); };
  const auto color = [](double t) { return preint::Color(t, 1 - t, 0.5); };
  std::vector<preint::ControlPoint> points;
  if (name == "ramp") {
    points = {{at(0), color(0), 0}, {at(1), color(1), 4 / diagonal}};
  } else if (name == "smooth") {  // 17 control points, nowhere 0
    for (int i = 0; i <= 16; ++i) {
      const double t = i / 16.0;
      points.push_back({at(t), color(t), (1.5 + std::sin(11 * t)) / diagonal});
    }
  } else if (name == "peaks") {  // five, narrow, 0 between them
    for (int i = 0; i < 5; ++i) {
      const double t = 0.1 + 0.2 * i;
      points.push_back({at(t - 0.015), color(t), 0});
      points.push_back({at(t), color(t), 20 / diagonal});
      points.push_back({at(t + 0.015), color(t), 0});
    }
  } else {  // opaque
    points = {{at(0), color(0), 20 / diagonal}, {at(1), color(1), 400 / diagonal}};
  }
  return preint::TransferFunction(points);
}

void frame(benchmark::State& state, const std::string& sample, std::size_t cells, Mode mode,
           const std::string& name, bool parallel) {
  const mesh::TetMesh mesh =
      sample == "delaunay" ? bench::random_delaunay(23000) : mesh::make_sample(sample, cells);
  const mesh::Box box = mesh::bounds(mesh);
  project::Scene scene;
  scene.mesh = &mesh;
  scene.field = mesh::select_scalar(mesh, "");
  scene.drawable = mesh::find_drawable(mesh, scene.field);
  scene.transfer_function = medium(name, scene.field, box.diagonal().norm());
  scene.mode = mode;
  project::Request request;
  request.projector = project::Projector::cpu;
  project::cpu::CellProjector projector(scene, project::plan(scene, request));
  project::Stats stats;
  double angle = 0;
  for (auto _ : state) {
    angle += 0.02;
    const Eigen::Vector3d direction(std::cos(angle), std::sin(angle), 0.6);
    project::Camera camera = project::frame_camera(box, direction, Eigen::Vector3d::UnitZ(), 30, 1);
    camera.parallel = parallel;
    benchmark::DoNotOptimize(projector.draw(project::Frame(camera, 512, 512), stats));
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(stats.fragments));
}

BENCHMARK_CAPTURE(frame, sphere_thickness, "sphere", 0, Mode::thickness, "ramp", true)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(frame, sphere_emission_smooth, "sphere", 0, Mode::emission, "smooth", true)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(frame, sphere_mip, "sphere", 0, Mode::mip, "smooth", true)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(frame, sphere_full_ramp, "sphere", 0, Mode::full, "ramp", true)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(frame, sphere_full_smooth, "sphere", 0, Mode::full, "smooth", true)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(frame, sphere_full_smooth_perspective, "sphere", 0, Mode::full, "smooth", false)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(frame, sphere_full_peaks, "sphere", 0, Mode::full, "peaks", true)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(frame, sphere_full_opaque, "sphere", 0, Mode::full, "opaque", true)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(frame, orbital_full_smooth, "orbital", 0, Mode::full, "smooth", true)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(frame, delaunay_full_smooth, "delaunay", 0, Mode::full, "smooth", true)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(frame, orbital_1m_full_smooth, "orbital", 1000000, Mode::full, "smooth", true)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
