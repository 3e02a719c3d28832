#include "project/slices/slab_switches.h"

#include <array>

#include "project/gl/switches.h"

namespace tetraglass::project::slices {
namespace {

void add_stack(const SlicesPlan& slices, bool parallel, std::optional<int> layers,
               std::vector<std::string>& names) {
  if (layers) {
    constexpr std::array<const char*, 3> kPlanes = {"PLANE yz", "PLANE xz", "PLANE xy"};
    constexpr std::array<const char*, 3> kLayers = {"LAYER x", "LAYER y", "LAYER z"};
    names.emplace_back(kPlanes[static_cast<std::size_t>(*layers)]);
    names.emplace_back(kLayers[static_cast<std::size_t>(*layers)]);
    names.push_back("SLAB_AXIS " + std::to_string(*layers));
  } else if (slices.stack == Stack::shells && !parallel) {
    names.emplace_back("SHELLS");
  }
}

void add_light(const Scene& scene, const Plan& plan, std::vector<std::string>& names) {
  if (scene.shading == Shading::none) return;
  names.emplace_back("SHADING_SMOOTH");
  if (scene.lights) names.emplace_back("LIGHTS");
  if (plan.light_map > 0) names.emplace_back("LIGHT_MAPS");
  if (gl::has_ramped_light(scene, plan)) names.emplace_back("RAMPED_LIGHT");
  if (gl::has_material_table(scene)) names.emplace_back("MATERIAL_TABLE");
  if (is_lit_medium(scene) && scene.shading == Shading::weighted) {
    names.emplace_back("WEIGHTED_NORMAL");
  }
  if (is_lit_medium(scene) && scene.shading == Shading::surface) {
    names.emplace_back("SURFACE_NORMAL");
  }
}

}  // namespace

bool is_uneven(const mesh::RectilinearGrid& grid) {
  return !(grid.even[0] && grid.even[1] && grid.even[2]);
}

bool has_gradients(const Scene& scene) {
  return scene.shading != Shading::none || scene.modulation;
}

bool slab_reads_medium(const Scene& scene, const Plan& plan) {
  return plan.slices.classify != Classify::pre && gl::reads_medium(scene, plan);
}

std::vector<std::string> slab_switches(const Scene& scene, const Plan& plan, bool parallel,
                                       std::optional<int> layers, bool blocks) {
  std::vector<std::string> names = {gl::mode_switch(scene)};
  const SlicesPlan& slices = plan.slices;
  if (parallel) names.emplace_back("PARALLEL");
  if (blocks) names.emplace_back("BLOCKS");
  add_stack(slices, parallel, layers, names);
  if (slices.filter == Filter::nearest) names.emplace_back("NEAREST");
  if (slices.classify == Classify::pre) names.emplace_back("PRE_CLASSIFIED");
  if (slices.classify == Classify::integrated) names.emplace_back("INTEGRATED");
  if (slices.classify == Classify::post) names.emplace_back("LINEAR");
  if (plan.integrator == Integrator::table2d) names.emplace_back("TABLE_2D");
  if (slab_reads_medium(scene, plan)) names.emplace_back("NEEDS_MEDIUM");
  if (gl::has_scalar_target(scene)) names.emplace_back("SCALAR_TARGET");
  if (is_uneven(*scene.grid)) names.emplace_back("UNEVEN");
  if (scene.modulation) names.emplace_back("MODULATED");
  if (has_gradients(scene) && scene.gradient == GradientOf::sobel) names.emplace_back("SOBEL");
  add_light(scene, plan, names);
  if (!scene.clip.empty()) names.push_back("CLIP_PLANES " + std::to_string(scene.clip.size()));
  return names;
}

}  // namespace tetraglass::project::slices
