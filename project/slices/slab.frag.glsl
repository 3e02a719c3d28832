// The segment of a ray in one slab of the grid: the field there, and what the mode makes of it.

#if defined(SCALAR_TARGET)
layout(location = 0) out float result;
#else
layout(location = 0) out vec4 result;
#endif

#include "grid_ray.glsl"
#include "grid_sample.glsl"

#ifdef BLOCKS
flat in vec3 block_low;   // in units of points
flat in vec3 block_high;
#endif

#if defined(PRE_CLASSIFIED) || defined(TABLE_2D) || (defined(MODE_FULL) && defined(LINEAR))
#include "slab_opacity.glsl"
#endif
#ifdef NEEDS_MEDIUM
#include "medium.glsl"
#endif
#if defined(TABLE_2D) || defined(MATERIAL_TABLE)
#include "slab_table.glsl"
#endif
#ifdef MODE_ISO
#ifdef SHADING_SMOOTH
#include "shade.glsl"
#endif
#include "slab_surfaces.glsl"
#elif defined(SHADING_SMOOTH)
#include "slab_lighting.glsl"
#endif

vec4 light_of(float front, float back, float size) {
#if defined(MODE_FULL) && defined(LINEAR)
  vec4 medium = medium_at(front);
  float depth = size * medium.a;
  float opacity = depth * opacity_of_depth(depth);
  return vec4(opacity * medium.rgb, opacity);
#elif defined(RAMPED_LIGHT)
  return vec4(0);  // parted before it is lit
#elif defined(TABLE_2D)
  return slab_light(front, back, size);
#elif defined(MODE_FULL) && defined(NEEDS_MEDIUM)
  return radiance(front, back, size);
#else
  return vec4(0);
#endif
}

#ifdef MODULATED
uniform float modulation;  // times the length of a gradient: the density, up to 1
#endif

void main() {
  vec2 position = gl_FragCoord.xy + tile_corner;
  Ray ray = ray_of(position);
  float near;
  float far;
  if (!segment_of(position, ray, near, far)) discard;
  float middle = 0.5 * (near + far);
#ifdef BLOCKS
  // Its middle lies in exactly one of the blocks.
  precise vec3 owner = index_at(ray.start + middle * ray.slope);
  if (any(lessThan(owner, block_low)) || any(greaterThanEqual(owner, block_high))) discard;
#endif
  float size = (far - near) * ray.stretch;
#ifdef MODULATED
  // Less of the medium is as much of it on less of the way. One density a slab: that in its middle.
  size *= min(length(gradient_at(index_at(ray.start + middle * ray.slope))) * modulation, 1.0);
#endif
#ifdef MODE_THICKNESS
  result = size;
#else
#ifdef INTEGRATED
  vec3 enter = index_at(ray.start + near * ray.slope);
  vec3 leave = index_at(ray.start + far * ray.slope);
  float front = value_at(enter);
  float back = value_at(leave);
#elif !defined(PRE_CLASSIFIED)
  float front = value_at(index_at(ray.start + middle * ray.slope));
  float back = front;
#endif
#if defined(PRE_CLASSIFIED)
  result = slab_of(texel_at(index_at(ray.start + middle * ray.slope)), size);
#elif defined(MODE_MIP_FIELD)
  result = max(front, back);
#elif defined(MODE_ISO)
  if (!surfaces_met(front, back, enter, leave, camera_point(position, near), camera_point(position, far),
                    ray.to_viewer, result)) {
    discard;
  }
#elif defined(MODE_EMISSION)
  result = vec4(emission(front, back, size), 0);
#elif defined(MODE_ABSORPTION)
  result = optical_depth(front, back, size);
#elif defined(MODE_MIP_TRANSFER)
  result = vec4(largest_color(front, back), 1);
#else
#ifdef SHADING_SMOOTH
  result = lit_slab(light_of(front, back, size), front, back, size, ray, position, near, far);
#else
  result = light_of(front, back, size);
#endif
#endif
#endif
}
