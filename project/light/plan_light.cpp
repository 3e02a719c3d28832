#include "project/light/plan_light.h"

#include <array>
#include <vector>

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

using Coefficients = std::array<double, 4>;

Coefficients coefficients(const preint::Material& m) {
  return {m.ambient, m.diffuse, m.specular, m.shininess};
}

/// A table of isosurfaces does not tell which surface was met.
void check_materials_of_surfaces(const Scene& scene) {
  const auto of = [&](const preint::Isosurface& surface) {
    return coefficients(scene.transfer_function.material_at(surface.value));
  };
  for (const preint::Isosurface& surface : scene.isosurfaces) {
    if (of(surface) != of(scene.isosurfaces[0])) {
      throw base::UsageError(
          "--integrator table2d has one material for all isosurfaces, and the transfer function "
          "gives them several: use --integrator exact");
    }
  }
}

/// Projectors on OpenGL light each segment or slab of a medium once.
void check_medium_of_gl(const Scene& scene, const Plan& plan) {
  const std::string name = "--projector " + to_string(plan.projector);
  if (scene.shading != Shading::single) {
    throw base::UsageError(
        name +
        " lights the segments of a medium once each: use --shading single, or --projector cpu");
  }
  const std::vector<preint::ControlPoint>& points = scene.transfer_function.points();
  for (const preint::ControlPoint& point : points) {
    if (coefficients(point.material) != coefficients(points[0].material)) {
      throw base::UsageError(
          name +
          " has one material for a medium, and the transfer function has several: use "
          "--projector cpu");
    }
  }
  if (plan.projector == Projector::slices && plan.slices.classify == Classify::pre) {
    throw base::UsageError(
        "--classify pre has colors without values: light needs post or integrated");
  }
}

void check_projector(const Scene& scene, const Plan& plan) {
  if (plan.projector == Projector::cpu || plan.projector == Projector::reference) return;
  if (scene.modulation) {
    throw base::UsageError("--projector " + to_string(plan.projector) +
                           " has no --modulate; use --projector cpu");
  }
  if (is_lit_medium(scene) && plan.projector != Projector::grid_reference) {
    check_medium_of_gl(scene, plan);
  }
}

}  // namespace

void plan_light(const Scene& scene, Plan& plan) {
  check_scene(scene);
  check_projector(scene, plan);
  if (scene.shading != Shading::none && plan.integrator == Integrator::table2d)
    check_materials_of_surfaces(scene);
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
