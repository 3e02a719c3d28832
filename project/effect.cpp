#include "project/effect.h"

namespace tetraglass::project {

std::string to_string(Effect effect) {
  switch (effect) {
    case Effect::cells:
      return "cells";
    case Effect::segments:
      return "segments";
    case Effect::medium:
      return "transfer function";
    case Effect::table:
      return "table";
    case Effect::attenuation:
      return "attenuation";
    case Effect::order:
      return "order";
    case Effect::blending:
      return "blending";
    case Effect::rays:
      return "rays";
    case Effect::gradients:
      return "gradients";
    case Effect::lights:
      return "lights";
    case Effect::materials:
      return "materials";
    case Effect::modulation:
      return "modulation";
    case Effect::clipping:
      return "clipping";
    case Effect::depth_cue:
      return "depth cue";
    case Effect::opaque:
      return "opaque geometry";
    case Effect::samples:
      return "samples";
  }
  return "";
}

}  // namespace tetraglass::project
