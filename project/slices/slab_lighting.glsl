// The light of a slab of a medium, by the field's gradient there.

#include "shade.glsl"

uniform vec4 material;  // of the medium; where MATERIAL_TABLE, its shininess alone
#ifdef MATERIAL_TABLE
// Ambient, diffuse and specular coefficient, as far as they are seen, and where most of the light comes from
// (meissner2002 section 4).
uniform sampler2D material_table;
#endif
#ifdef RAMPED_LIGHT
uniform sampler2D back_table;
#endif
#ifdef SURFACE_NORMAL
#include "surface_place.glsl"
#endif

// A color (RGB associated to A) at this depth of the ray.
vec3 lit(Material m, vec4 color, Ray ray, vec2 position, float depth) {
  return shade(color.rgb, color.a, m, gradient_at(index_at(ray.start + depth * ray.slope)),
               camera_point(position, depth), ray.to_viewer);
}

// Of a slab from `near` to `far` by its unlit light. With RAMPED_LIGHT that is looked up here: what of it comes from
// the front is lit there, the rest at the back (lum2004).
vec4 lit_slab(vec4 light, float front, float back, float size, Ray ray, vec2 position, float near, float far) {
  Material m = Material(material.x, material.y, material.z, material.w);
  float place = 0.5;
#ifdef MATERIAL_TABLE
  vec4 mean = looked_up_in(material_table, front, back);
  m = Material(mean.x, mean.y, mean.z, material.w);
#endif
#ifdef WEIGHTED_NORMAL
  place = mean.w;
#elif defined(SURFACE_NORMAL)
  place = surface_place(front, back);
#endif
#ifdef RAMPED_LIGHT
  vec4 nearer = looked_up_in(table, front, back);
  vec4 farther = looked_up_in(back_table, front, back);
  float factor = slab_factor(nearer.a, size);
  nearer *= factor;
  farther *= factor;
  return vec4(lit(m, vec4(nearer.rgb, nearer.a - farther.a), ray, position, near) +
                  lit(m, farther, ray, position, far),
              min(nearer.a, 1.0));
#else
  return vec4(lit(m, light, ray, position, mix(near, far, place)), light.a);
#endif
}
