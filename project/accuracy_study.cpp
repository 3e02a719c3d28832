#include "project/accuracy_study.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/errors.h"
#include "base/median.h"
#include "base/stopwatch.h"
#include "project/render.h"

namespace tetraglass::project {
namespace {

Request of_gl() {
  Request request;
  request.projector = Projector::gl;
  return request;
}

std::vector<StudyCase> projector_cases() {
  std::vector<StudyCase> cases;
  Request cpu;
  cpu.projector = Projector::cpu;
  cases.push_back({"projector", "cpu", cpu, {}});
  for (const double opacity : {0.9, 0.99, 0.999}) {
    cpu.opaque_at = opacity;
    cases.push_back({"opaque at", fmt::format("cpu, rays end at {}", opacity), cpu, {}});
  }
  cases.push_back({"projector", "gl", of_gl(), {}});
  return cases;
}

void add_integrators(const Scene& scene, bool all, std::vector<StudyCase>& cases) {
  Request request = of_gl();
  request.integrator = Integrator::linear;
  cases.push_back({"integrator", "gl, linear", request, {}});
  struct Size {
    int n;
    int m;
    bool always;
  };
  for (const Size& size : {Size{32, 16, true}, {64, 32, true}, {128, 64, true}, {256, 64, false}}) {
    if (!size.always && !all) continue;
    request.integrator = Integrator::table3d;
    request.table_n = size.n;
    request.table_m = size.m;
    cases.push_back({"integrator", fmt::format("gl, table3d {}x{}", size.n, size.m), request, {}});
  }
  request.table_m = 0;
  for (const int n : {64, 256, 1024}) {
    request.integrator = scene.mode == Mode::full ? Integrator::psi : Integrator::table2d;
    request.table_n = n;
    cases.push_back(
        {"integrator", fmt::format("gl, {} {}", to_string(*request.integrator), n), request, {}});
  }
}

void add_orders(std::vector<StudyCase>& cases) {
  for (const SortMethod sort : {SortMethod::centroid, SortMethod::power, SortMethod::fragments}) {
    Request request = of_gl();
    request.sort = sort;
    cases.push_back({"order", "gl, " + to_string(sort), request, {}});
  }
}

void add_layouts(std::vector<StudyCase>& cases) {
  struct Variant {
    const char* name;
    Layout layout;
    std::optional<bool> edge_fix;
    std::optional<Minimum> minimum;
  };
  for (const Variant& variant :
       {Variant{"strip", Layout::strip, {}, {}}, Variant{"faces12", Layout::faces12, {}, {}},
        Variant{"faces12, no edge fix", Layout::faces12, false, {}},
        Variant{"faces12, 16-bit minimum", Layout::faces12, {}, Minimum::texture16},
        Variant{"faces12, 8-bit minimum", Layout::faces12, {}, Minimum::texture8},
        Variant{"faces12-short", Layout::faces12_short, {}, {}}}) {
    Request request = of_gl();
    request.gl.layout = variant.layout;
    request.gl.edge_fix = variant.edge_fix;
    request.gl.minimum = variant.minimum;
    cases.push_back({"layout", std::string("gl, ") + variant.name, request, {}});
  }
}

void add_targets(std::vector<StudyCase>& cases) {
  for (const TargetFormat target : {TargetFormat::rgba16f, TargetFormat::rgba8}) {
    Request request = of_gl();
    request.gl.target = target;
    cases.push_back({"target", "gl, " + to_string(target), request, {}});
  }
}

void add_shadings(const Scene& scene, std::vector<StudyCase>& cases) {
  if (!is_lit_medium(scene)) return;
  for (const Shading shading : {Shading::none, Shading::flat, Shading::smooth, Shading::single,
                                Shading::weighted, Shading::interpolated, Shading::surface}) {
    if (shading == scene.shading || (shading == Shading::none && scene.lights)) continue;
    Request cpu;
    cpu.projector = Projector::cpu;
    cases.push_back({"shading", "cpu, " + to_string(shading), cpu, shading});
  }
}

void add_slices(const Scene& scene, bool all, std::vector<StudyCase>& cases) {
  if (!scene.grid) return;
  Request request;
  request.projector = Projector::slices;
  const auto add = [&](const std::string& name) {
    cases.push_back({"slices", "slices, " + name, request, {}});
  };
  for (const int slices : {64, 128, 256, 512, 1024}) {
    if (!all && slices != 64 && slices != 256) continue;
    request.slices.slices = slices;
    for (const Classify classify : {Classify::integrated, Classify::post}) {
      request.slices.classify = classify;
      add(fmt::format("{} {}", to_string(classify), slices));
    }
  }
  request.slices.slices = 256;
  request.slices.classify = Classify::integrated;
  request.slices.texels = TexelBits::bits8;
  add("integrated 256, 8 bits");
  request.slices.texels.reset();
  request.slices.stack = Stack::textures;
  request.slices.slices.reset();
  add("integrated, 2D textures");
}

bool is_possible(const Scene& scene, const StudyCase& one) {
  try {
    const Plan planned = plan(scene, one.request);
    // An order that the mode does not need is the picture without it.
    return one.knob != "order" || planned.sort != SortMethod::none;
  } catch (const base::UsageError&) {
    return false;
  }
}

struct Times {
  std::vector<double> set_up;
  std::vector<double> frame;
};

void draw_once(const Scene& study_scene, StudyPoint& point, Times& times) {
  try {
    std::optional<Scene> shaded;
    if (point.what.shading) {
      shaded = study_scene;
      shaded->shading = *point.what.shading;
    }
    const Scene& scene = shaded ? *shaded : study_scene;
    const Plan how = plan(scene, point.what.request);
    Stats stats;
    const base::Stopwatch clock;
    SceneProjector projector(scene, how, stats);
    point.image = projector.draw(stats);
    times.set_up.push_back(clock.milliseconds());
    const base::Stopwatch second;
    point.image = projector.draw(stats);
    times.frame.push_back(second.milliseconds());
  } catch (const base::Error& error) {  // no context, no memory: told in the table
    point.failure = error.what();
  }
}

/// The exact picture of the cells or of the grid, as a point without an error.
void add_reference(const Scene& scene, Projector projector, Study& study) {
  StudyPoint judge;
  judge.what.knob = "projector";
  judge.what.name = to_string(projector);
  judge.what.request.projector = projector;
  Stats stats;
  Scene lit;
  const bool all_along = !is_lit_medium(scene) || scene.shading == Shading::flat;
  if (!all_along) {
    lit = scene;
    lit.shading = Shading::smooth;
  }
  const Scene& judged = all_along ? scene : lit;
  judge.image = render(judged, plan(judged, judge.what.request), stats);
  judge.set_up_ms = judge.frame_ms = stats.project_ms;
  judge.error.psnr_db = std::numeric_limits<double>::infinity();
  judge.error.pixels = judge.image.rgba.size() / 4;
  study.points.push_back(std::move(judge));
}

}  // namespace

std::vector<StudyCase> study_cases(const Scene& scene, bool all) {
  std::vector<StudyCase> cases = projector_cases();
  // The cheap ones first: time may be short.
  add_slices(scene, all, cases);
  add_shadings(scene, cases);
  add_integrators(scene, all, cases);
  add_orders(cases);
  add_layouts(cases);
  add_targets(cases);
  std::erase_if(cases, [&](const StudyCase& one) { return !is_possible(scene, one); });
  return cases;
}

void mark_front(std::vector<StudyPoint>& points) {
  // What both projectors round a face to: smaller errors are chance.
  const auto error = [](const StudyPoint& point) { return std::max(point.error.max, 0x1p-20); };
  for (StudyPoint& point : points) {
    point.on_front =
        point.failure.empty() && std::none_of(points.begin(), points.end(), [&](const auto& other) {
          if (!other.failure.empty() || draws_grid(other.what) != draws_grid(point.what)) {
            return false;
          }
          const bool no_worse = other.frame_ms <= point.frame_ms && error(other) <= error(point);
          const bool better = other.frame_ms < point.frame_ms || error(other) < error(point);
          return no_worse && better;
        });
  }
}

Study study_accuracy(const Scene& scene, const std::vector<StudyCase>& cases,
                     const StudyLength& length, const std::function<void()>& step) {
  const base::Stopwatch clock;
  const auto is_over = [&] { return clock.milliseconds() > 1e3 * length.seconds; };
  Study study;
  study.points.reserve(cases.size() + 2);
  add_reference(scene, Projector::reference, study);
  study.reference = study.points.back().image;
  study.reference_ms = study.points.back().frame_ms;
  if (std::any_of(cases.begin(), cases.end(), [](const auto& one) { return draws_grid(one); })) {
    add_reference(scene, Projector::grid_reference, study);
    study.grid_reference = study.points.back().image;
  }
  const std::size_t references = study.points.size();
  for (const StudyCase& one : cases) {
    study.points.emplace_back();
    study.points.back().what = one;
  }
  std::vector<Times> times(cases.size());
  for (; study.rounds < length.rounds && (study.rounds == 0 || !is_over()); ++study.rounds) {
    for (std::size_t i = 0; i < cases.size(); ++i) {
      StudyPoint& point = study.points[references + i];
      if (times[i].frame.empty() && point.failure.empty() && i > 0 && is_over()) {
        point.failure = "not drawn: the time was up";
      }
      if (point.failure.empty() && (times[i].frame.empty() || !is_over())) {
        draw_once(scene, point, times[i]);
      }
      step();
    }
  }
  for (std::size_t i = 0; i < cases.size(); ++i) {
    StudyPoint& point = study.points[references + i];
    if (!point.failure.empty()) continue;
    point.set_up_ms = base::median(times[i].set_up);
    point.frame_ms = base::median(times[i].frame);
    point.error = compare(point.image, study.judge(point));
  }
  mark_front(study.points);
  return study;
}

}  // namespace tetraglass::project
