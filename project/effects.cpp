#include "project/effects.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include <fmt/format.h>

#include "project/shown_cells.h"
#include "project/single_color.h"

namespace tetraglass::project {
namespace {

using preint::ControlPoint;

/// Nanoseconds on one core (see planned_effects), of a first frame.
struct Rates {
  double segment;     ///< to find it, and its length
  double values;      ///< ... and the field at its ends, and what the transfer function makes of it
  double lit_once;    ///< ... and one normal's light
  double lit;         ///< ... and light all along
  double ordered;     ///< ... and its place among those of its ray
  double fragments;   ///< ... by SortMethod::fragments
  double cell_order;  ///< to put a cell in order
};
constexpr Rates kCpu = {4.2, 7, 30, 145, 11, 11, 52};
constexpr Rates kGl = {45, 48, 0, 0, 65, 380, 550};

// The cpu projector's, for what it keeps of a mesh.
constexpr double kPointSetUp = 60;
constexpr double kCellSetUp = 110;
constexpr double kCellIntervals = 60;
constexpr double kCellGradient = 240;

bool is_surfaces(const Scene& scene) {
  return scene.mode == Mode::iso;
}

/// Counts the parts of a picture, as planned_effects explains.
class Census {
 public:
  Census(const Scene& scene, const Plan& plan, int threads)
      : scene_(scene),
        plan_(plan),
        is_cpu_(plan.projector == Projector::cpu),
        is_gl_(plan.projector == Projector::gl),
        rates_(is_cpu_ ? kCpu : kGl),
        threads_(std::max(1, threads)),
        cells_(draws_grid(plan.projector) ? scene.drawable.cells
                                          : shown_cells(scene, ValueScale(scene.field))) {
    count_segments();
  }

  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] const Plan& plan() const { return plan_; }
  [[nodiscard]] bool is_cpu() const { return is_cpu_; }
  [[nodiscard]] bool is_gl() const { return is_gl_; }
  [[nodiscard]] const Rates& rates() const { return rates_; }
  [[nodiscard]] std::size_t points() const { return scene_.mesh->points.size(); }
  [[nodiscard]] std::size_t cells() const { return cells_.size(); }
  [[nodiscard]] double segments() const { return segments_; }
  [[nodiscard]] std::size_t rays() const {
    const Frame frame = make_frame(scene_);
    return static_cast<std::size_t>(frame.width()) * static_cast<std::size_t>(frame.height());
  }

  /// By all threads; none where the machine is not known.
  [[nodiscard]] std::optional<double> milliseconds(double nanoseconds) const {
    const bool known = is_cpu_ || (is_gl_ && plan_.context == ContextKind::osmesa);
    if (!known) return std::nullopt;
    return nanoseconds * 1e-6 / threads_;
  }

 private:
  void count_segments() {
    const Frame frame = make_frame(scene_);
    for (const std::uint32_t number : cells_) {
      const mesh::Cell& cell = scene_.mesh->cells[number];
      std::array<Eigen::Vector3d, 4> p;
      for (std::size_t k = 0; k < 4; ++k) p[k] = scene_.mesh->points[cell[k]];
      segments_ += segments_of(frame, p);
    }
  }

  [[nodiscard]] static double segments_of(const Frame& frame,
                                          const std::array<Eigen::Vector3d, 4>& p) {
    const Eigen::Vector3d middle =
        frame.to_camera(0.25 * p[0] + 0.25 * p[1] + 0.25 * p[2] + 0.25 * p[3]);
    const double distance = frame.parallel() ? 1 : middle.z();
    if (!(distance > 0)) return 0;
    const Eigen::Vector2d pixel = frame.pixel(middle.head<2>() / distance);
    if (pixel.x() < -0.5 || pixel.y() < -0.5 || pixel.x() > frame.width() - 0.5 ||
        pixel.y() > frame.height() - 0.5) {
      return 0;
    }
    double twice_surface = 0;
    for (const auto& face : mesh::kFaceVertices) {
      const auto& a = p[static_cast<std::size_t>(face[0])];
      const auto& b = p[static_cast<std::size_t>(face[1])];
      const auto& c = p[static_cast<std::size_t>(face[2])];
      twice_surface += (b - a).cross(c - a).norm();
    }
    const double side = frame.pitch() * distance;
    const double all = static_cast<double>(frame.width()) * frame.height();
    return std::min(twice_surface / 8 / (side * side), all);
  }

