#include "project/plan.h"

#include <fmt/format.h>

#include "base/errors.h"
#include "project/light/plan_light.h"
#include "project/plan_integrator.h"

namespace tetraglass::project {
namespace {

// Behind this opacity lies less than 2e-5 of any color.
constexpr double kOpaqueAt = 0.99998;

std::string why_commutative(const Scene& scene) {
  if (scene.mode == Mode::iso) return "the nearest of opaque surfaces is found without";
  if (scene.mode == Mode::full) return "all light has one color: only the optical depth matters";
  return "mode " + to_string(scene.mode) + " does not depend on it";
}

[[noreturn]] void throw_unsorted(const Scene& scene) {
  throw base::UsageError(
      "mode " + to_string(scene.mode) +
      " depends on the order of the cells: --sort none would draw a wrong "
      "picture; use --sort mpvo, or a mode that needs no order (emission, mip, ...)");
}

std::string guarantee(SortMethod sort) {
  switch (sort) {
    case SortMethod::centroid:
      return "approximate";
    case SortMethod::power:
      return "exact";
    default:
      return "exact unless cells hide each other in a ring";
  }
}

void plan_order_of_cpu(const Scene& scene, const Request& request, Plan& plan) {
  const bool blends = scene.mode == Mode::full || scene.mode == Mode::iso;
  if (!blends && request.sort && *request.sort != SortMethod::none) {
    throw base::UsageError(fmt::format("mode {} needs no order: leave out --sort {}",
                                       to_string(scene.mode), to_string(*request.sort)));
  }
  if (request.opaque_at && !(*request.opaque_at > 0 && *request.opaque_at <= 1)) {
    throw base::UsageError("--opaque-at needs an opacity above 0 and at most 1");
  }
  // A table of colors is looked up color by color: the media differ.
  const bool tabled = scene.mode == Mode::full &&
                      request.integrator.value_or(Integrator::exact) != Integrator::exact;
  const bool commutative = is_commutative(scene) && !tabled;
  if (!commutative && request.sort == SortMethod::none) throw_unsorted(scene);
  const bool by_cells =
      request.sort && *request.sort != SortMethod::none && *request.sort != SortMethod::fragments;
  if (commutative && !by_cells) {
    plan.sort = SortMethod::none;
    plan.reasons.push_back("order: none, " + why_commutative(scene));
    return;
  }
  plan.sort = request.sort.value_or(SortMethod::fragments);
  plan.opaque_at = request.opaque_at.value_or(kOpaqueAt);
  plan.reasons.push_back(fmt::format("order: {}; rays end at an opacity of {}",
                                     plan.sort == SortMethod::fragments
                                         ? "fragments, exact at every pixel"
                                         : to_string(plan.sort) + ", " + guarantee(plan.sort),
                                     plan.opaque_at));
}

void plan_order(const Scene& scene, const Request& request, Plan& plan) {
  if (draws_grid(plan.projector)) {
    if (request.sort)
      throw base::UsageError("grids are drawn in order by themselves: leave out --sort");
    return;
  }
  if (plan.projector == Projector::reference) {
    if (request.sort && *request.sort != SortMethod::fragments) {
      throw base::UsageError(
          "the reference projector has one order only, exact at every pixel; leave out --sort " +
          to_string(*request.sort) + " or use --projector gl");
    }
    plan.sort = SortMethod::fragments;
    plan.reasons.emplace_back("order: fragments, exact at every pixel (reference)");
    return;
  }
  if (plan.projector == Projector::cpu) {
    plan_order_of_cpu(scene, request, plan);
    return;
  }
  const bool commutative = is_commutative(scene);
  if (request.sort == SortMethod::fragments) {
    plan.sort = commutative ? SortMethod::none : SortMethod::fragments;
    plan.reasons.push_back(commutative
                               ? "order: none, " + why_commutative(scene)
                               : "order: fragments, sorted pixel by pixel: exact for every mesh");
    return;
  }
  if (!commutative && request.sort == SortMethod::none) throw_unsorted(scene);
  plan.sort = request.sort.value_or(commutative ? SortMethod::none : SortMethod::mpvo);
  if (plan.sort == SortMethod::none) {
    plan.reasons.push_back("order: none, " + why_commutative(scene));
    return;
  }
  // The layouts of 12 vertices would have to hold what the lists need in every frame.
  plan.fragments_in_cycles = !request.sort && !has_faces12(plan.gl.layout);
  plan.reasons.push_back(fmt::format(
      "order: {}, {}; mode {} {}", to_string(plan.sort),
      plan.fragments_in_cycles ? "exact; fragments where cells hide each other in a ring"
                               : guarantee(plan.sort),
      to_string(scene.mode),
      commutative ? "does not need it, it was asked for" : "blends cells back to front"));
}

/// That the trilinear field of a grid can be drawn.
void check_grid(const Scene& scene, Projector projector) {
  if (!scene.grid) {
    throw base::UsageError("--projector " + to_string(projector) +
                           " draws uniform and rectilinear grids; draw cells by --projector auto");
  }
  if (scene.field.location == mesh::Location::cell) {
    throw base::UsageError("field '" + scene.field.name +
                           "' is constant in each cell; --projector " + to_string(projector) +
                           " draws point fields: use --projector auto");
  }
  if (scene.drawable.nan > 0) {
    throw base::UsageError("field '" + scene.field.name +
                           "' has values that are not finite; --projector " + to_string(projector) +
                           " draws whole grids only: use --projector auto");
  }
  if (scene.shading == Shading::flat) {
    throw base::UsageError("--projector " + to_string(projector) +
                           " has no flat cells: use --shading smooth or none");
  }
}

/// Whether something is asked for that only the gl projector has.
bool needs_gl(const Scene& scene, const Request& request) {
  const bool tabled_surfaces = scene.mode == Mode::iso && request.integrator == Integrator::table2d;
  return request.context.has_value() || is_any_set(request.gl) || tabled_surfaces ||
         request.light_map != 0 || scene.depth_cue.has_value();
}

void check_depth_cue(const Scene& scene, Plan& plan) {
  if (!scene.depth_cue) return;
  if (scene.mode != Mode::iso) throw base::UsageError("--depth-cue is for --mode iso");
  if (plan.projector == Projector::cpu || draws_grid(plan.projector)) {
    throw base::UsageError("the " + to_string(plan.projector) +
                           " projector has no --depth-cue; use --projector gl");
  }
  plan.reasons.push_back(fmt::format("depth cue: surfaces fade to black from {:.6g} to {:.6g}",
                                     scene.depth_cue->near, scene.depth_cue->far));
}

void check_opaque(const Scene& scene, Plan& plan) {
  if (scene.opaque.empty()) return;
  if (scene.mode == Mode::thickness) {
    throw base::UsageError(
        "pictures of mode thickness hold lengths, not colors: --outline and --surface have no "
        "place "
        "in them");
  }
  if (draws_grid(plan.projector)) {
    throw base::UsageError("the " + to_string(plan.projector) +
                           " projector draws the grid alone, without --outline and --surface; use "
                           "--projector cpu, gl or reference");
  }
  plan.reasons.push_back(
      fmt::format("opaque geometry: {} lines and {} surfaces end the rays at their depth",
                  scene.opaque.lines.size(), scene.opaque.surfaces.size()));
}

void plan_projector(Plan& plan) {
  switch (plan.projector) {
    case Projector::gl:
      plan.reasons.emplace_back("projector: gl, cell projection in float");
      return;
    case Projector::reference:
      plan.reasons.emplace_back(
          "projector: reference, double precision, one ray at a time: slow, judges the others");
      return;
    case Projector::grid_reference:
      plan.reasons.emplace_back(
          "projector: grid-reference, the trilinear field in double precision, one ray at a time");
      return;
    case Projector::slices:
      plan.reasons.emplace_back("projector: slices, the trilinear field from textures, in float");
      return;
    case Projector::cpu:
      plan.reasons.emplace_back("projector: cpu, tiles and vectors, all threads, no GL");
      return;
  }
}

/// The context, and what only the projectors that draw with OpenGL know.
void plan_opengl(const Scene& scene, const Request& request, Plan& plan) {
  const bool gl = plan.projector == Projector::gl;
  const bool slices = plan.projector == Projector::slices;
  if (gl || slices) {
    plan.context = request.context.value_or(ContextKind::osmesa);
    plan.reasons.push_back("context: " + to_string(plan.context) +
                           (plan.context == ContextKind::egl
                                ? ", a GPU where there is one; needs no display"
                                : ", needs no display and no GPU"));
  } else if (request.context) {
    throw base::UsageError("--context is for --projector gl and slices");
  }
  if (gl) {
    plan.gl = plan_gl(scene, request.gl, plan.reasons);
  } else if (is_any_set(request.gl)) {
    throw base::UsageError(
        "--layout, --edge-fix, --minimum, --perspective and --target-format are for --projector "
        "gl");
  }
  if (slices) {
    plan.slices = plan_slices(scene, request.slices, plan.reasons);
  } else if (is_any_set(request.slices)) {
    throw base::UsageError(
        "--slices, --slice-distance, --stack, --filter, --texel-bits, --classify, "
        "--skip-empty, --compress and --brick are for --projector slices");
  }
}

}  // namespace

Plan plan(const Scene& scene, const Request& request) {
  Plan plan;
  plan.projector =
      request.projector.value_or(needs_gl(scene, request) ? Projector::gl : Projector::cpu);
  plan_projector(plan);
  if (draws_grid(plan.projector)) check_grid(scene, plan.projector);
  plan_opengl(scene, request, plan);
  if (!scene.clip.empty()) {
    plan.reasons.push_back(fmt::format("clip: cut at {} planes", scene.clip.size()));
  }
  check_opaque(scene, plan);
  check_depth_cue(scene, plan);
  if (scene.mode == Mode::iso && scene.field.location == mesh::Location::cell) {
    throw base::UsageError(
        "field '" + scene.field.name +
        "' is constant in each cell and has no isosurface; choose a point field (see 'info')");
  }
  if (request.opaque_at && plan.projector != Projector::cpu) {
    throw base::UsageError("--opaque-at is for --projector cpu");
  }
  if (scene.samples > 1) {
    plan.reasons.push_back(
        fmt::format("samples: {0} x {0} rays share a pixel evenly", scene.samples));
  }
  plan_order(scene, request, plan);
  plan_integrator(scene, request, plan);
  plan_light(scene, request.light_map, plan);
  return plan;
}

std::string to_string(Projector projector) {
  switch (projector) {
    case Projector::reference:
      return "reference";
    case Projector::grid_reference:
      return "grid-reference";
    case Projector::slices:
      return "slices";
    case Projector::gl:
      return "gl";
    case Projector::cpu:
      return "cpu";
  }
  return "";
}

std::string to_string(Integrator integrator) {
  switch (integrator) {
    case Integrator::exact:
      return "exact";
    case Integrator::table2d:
      return "table2d";
    case Integrator::table3d:
      return "table3d";
    case Integrator::psi:
      return "psi";
    case Integrator::linear:
      return "linear";
  }
  return "";
}

std::string to_string(ContextKind context) {
  switch (context) {
    case ContextKind::none:
      return "none";
    case ContextKind::osmesa:
      return "osmesa";
    case ContextKind::egl:
      return "egl";
  }
  return "";
}

}  // namespace tetraglass::project
