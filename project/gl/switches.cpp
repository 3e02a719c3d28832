#include "project/gl/switches.h"

#include "project/light/plan_light.h"

namespace tetraglass::project::gl {
namespace {

// The gradient of a field that is constant in each cell is 0: nothing of it is lit.
bool is_lit(const Scene& scene) {
  return scene.shading != Shading::none && scene.field.location == mesh::Location::point;
}

}  // namespace

const char* mode_switch(const Scene& scene) {
  switch (scene.mode) {
    case Mode::full:
      return "MODE_FULL";
    case Mode::emission:
      return "MODE_EMISSION";
    case Mode::absorption:
      return "MODE_ABSORPTION";
    case Mode::mip:
      return scene.mip_of == MipOf::transfer ? "MODE_MIP_TRANSFER" : "MODE_MIP_FIELD";
    case Mode::iso:
      return "MODE_ISO";
    case Mode::thickness:
      return "MODE_THICKNESS";
  }
  return "";
}

bool draws_opaque_surfaces(const Scene& scene) {
  return scene.mode == Mode::iso && is_commutative(scene);
}

bool has_scalar_target(const Scene& scene) {
  return scene.mode == Mode::thickness || scene.mode == Mode::absorption || is_field_maximum(scene);
}

bool reads_medium(const Scene& scene, const Plan& plan) {
  const bool tabulated =
      plan.integrator == Integrator::table2d || plan.integrator == Integrator::table3d;
  return !tabulated && scene.mode != Mode::thickness && scene.mode != Mode::iso &&
         !is_field_maximum(scene);
}

bool has_ramped_light(const Scene& scene, const Plan& plan) {
  return is_lit_medium(scene) && is_lit(scene) && scene.shading == Shading::interpolated &&
         (plan.integrator == Integrator::table3d || plan.integrator == Integrator::table2d);
}

bool has_material_table(const Scene& scene) {
  if (!is_lit_medium(scene) || !is_lit(scene)) return false;
  return scene.shading == Shading::weighted || !has_one_material(scene.transfer_function);
}

std::vector<std::string> shader_switches(const Scene& scene, const Plan& plan, bool parallel) {
  std::vector<std::string> names = {mode_switch(scene)};
  if (parallel) names.emplace_back("PARALLEL");
  if (has_scalar_target(scene)) names.emplace_back("SCALAR_TARGET");
  if (scene.mode != Mode::thickness) {
    names.emplace_back(scene.field.location == mesh::Location::cell ? "CELL_FIELD" : "VALUES");
  }
  if (reads_medium(scene, plan)) names.emplace_back("NEEDS_MEDIUM");
  if (!scene.clip.empty()) {
    names.push_back("CLIP_PLANES " + std::to_string(scene.clip.size()));
  }
  if (plan.integrator == Integrator::table2d) names.emplace_back("TABLE_2D");
  if (plan.integrator == Integrator::table3d) names.emplace_back("TABLE_3D");
  if (plan.integrator == Integrator::psi) names.emplace_back("PSI");
  if (plan.integrator == Integrator::linear) names.emplace_back("LINEAR");
  if (scene.mode == Mode::iso) {
    if (draws_opaque_surfaces(scene)) names.emplace_back("OPAQUE");
    if (scene.depth_cue) names.emplace_back("DEPTH_CUE");
  }
  if (scene.modulation) names.emplace_back("MODULATED");
  if (is_lit(scene)) {
    names.emplace_back(has_cell_normals(scene) ? "SHADING_FLAT" : "SHADING_SMOOTH");
    if (scene.lights) names.emplace_back("LIGHTS");
    if (has_ramped_light(scene, plan)) names.emplace_back("RAMPED_LIGHT");
    if (has_material_table(scene)) names.emplace_back("MATERIAL_TABLE");
    if (is_lit_medium(scene) && scene.shading == Shading::weighted) {
      names.emplace_back("WEIGHTED_NORMAL");
    }
    if (is_lit_medium(scene) && scene.shading == Shading::surface) {
      names.emplace_back("SURFACE_NORMAL");
    }
    if (plan.light_map > 0) names.emplace_back("LIGHT_MAPS");
  }
  return names;
}

}  // namespace tetraglass::project::gl