  const Scene& scene_;
  const Plan& plan_;
  bool is_cpu_;
  bool is_gl_;
  Rates rates_;
  int threads_;
  std::vector<std::uint32_t> cells_;
  double segments_ = 0;
};

EffectPlan no(Effect effect, std::string why) {
  return {effect, false, std::move(why), std::nullopt, std::nullopt};
}
EffectPlan yes(Effect effect, std::string why, std::optional<std::size_t> bytes = std::nullopt,
               std::optional<double> ms = std::nullopt) {
  return {effect, true, std::move(why), bytes, ms};
}

EffectPlan cells(const Census& census) {
  const Scene& scene = census.scene();
  if (draws_grid(census.plan().projector)) {
    return no(Effect::cells, "the points of the grid are drawn, not cells");
  }
  const std::size_t all = scene.mesh->cells.size();
  const std::string why = census.cells() == all
                              ? fmt::format("all {} cells can show something", all)
                              : fmt::format(
                                    "{} of {} cells can show something; the others are "
                                    "skipped",
                                    census.cells(), all);
  const bool of_points = scene.field.location == mesh::Location::point;
  std::optional<std::size_t> bytes;
  if (census.is_cpu()) {
    // A cell, its number, its place in another order and its value; a point in doubles and in
    // floats, and its value.
    const std::size_t place = is_field_maximum(scene) ? 4 : 0;
    bytes = census.cells() * (32 + 4 + place + (of_points ? 0 : 4)) +
            census.points() * (32 + 16 + (of_points ? 4 : 0));
  } else if (census.is_gl() && has_faces12(census.plan().gl.layout)) {
    bytes = census.cells() * faces12_bytes(census.plan().gl.layout);
  } else if (census.is_gl()) {
    bytes = all * (16 + (of_points ? 0 : 4)) + census.points() * 16;
  }
  if (census.is_gl() && census.plan().gl.memory > 0) {
    bytes = std::min(*bytes, census.plan().gl.memory);
  }
  std::optional<double> ms;
  if (census.is_cpu()) {
    ms = census.milliseconds(kPointSetUp * static_cast<double>(census.points()) +
                             kCellSetUp * static_cast<double>(census.cells()));
  }
  return yes(Effect::cells, why, bytes, ms);
}

EffectPlan segments(const Census& census) {
  const Scene& scene = census.scene();
  const Rates& rates = census.rates();
  double each = rates.segment;
  if (scene.mode != Mode::thickness) each += rates.values;
  if (is_lit_medium(scene)) {
    const bool all_along = scene.shading == Shading::flat || scene.shading == Shading::smooth;
    each += all_along ? rates.lit : rates.lit_once;
  }
  if (census.plan().sort != SortMethod::none) {
    each += census.plan().sort == SortMethod::fragments ? rates.fragments : rates.ordered;
  }
  if (draws_grid(census.plan().projector)) {
    return yes(Effect::segments, "of rays between the grid's planes or slabs");
  }
  return yes(Effect::segments,
             fmt::format("about {:.3g}, of {} rays", census.segments(), census.rays()),
             std::nullopt, census.milliseconds(each * census.segments()));
}

EffectPlan medium(const Census& census) {
  const Scene& scene = census.scene();
  if (scene.mode == Mode::thickness) {
    return no(Effect::medium, "lengths have no color");
  }
  if (is_surfaces(scene)) return no(Effect::medium, "surfaces have colors of their own");
  const std::size_t intervals = scene.transfer_function.points().size() + 1;
  const std::string why =
      is_field_maximum(scene)
          ? "the color of one value a ray"
          : fmt::format("{} control points", scene.transfer_function.points().size());
  if (census.is_cpu()) {
    const std::size_t cells = is_field_maximum(scene) ? 0 : census.cells();
    return yes(Effect::medium, why, 48 * intervals + 8 * cells,
               census.milliseconds(kCellIntervals * static_cast<double>(cells)));
  }
  return yes(Effect::medium, why);
}

EffectPlan table(const Census& census) {
  const Plan& plan = census.plan();
  if (plan.table_n == 0) return no(Effect::table, "every segment is integrated in closed form");
  const auto n = static_cast<std::size_t>(plan.table_n);
  const auto m = static_cast<std::size_t>(std::max(1, plan.table_m));
  const std::size_t texel = plan.integrator == Integrator::psi ? 4 : 16;
  return yes(Effect::table, fmt::format("--integrator {}", to_string(plan.integrator)),
             n * n * m * texel);
}

EffectPlan attenuation(const Census& census) {
  const Scene& scene = census.scene();
  switch (scene.mode) {
    case Mode::full:
      break;
    case Mode::absorption:
      return yes(Effect::attenuation, "the optical depth is what is shown");
    case Mode::emission:
      return no(Effect::attenuation, "mode emission: light is added up");
    case Mode::mip:
      return no(Effect::attenuation, "mode mip: the largest counts");
    case Mode::thickness:
      return no(Effect::attenuation, "mode thickness: lengths are added up");
    case Mode::iso:
      return no(Effect::attenuation, "nothing lies between the surfaces");
  }
  if (census.cells() == 0) return no(Effect::attenuation, "no extinction anywhere");
  return yes(Effect::attenuation, "mode full: what lies in front takes light");
}

EffectPlan order(const Census& census) {
  const Scene& scene = census.scene();
  const Plan& plan = census.plan();
  if (plan.sort == SortMethod::none) {
    return no(Effect::order, draws_grid(plan.projector) ? "the slabs of a grid are in order"
                                                        : "the picture does not depend on it");
  }
  std::optional<double> ms;
  if (census.is_cpu() || plan.sort != SortMethod::fragments) {
    const std::size_t sorted = census.is_cpu() ? census.cells() : scene.drawable.cells.size();
    ms = census.milliseconds(census.rates().cell_order * static_cast<double>(sorted));
  }
  return yes(Effect::order, fmt::format("{}: what lies in front hides", to_string(plan.sort)),
             std::nullopt, ms);
}

EffectPlan blending(const Census& census) {
  const Scene& scene = census.scene();
  const bool translucent =
      scene.mode == Mode::full || (is_surfaces(scene) && !is_commutative(scene));
  if (!translucent) {
    return no(Effect::blending, is_surfaces(scene) ? "the surfaces are opaque: the nearest is seen"
                                                   : "mode " + to_string(scene.mode));
  }
  if (single_color(scene)) return no(Effect::blending, "one color: optical depths are added up");
  return yes(Effect::blending, is_surfaces(scene) ? "translucent surfaces" : "translucent medium");
}

EffectPlan rays(const Census& census) {
  if (census.scene().camera.parallel) {
    return no(Effect::rays, "parallel view: all rays have one direction");
  }
  return yes(Effect::rays, "perspective view: each ray has its own direction");
}

EffectPlan gradients(const Census& census) {
  const Scene& scene = census.scene();
  if (!census.plan().gradients) return no(Effect::gradients, "nothing is lit");
  const bool of_cells = has_cell_normals(scene);
  const std::size_t count = of_cells ? census.cells() : census.points();
  std::optional<std::size_t> bytes;
  if (census.is_cpu()) bytes = count * 24;
  if (census.is_gl() && !of_cells) bytes = count * 16;
  return yes(
      Effect::gradients,
      fmt::format("shading {}, one per {}", to_string(scene.shading), of_cells ? "cell" : "vertex"),
      bytes, census.milliseconds(kCellGradient * static_cast<double>(scene.mesh->cells.size())));
}

EffectPlan lights(const Scene& scene) {
  if (scene.shading == Shading::none) return no(Effect::lights, "nothing is lit");
  if (!scene.lights) return no(Effect::lights, "a headlight needs only the angle to the viewer");
  return yes(Effect::lights, fmt::format("{} given", scene.lights->lights.size()));
}

EffectPlan materials(const Scene& scene) {
  if (scene.shading == Shading::none) return no(Effect::materials, "nothing is lit");
  if (is_surfaces(scene)) return no(Effect::materials, "each surface has one");
  const std::size_t intervals = scene.transfer_function.points().size() + 1;
  return yes(Effect::materials, "coefficients of light by the value", 32 * intervals);
}

EffectPlan modulation(const Census& census) {
  if (!census.scene().modulation) return no(Effect::modulation, "no --modulate");
  return yes(Effect::modulation, "opacity by the gradient of each cell", 4 * census.cells());
}

EffectPlan opaque(const Scene& scene) {
  if (scene.opaque.empty()) return no(Effect::opaque, "nothing among the volume");
  return yes(Effect::opaque, fmt::format("{} lines and {} surfaces, where rays end",
                                         scene.opaque.lines.size(), scene.opaque.surfaces.size()));
}

EffectPlan samples(const Census& census) {
  const Scene& scene = census.scene();
  if (scene.samples == 1) return no(Effect::samples, "one ray a pixel");
  return yes(Effect::samples, fmt::format("{0} x {0} rays a pixel", scene.samples),
             16 * census.rays());
}

std::string text(const std::optional<std::size_t>& bytes) {
  if (!bytes) return "";
  if (*bytes < 10000) return fmt::format("{} B", *bytes);
  if (*bytes < 10000000) return fmt::format("{:.0f} kB", static_cast<double>(*bytes) * 1e-3);
  return fmt::format("{:.0f} MB", static_cast<double>(*bytes) * 1e-6);
}

std::string text(const std::optional<double>& ms) {
  if (!ms) return "";
  return *ms < 10 ? fmt::format("{:.1f}", *ms) : fmt::format("{:.0f}", *ms);
}

}  // namespace

