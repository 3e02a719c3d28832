#include "project/gl_plan.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/errors.h"

namespace tetraglass::project {
namespace {

void check_faces12(const Scene& scene, const GlRequest& request, const GlPlan& plan) {
  const std::string layout = to_string(plan.layout);
  if (has_faces12(plan.layout)) {
    if (scene.shading != Shading::none && !has_cell_normals(scene)) {
      throw base::UsageError(
          "--layout " + layout +
          " has one gradient per cell: use --gradient cell, or --layout indexed");
    }
    if (plan.interpolate_lengths && scene.camera.parallel) {
      throw base::UsageError("--perspective affine is for perspective views");
    }
    return;
  }
  if (request.edge_fix || request.minimum || request.interpolate_lengths) {
    throw base::UsageError(
        "--edge-fix, --minimum and --perspective are for --layout faces12 and faces12-short; "
        "--layout " +
        layout + " has no ray parameters to mend");
  }
}

// Lengths, optical depths and values of the field are accumulated as they are, not as colors.
bool accumulates_colors(const Scene& scene) {
  return scene.mode == Mode::full || scene.mode == Mode::emission || scene.mode == Mode::iso ||
         (scene.mode == Mode::mip && scene.mip_of == MipOf::transfer);
}

// As gl/view_uniforms.cpp moves rays that lie on edges.
double position_rounding(const Scene& scene) {
  const Frame frame = make_frame(scene);
  const mesh::Box box = mesh::bounds(*scene.mesh);
  if (box.isEmpty()) return 0;
  const double radius = (0.5 * box.max() - 0.5 * box.min()).stableNorm();
  const double distance =
      frame.parallel() ? 1
                       : std::max(radius, frame.to_camera(0.5 * box.min() + 0.5 * box.max()).z());
  return std::ldexp(radius / distance / frame.pitch(), -21);
}

}  // namespace

GlPlan plan_gl(const Scene& scene, const GlRequest& request, std::vector<std::string>& reasons) {
  GlPlan plan;
  plan.layout = request.layout.value_or(plan.layout);
  plan.edge_fix = request.edge_fix.value_or(plan.edge_fix);
  plan.minimum = request.minimum.value_or(plan.minimum);
  plan.interpolate_lengths = request.interpolate_lengths.value_or(plan.interpolate_lengths);
  plan.target = request.target.value_or(plan.target);
  plan.memory = request.memory.value_or(plan.memory);
  check_faces12(scene, request, plan);
  if (plan.target == TargetFormat::rgba8 && !accumulates_colors(scene)) {
    throw base::UsageError("--target-format rgba8 holds numbers from 0 to 1 only, and mode " +
                           to_string(scene.mode) + " accumulates others: use rgba32f or rgba16f");
  }
  reasons.push_back(
      "layout: " + to_string(plan.layout) +
      (has_faces12(plan.layout)
           ? fmt::format(
                 ", edge fix {}, minimum by {}{}", plan.edge_fix ? "on" : "off",
                 to_string(plan.minimum),
                 plan.interpolate_lengths ? ", lengths interpolated: wrong in perspective" : "")
           : ", planes of the faces in the fragment stage"));
  if (has_faces12(plan.layout) && !scene.camera.parallel) {
    reasons.emplace_back("layout: draws front faces, so a cell around the eye is not seen");
  }
  reasons.push_back("target: " + to_string(plan.target) +
                    (plan.target == TargetFormat::rgba32f ? "" : ", rounded at every cell"));
  if (plan.memory > 0) {
    reasons.push_back(
        fmt::format("memory: {} bytes of the mesh on the context at once; more of it is drawn in "
                    "parts, in the order of its cells",
                    plan.memory));
  }
  plan.position_rounding = position_rounding(scene);
  if (plan.position_rounding > kLargestPositionRounding) {
    reasons.push_back(
        fmt::format("precision: too low; seen so near, floats hold positions to {:.2g} pixels; the "
                    "cpu projector holds them to 1e-6",
                    plan.position_rounding));
  }
  return plan;
}

bool is_any_set(const GlRequest& request) {
  return request.layout || request.edge_fix || request.minimum || request.interpolate_lengths ||
         request.target || request.memory;
}

std::string to_string(Layout layout) {
  switch (layout) {
    case Layout::indexed:
      return "indexed";
    case Layout::strip:
      return "strip";
    case Layout::faces12:
      return "faces12";
    case Layout::faces12_short:
      return "faces12-short";
  }
  return "";
}

std::string to_string(Minimum minimum) {
  switch (minimum) {
    case Minimum::shader:
      return "shader";
    case Minimum::texture8:
      return "texture8";
    case Minimum::texture16:
      return "texture16";
  }
  return "";
}

std::string to_string(TargetFormat target) {
  switch (target) {
    case TargetFormat::rgba32f:
      return "rgba32f";
    case TargetFormat::rgba16f:
      return "rgba16f";
    case TargetFormat::rgba8:
      return "rgba8";
  }
  return "";
}

}  // namespace tetraglass::project
