#include "project/scene.h"

#include <algorithm>

#include "project/single_color.h"

namespace tetraglass::project {

Frame make_frame(const Scene& scene) {
  const Region region = scene.region.value_or(Region{0, 0, scene.width, scene.height});
  const int n = scene.samples;
  return {scene.camera,
          n * scene.width,
          n * scene.height,
          {n * region.x, n * region.y, n * region.width, n * region.height}};
}

std::string to_string(Mode mode) {
  switch (mode) {
    case Mode::full:
      return "full";
    case Mode::emission:
      return "emission";
    case Mode::absorption:
      return "absorption";
    case Mode::mip:
      return "mip";
    case Mode::iso:
      return "iso";
    case Mode::thickness:
      return "thickness";
  }
  return "";
}

std::string to_string(Shading shading) {
  switch (shading) {
    case Shading::none:
      return "none";
    case Shading::flat:
      return "flat";
    case Shading::smooth:
      return "smooth";
    case Shading::single:
      return "single";
    case Shading::weighted:
      return "weighted";
    case Shading::interpolated:
      return "interpolated";
    case Shading::surface:
      return "surface";
  }
  return "";
}

bool is_commutative(const Scene& scene) {
  switch (scene.mode) {
    // Over one color alone the rest of what is seen is that of the same color, in any order.
    case Mode::full:
      return single_color(scene).has_value();
    // The nearest opaque surface wins by its depth alone; translucent ones are blended in order.
    case Mode::iso:
      return std::all_of(scene.isosurfaces.begin(), scene.isosurfaces.end(),
                         [](const preint::Isosurface& surface) { return surface.opacity >= 1; });
    case Mode::emission:
    case Mode::absorption:
    case Mode::mip:
    case Mode::thickness:
      return true;
  }
  return false;
}

}  // namespace tetraglass::project
