#pragma once

#include <array>
#include <string>

namespace tetraglass::project {

/// What a picture can call for. Each is work and memory only where the scene has it.
enum class Effect {
  cells,        ///< the cells that can show anything, as the projector reads them
  segments,     ///< of rays in cells, and what they show
  medium,       ///< the transfer function, as segments look it up
  table,        ///< pre-integrated
  attenuation,  ///< light that is taken on its way to the eye
  order,        ///< which cells hide which
  blending,     ///< of what lies behind what is translucent
  rays,         ///< a direction for each ray: perspective views
  gradients,    ///< of the field
  lights,       ///< other than one at the eye
  materials,    ///< coefficients of light that depend on the value
  modulation,   ///< of the opacity by the gradient
  clipping,     ///< by planes
  depth_cue,    ///< surfaces fade with their distance
  opaque,       ///< lines and surfaces among the volume
  samples       ///< several rays a pixel
};

inline constexpr std::array kEffects = {
    Effect::cells,       Effect::segments,  Effect::medium,    Effect::table,
    Effect::attenuation, Effect::order,     Effect::blending,  Effect::rays,
    Effect::gradients,   Effect::lights,    Effect::materials, Effect::modulation,
    Effect::clipping,    Effect::depth_cue, Effect::opaque,    Effect::samples};

[[nodiscard]] std::string to_string(Effect effect);

}  // namespace tetraglass::project
