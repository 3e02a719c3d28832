#include "apps/render_frames.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "apps/figure.h"
#include "apps/mesh_input.h"
#include "apps/options.h"
#include "apps/orbit.h"
#include "apps/picture_files.h"
#include "base/progress.h"
#include "base/stopwatch.h"
#include "mesh/time_step.h"
#include "project/render.h"

namespace tetraglass::apps {
namespace {

mesh::Import import_step(const RenderArguments& arguments, int step) {
  mesh::ImportOptions options = arguments.import;
  options.grid_only = draws_grid(arguments);
  options.time = fmt::format("index:{}", step);
  return mesh::import_mesh(arguments.input, options);
}

/// The frames of one scene after the other, with what stands around them.
class FrameRow {
 public:
  FrameRow(const RenderArguments& arguments, const project::Scene& scene, int count)
      : FrameRow(arguments, scene, count, parse_size(arguments.size, "--size")) {}

  [[nodiscard]] const Figure& figure() const { return figure_; }

  void add(const project::Image& picture, const project::Camera& camera, double ms,
           RenderReport& report) {
    const base::Stopwatch clock;
    outputs_.add(figure_.around(picture, camera));
    report.write_ms += clock.milliseconds();
    drawn_.frame_ms.push_back(ms);
    progress_.advance();
  }

  [[nodiscard]] FramesDrawn finish() {
    drawn_.files = outputs_.finish();
    return std::move(drawn_);
  }

 private:
  FrameRow(const RenderArguments& arguments, const project::Scene& scene, int count,
           const std::pair<int, int>& size)
      : figure_(arguments, scene, size.first, size.second),
        outputs_(arguments, scene.mode, count, size.first, size.second,
                 mesh::bounds(*scene.mesh).diagonal().norm()),
        progress_("frames", static_cast<std::uint64_t>(count)) {}

  Figure figure_;
  FrameOutputs outputs_;
  base::Progress progress_;
  FramesDrawn drawn_;
};

}  // namespace

int count_time_steps(const RenderArguments& arguments) {
  try {
    (void)import_step(arguments, std::numeric_limits<int>::max());
  } catch (const mesh::NoTimeStepError& error) {
    return static_cast<int>(error.steps());
  }
  throw base::InputError(arguments.input + ": has no time steps for --time all");
}

mesh::ScalarField values_of_all_times(const RenderArguments& arguments, int steps) {
  // Enough for the shares of 64 bins; a small mesh gives all that it has.
  constexpr std::size_t kPicked = 65536;
  mesh::ScalarField all;
  base::Progress progress("time steps", static_cast<std::uint64_t>(steps));
  for (int step = 0; step < steps; ++step) {
    const mesh::Import imported = import_step(arguments, step);
    const mesh::ScalarField field =
        select_scalar_of(arguments.input, imported.mesh, arguments.field);
    all.name = field.name;
    all.location = field.location;
    all.min = step == 0 ? field.min : std::min(all.min, field.min);
    all.max = step == 0 ? field.max : std::max(all.max, field.max);
    const std::size_t stride = (field.values.size() + kPicked - 1) / kPicked;
    for (std::size_t i = 0; i < field.values.size(); i += stride) {
      all.values.push_back(field.values[i]);
    }
    progress.advance();
  }
  return all;
}

FramesDrawn draw_orbit(const RenderArguments& arguments, project::Scene& scene,
                       const project::Plan& plan, RenderReport& report) {
  const int count = orbit_frames(arguments);
  FrameRow row(arguments, scene, count);
  project::SceneProjector projector(scene, plan, report.stats);
  for (const project::Camera& camera : orbit(scene.camera, orbit_pivot(arguments, scene), count)) {
    scene.camera = camera;
    const base::Stopwatch clock;
    const project::Image picture = projector.draw(report.stats);
    row.add(picture, camera, clock.milliseconds(), report);
  }
  return row.finish();
}

FramesDrawn draw_times(const RenderArguments& arguments, int steps, project::Scene& scene,
                       const project::Plan& plan, RenderReport& report) {
  FrameRow row(arguments, scene, steps);
  const mesh::TetMesh* first = scene.mesh;
  mesh::Import imported;
  project::SceneProjector projector(scene, plan, report.stats);
  for (int step = 0; step < steps; ++step) {
    if (step > 0) {
      imported = import_step(arguments, step);
      report.import.read_ms += imported.report.read_ms;
      report.import.decompose_ms += imported.report.decompose_ms;
      scene.field = select_scalar_of(arguments.input, imported.mesh, arguments.field);
      scene.drawable = mesh::find_drawable(imported.mesh, scene.field);
    }
    const base::Stopwatch clock;
    // Most often the steps share one mesh: what depends on it is set up once.
    const bool same =
        step == 0 || (imported.mesh.points == first->points && imported.mesh.cells == first->cells);
    if (!same) scene.mesh = &imported.mesh;
    if (same && step > 0) projector.update(report.stats);
    const project::Image picture =
        same ? projector.draw(report.stats) : project::render(scene, plan, report.stats);
    scene.mesh = first;
    row.add(picture, scene.camera, clock.milliseconds(), report);
  }
  return row.finish();
}

}  // namespace tetraglass::apps
