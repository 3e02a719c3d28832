#include "apps/light_scene.h"

#include <string>

#include "apps/options.h"

namespace tetraglass::apps {
namespace {

/// What isosurfaces have: the layouts of weiler2002 have one gradient per cell.
std::string default_shading(const RenderArguments& arguments, project::Mode mode) {
  if (mode != project::Mode::iso) return "none";
  return arguments.layout.rfind("faces12", 0) == 0 ? "flat" : "smooth";
}

}  // namespace

void set_light(const RenderArguments& arguments, project::Scene& scene) {
  using project::GradientOf;
  using project::Shading;
  scene.shading = parse_choice<Shading>(
      arguments.shading.empty() ? default_shading(arguments, scene.mode) : arguments.shading,
      "--shading",
      {{"none", Shading::none},
       {"flat", Shading::flat},
       {"smooth", Shading::smooth},
       {"single", Shading::single},
       {"weighted", Shading::weighted},
       {"interpolated", Shading::interpolated},
       {"surface", Shading::surface}});
  if (!arguments.gradient.empty()) {
    scene.gradient = parse_choice<GradientOf>(arguments.gradient, "--gradient",
                                              {{"vertex", GradientOf::vertex},
                                               {"cell", GradientOf::cell},
                                               {"central", GradientOf::central},
                                               {"sobel", GradientOf::sobel}});
    const bool of_grid =
        scene.gradient == GradientOf::central || scene.gradient == GradientOf::sobel;
    if (of_grid != draws_grid(arguments)) {
      throw base::UsageError(of_grid
                                 ? "--gradient central and sobel are for --projector slices "
                                   "and grid-reference; cells have vertex and cell"
                                 : "--gradient vertex and cell are those of cells; --projector " +
                                       arguments.projector + " has central and sobel");
    }
    if (scene.shading == Shading::none) {
      throw base::UsageError("--gradient is that of --shading, which is none here");
    }
    if (scene.gradient == GradientOf::cell && scene.shading == Shading::smooth)
      scene.shading = Shading::flat;
    if (scene.gradient == GradientOf::vertex && scene.shading == Shading::flat)
      throw base::UsageError("--shading flat is by the gradient of cells: use --shading smooth");
  }
  if (arguments.own_lights) {
    scene.lights = arguments.own_lights;
  } else if (!arguments.lights.empty()) {
    scene.lights = project::read_lights(arguments.lights);
  }
  if (!arguments.modulate.empty()) {
    scene.modulation = parse_number(arguments.modulate, "--modulate");
    if (!(*scene.modulation > 0)) {
      throw base::UsageError(
          "--modulate needs a gradient above 0, in the field's units per length");
    }
  }
}

}  // namespace tetraglass::apps
