#include "project/light/plan_light.h"

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

#include <fmt/format.h>

#include "base/errors.h"
#include "project/light/light_maps.h"

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

/// Cube maps and the shaders have highlights of one shininess.
void check_shininess_of_medium(const Scene& scene, const Plan& plan) {
  const std::vector<preint::ControlPoint>& points = scene.transfer_function.points();
  for (const preint::ControlPoint& point : points) {
    if (point.material.shininess != points[0].material.shininess) {
      throw base::UsageError(
          fmt::format("--projector {} has one shininess for a medium, and the transfer function "
                      "has several: use --projector {}",
                      to_string(plan.projector),
                      plan.projector == Projector::slices ? "grid-reference" : "cpu"));
    }
  }
}

void check_medium_of_gl(const Scene& scene, const Plan& plan) {
  if (is_flat_or_smooth(scene.shading)) {
    throw base::UsageError(
        "--projector gl lights the segments of a medium once or at both of their ends: use "
        "--shading single, weighted, surface or interpolated, or --projector cpu");
  }
  check_shininess_of_medium(scene, plan);
  const bool is_constant = scene.field.min == scene.field.max;
  if (scene.shading == Shading::interpolated && plan.integrator != Integrator::table3d &&
      scene.field.location == mesh::Location::point && !is_constant) {
    throw base::UsageError(
        "--shading interpolated of --projector gl looks light up in tables: use --integrator "
        "table3d, or leave it out");
  }
}

void check_medium_of_slices(const Scene& scene, const Plan& plan) {
  if (is_flat_or_smooth(scene.shading)) {
    throw base::UsageError(
        "--projector slices lights the slabs of a medium once or at both of their sides: use "
        "--shading single, weighted, surface or interpolated, or --projector grid-reference");
  }
  if (plan.slices.classify == Classify::pre) {
    throw base::UsageError(
        "--classify pre has colors without values: light needs post or integrated");
  }
  if (scene.shading != Shading::single && plan.slices.classify == Classify::post) {
    throw base::UsageError("--shading " + to_string(scene.shading) +
                           " is of the values at both sides of a slab, --classify post of that in "
                           "the middle: use --classify integrated or --shading single");
  }
  check_shininess_of_medium(scene, plan);
  if (scene.shading == Shading::interpolated && plan.integrator != Integrator::table2d) {
    throw base::UsageError(
        "--shading interpolated of --projector slices looks light up in tables: use --integrator "
        "table2d, or leave it out");
  }
}

void check_light_map(const Scene& scene, int size, const Plan& plan) {
  if (plan.projector != Projector::gl && plan.projector != Projector::slices) {
    throw base::UsageError("--light-map is for --projector gl and slices; " +
                           to_string(plan.projector) + " sums the lights");
  }
  if (!scene.lights || scene.shading == Shading::none) {
    throw base::UsageError("--light-map holds the light of --lights: give some");
  }
  if (size < 2 || size > kLargestLightMap) {
    throw base::UsageError(
        fmt::format("--light-map needs from 2 to {} texels each way", kLargestLightMap));
  }
  std::vector<double> shininess;
  for (const preint::Isosurface& surface : scene.isosurfaces) {
    shininess.push_back(scene.transfer_function.material_at(surface.value).shininess);
  }
  if (std::adjacent_find(shininess.begin(), shininess.end(), std::not_equal_to<>()) !=
      shininess.end()) {
    throw base::UsageError(
        "--light-map holds the highlights of one shininess, and the surfaces have several");
  }
}

void check_projector(const Scene& scene, const Plan& plan) {
  if (plan.projector == Projector::cpu || plan.projector == Projector::reference) return;
  if (scene.modulation && plan.projector == Projector::slices &&
      plan.slices.classify == Classify::pre) {
    throw base::UsageError(
        "--classify pre has colors without values: --modulate needs post or integrated");
  }
  if (!is_lit_medium(scene)) return;
  if (plan.projector == Projector::gl) check_medium_of_gl(scene, plan);
  if (plan.projector == Projector::slices) check_medium_of_slices(scene, plan);
}

}  // namespace

bool has_one_material(const preint::TransferFunction& tf) {
  const Coefficients first = coefficients(tf.points()[0].material);
  return std::all_of(tf.points().begin(), tf.points().end(),
                     [&](const auto& point) { return coefficients(point.material) == first; });
}

void plan_light(const Scene& scene, int light_map, Plan& plan) {
  check_scene(scene);
  check_projector(scene, plan);
  if (light_map != 0) check_light_map(scene, light_map, plan);
  plan.light_map = light_map;
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
  if (light_map > 0) {
    plan.reasons.push_back(
        fmt::format("lights: looked up in cube maps of {0} x {0} texels by the normal and {1} x "
                    "{1} by the reflected viewer, as seen from the middle of the mesh",
                    diffuse_size(light_map), light_map));
  }
}

}  // namespace tetraglass::project
