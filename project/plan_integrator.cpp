#include "project/plan_integrator.h"

#include <string>

#include <fmt/format.h>

#include "base/errors.h"

namespace tetraglass::project {
namespace {

// A 2D table of this size costs a few milliseconds, a 3D one about a second by brute force.
constexpr int kTable2dSize = 512;
constexpr int kTable3dSize = 128;
constexpr int kTable3dLengths = 64;

// The largest a texture may be on every context that is supported (OSMesa: 3D textures to 2048).
constexpr int kLargestTable2d = 8192;
constexpr int kLargestTable3d = 512;

bool needs_integral(const Scene& scene) {
  return !is_field_maximum(scene) && scene.mode != Mode::thickness;
}

/// That the projector has another integrator than the exact one.
void check_projector(const Scene& scene, const Plan& plan) {
  const std::string integrator = "--integrator " + to_string(plan.integrator);
  if (plan.projector == Projector::gl) return;
  if (plan.projector != Projector::cpu) {
    throw base::UsageError(
        fmt::format("the {} projector integrates exactly; {} needs --projector cpu or gl",
                    to_string(plan.projector), integrator));
  }
  if (scene.mode == Mode::iso) {
    throw base::UsageError("isosurfaces of the cpu projector have no table: use --projector gl");
  }
  if (is_lit_medium(scene) || scene.modulation) {
    throw base::UsageError(
        fmt::format("the cpu projector integrates a medium that is lit or "
                    "modulated exactly: leave out {}",
                    integrator));
  }
}

void plan_linear(const Scene& scene, const Request& request, Plan& plan) {
  if (scene.mode == Mode::iso || scene.mode == Mode::mip) {
    throw base::UsageError("--integrator linear is for the modes full, emission and absorption");
  }
  if (request.table_n != 0) throw base::UsageError("--integrator linear has no table");
  plan.reasons.emplace_back(
      "integrator: linear, from the ends of a segment alone: misses what lies between");
}

void plan_psi(const Scene& scene, const Request& request, Plan& plan) {
  if (scene.mode != Mode::full) throw base::UsageError("--integrator psi is for mode full");
  plan.table_n = request.table_n != 0 ? request.table_n : kTable2dSize;
  if (plan.table_n < 2 || plan.table_n > kLargestTable2d || request.table_m != 0) {
    throw base::UsageError(
        fmt::format("--integrator psi has a table of N x N, N from 2 to {}", kLargestTable2d));
  }
  plan.reasons.push_back(fmt::format(
      "integrator: psi, a table of {0} x {0} optical depths for every transfer function",
      plan.table_n));
}

void plan_slab_table(const Scene& scene, const Request& request, Plan& plan) {
  if (plan.integrator != Integrator::table2d || scene.mode != Mode::full ||
      plan.slices.classify != Classify::integrated) {
    throw base::UsageError(
        "slices have --integrator table2d for --mode full and --classify integrated; else leave "
        "out --integrator");
  }
  plan.table_n = request.table_n != 0 ? request.table_n : kTable2dSize;
  if (plan.table_n < 2 || plan.table_n > kLargestTable2d || request.table_m != 0) {
    throw base::UsageError(
        fmt::format("slices have a table of N values, N from 2 to {}", kLargestTable2d));
  }
  plan.reasons.push_back(fmt::format(
      "integrator: table of {0} x {0} values, of slabs of one length; that of others is corrected",
      plan.table_n));
}

/// lum2004's light comes from tables of segments, in OpenGL.
Integrator default_integrator(const Scene& scene, const Plan& plan) {
  if (!is_lit_medium(scene) || scene.shading != Shading::interpolated ||
      scene.field.location != mesh::Location::point) {
    return Integrator::exact;
  }
  if (plan.projector == Projector::gl) return Integrator::table3d;
  const bool slabs =
      plan.projector == Projector::slices && plan.slices.classify == Classify::integrated;
  return slabs ? Integrator::table2d : Integrator::exact;
}

}  // namespace

void plan_integrator(const Scene& scene, const Request& request, Plan& plan) {
  if (!needs_integral(scene)) {
    if (request.integrator && *request.integrator != Integrator::exact) {
      throw base::UsageError(
          fmt::format("mode {} integrates no transfer function: --integrator {} has nothing to do",
                      to_string(scene.mode), to_string(*request.integrator)));
    }
    plan.reasons.push_back("integrator: none needed for mode " + to_string(scene.mode));
    return;
  }
  plan.integrator = request.integrator.value_or(default_integrator(scene, plan));
  if (plan.integrator == Integrator::exact) {
    if (request.table_n != 0)
      throw base::UsageError("--table needs --integrator table2d or table3d");
    plan.reasons.emplace_back("integrator: exact per segment, no table");
    return;
  }
  if (plan.projector == Projector::slices) {
    plan_slab_table(scene, request, plan);
    return;
  }
  check_projector(scene, plan);
  if (scene.field.min == scene.field.max && scene.mode != Mode::iso) {
    plan.integrator = Integrator::exact;
    plan.reasons.emplace_back("integrator: exact, no table: the field is constant");
    return;
  }
  if (plan.integrator == Integrator::linear) {
    plan_linear(scene, request, plan);
    return;
  }
  if (plan.integrator == Integrator::psi) {
    plan_psi(scene, request, plan);
    return;
  }
  const bool wants_3d = scene.mode == Mode::full;
  if (wants_3d != (plan.integrator == Integrator::table3d)) {
    throw base::UsageError(fmt::format(
        "mode {} has a {} table: use --integrator {}", to_string(scene.mode),
        wants_3d ? "three-dimensional" : "two-dimensional", wants_3d ? "table3d" : "table2d"));
  }
  plan.table_n = request.table_n != 0 ? request.table_n : (wants_3d ? kTable3dSize : kTable2dSize);
  if (wants_3d) plan.table_m = request.table_m != 0 ? request.table_m : kTable3dLengths;
  const int largest = wants_3d ? kLargestTable3d : kLargestTable2d;
  if (plan.table_n < 2 || plan.table_n > largest ||
      (wants_3d && (plan.table_m < 2 || plan.table_m > largest))) {
    throw base::UsageError(fmt::format("--table sizes must lie between 2 and {} here", largest));
  }
  plan.reasons.push_back(wants_3d
                             ? fmt::format("integrator: table of {0} x {0} values x {1} lengths",
                                           plan.table_n, plan.table_m)
                             : fmt::format("integrator: table of {0} x {0} values", plan.table_n));
}

}  // namespace tetraglass::project
