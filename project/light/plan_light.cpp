#include "project/light/plan_light.h"

#include <array>

#include <fmt/format.h>

#include "base/errors.h"

namespace tetraglass::project {
namespace {

bool is_flat_or_smooth(Shading shading) {
  return shading == Shading::none || shading == Shading::flat || shading == Shading::smooth;
}

void check_scene(const Scene& scene) {
  if (scene.mode == Mode::iso && !is_flat_or_smooth(scene.shading)) {
    throw base::UsageError("--shading " + to_string(scene.shading) +
                           " is for --mode full; isosurfaces have none, flat and smooth");
  }
  if (scene.mode != Mode::iso && scene.mode != Mode::full && scene.shading != Shading::none) {
    throw base::UsageError("--shading " + to_string(scene.shading) +
                           " is for --mode iso and full: mode " + to_string(scene.mode) +
                           " is not lit");
  }
  if (scene.lights && scene.shading == Shading::none) {
    throw base::UsageError("--lights light what is shaded: add --shading smooth");
  }
  if (scene.modulation &&
      (scene.mode == Mode::iso || scene.mode == Mode::mip || scene.mode == Mode::thickness)) {
    throw base::UsageError("--modulate is for the modes full, emission and absorption");
  }
}

/// A table of isosurfaces does not tell which surface was met.
void check_materials(const Scene& scene) {
  const auto coefficients = [&](const preint::Isosurface& surface) {
    const preint::Material m = scene.transfer_function.material_at(surface.value);
    return std::array{m.ambient, m.diffuse, m.specular, m.shininess};
  };
  for (const preint::Isosurface& surface : scene.isosurfaces) {
    if (coefficients(surface) != coefficients(scene.isosurfaces[0])) {
      throw base::UsageError(
          "--integrator table2d has one material for all isosurfaces, and the transfer function "
          "gives them several: use --integrator exact");
    }
  }
}

void check_projector(const Scene& scene, Projector projector) {
  if (projector == Projector::cpu || projector == Projector::reference) return;
  const std::string name = "--projector " + to_string(projector);
  if (is_lit_medium(scene)) {
    throw base::UsageError(name + " lights isosurfaces only; use --projector cpu");
  }
  if (scene.modulation) {
    throw base::UsageError(name + " has no --modulate; use --projector cpu");
  }
  if (scene.lights && projector == Projector::slices) {
    throw base::UsageError(name + " has a headlight only; use --projector cpu for --lights");
  }
}

}  // namespace

void plan_light(const Scene& scene, Plan& plan) {
  check_scene(scene);
  check_projector(scene, plan.projector);
  if (scene.shading != Shading::none && plan.integrator == Integrator::table2d)
    check_materials(scene);
  plan.gradients = scene.shading != Shading::none;
  if (!plan.gradients) {
    plan.reasons.emplace_back("shading: none, no gradients stored");
    return;
  }
  const std::string lights =
      scene.lights ? fmt::format("{} lights", scene.lights->lights.size()) : "a headlight";
  plan.reasons.push_back(fmt::format("shading: {} by {}, one gradient per {}",
                                     to_string(scene.shading), lights,
                                     draws_grid(plan.projector) ? "point of the grid"
                                     : has_cell_normals(scene)  ? "cell"
                                                                : "vertex"));
}

}  // namespace tetraglass::project
