// The isosurfaces that a segment crosses, the field taken for linear along it.

#include "crossing.glsl"

// Nearest first; false if there is none. `enter` and `leave`: the ends in units of points; `near` and `far`: in
// the coordinates of the lights.
bool surfaces_met(float front, float back, vec3 enter, vec3 leave, vec3 near, vec3 far, vec3 to_viewer, out vec4 color) {
  color = vec4(0);
  bool any = false;
  bool rising = front < back;
  for (int k = 0; k < surface_count; ++k) {
    int i = rising ? k : surface_count - 1 - k;
    if (!crosses(front, back, surface_value(i))) continue;
    any = true;
    float opacity = surface_opacity(i);
    vec3 lit = opacity * surface_color(i);
#ifdef SHADING_SMOOTH
    float part = clamp((surface_value(i) - front) / (back - front), 0.0, 1.0);
    vec3 gradient = gradient_at(mix(enter, leave, part));
    lit = shade(lit, opacity, surface_material(i), gradient, mix(near, far, part), to_viewer);
#endif
    color += (1 - color.a) * vec4(lit, opacity);
  }
  return any;
}