std::vector<EffectPlan> planned_effects(const Scene& scene, const Plan& plan, int threads) {
  const Census census(scene, plan, threads);
  const EffectPlan clipping =
      scene.clip.empty() ? no(Effect::clipping, "no --clip")
                         : yes(Effect::clipping, fmt::format("{} planes", scene.clip.size()));
  const EffectPlan depth_cue = scene.depth_cue
                                   ? yes(Effect::depth_cue, "surfaces fade with the distance")
                                   : no(Effect::depth_cue, "no --depth-cue");
  return {
      cells(census),    segments(census),   medium(census), table(census),     attenuation(census),
      order(census),    blending(census),   rays(census),   gradients(census), lights(scene),
      materials(scene), modulation(census), clipping,       depth_cue,         opaque(scene),
      samples(census)};
}

std::string effects_table(const std::vector<EffectPlan>& effects, const Stats* stats) {
  std::string result = fmt::format("{:<18}{:<5}{:>10}{:>9}", "effect", "", "expected", "ms");
  if (stats != nullptr) result += fmt::format("{:>10}{:>9}", "measured", "ms");
  result += "  why, or why not\n";
  for (const EffectPlan& effect : effects) {
    result += fmt::format("{:<18}{:<5}{:>10}{:>9}", to_string(effect.effect),
                          effect.needed ? "yes" : "no", text(effect.bytes), text(effect.ms));
    if (stats != nullptr) {
      const auto work = stats->work.find(effect.effect);
      const bool done = work != stats->work.end();
      result +=
          fmt::format("{:>10}{:>9}",
                      done && work->second.bytes > 0 ? text(std::optional(work->second.bytes)) : "",
                      done && work->second.ms > 0 ? text(std::optional(work->second.ms)) : "");
    }
    result += "  " + effect.why + "\n";
  }
  return result;
}

}  // namespace tetraglass::project
