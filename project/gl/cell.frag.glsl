// One ray through one cell: where it enters and leaves, what the field is there, and what the mode makes
// of that.

#ifdef SHADING_FLAT
flat in vec3 cell_gradient;
#endif
#ifdef MODULATED
flat in float density;  // of the cell: times this, extinctions are
#endif

uniform vec2 tile_corner;     // added to gl_FragCoord: pixel positions in the whole picture
uniform vec2 picture_middle;
uniform float pixel_pitch;
uniform float focus_inverse;  // 0 in parallel views
#ifdef MODE_ISO
uniform vec2 depth_range;     // nearest z - focus, and the inverse of the range
#ifdef DEPTH_CUE
uniform vec2 depth_cue;       // z - focus where colors are black, and the inverse of the range
#endif
#endif

#if defined(COUNT_FRAGMENTS) || defined(GATHER_FRAGMENTS)
#include "fragment_lists.glsl"
vec4 result;
#elif defined(SCALAR_TARGET)
layout(location = 0) out float result;
#else
layout(location = 0) out vec4 result;
#endif

struct Segment {
  float entry;  // z - focus where the ray enters
  float exit;
  float front;  // the field's value there
  float back;
  float size;   // length of the ray
};

// Length of the ray for each unit of depth.
float stretch(vec2 position) {
#ifdef PARALLEL
  return 1.0;
#else
  vec2 ray = (position - picture_middle) * pixel_pitch;
  return sqrt(1 + dot(ray, ray));
#endif
}

// Where the samples of an axis of n texels are that stand for [0, 1].
float texel_centre(float x, float n) { return (clamp(x, 0.0, 1.0) * (n - 1) + 0.5) / n; }

#ifdef FACES12
#include "segment_by_parameters.glsl"
#else
#include "segment_by_planes.glsl"
#endif

#if defined(CLIP_PLANES) || defined(RAY_ENDS)
#define CLIPPED
#include "clip.glsl"
#endif

#if defined(TABLE_2D) || defined(TABLE_3D) || defined(MATERIAL_TABLE)
float value_axis(float s, float n) { return texel_centre(0.5 * s + 0.5, n); }
#endif

#ifdef TABLE_2D
uniform sampler2D table;  // over (front, back)

vec4 looked_up(Segment seg) {
  float n = float(textureSize(table, 0).x);
  return textureLod(table, vec2(value_axis(seg.front, n), value_axis(seg.back, n)), 0.0);
}
#endif

#if defined(TABLE_3D) || defined(MATERIAL_TABLE)
uniform float table_length;    // the longest

// Of a table over (front, back, length).
vec4 looked_up_in(sampler3D lengths, Segment seg) {
  vec3 n = vec3(textureSize(lengths, 0));
  return textureLod(lengths, vec3(value_axis(seg.front, n.x), value_axis(seg.back, n.y),
                                  texel_centre(seg.size / table_length, n.z)), 0.0);
}
#endif

#ifdef TABLE_3D
uniform sampler3D table;

vec4 looked_up(Segment seg) { return looked_up_in(table, seg); }
#endif

#if defined(NEEDS_MEDIUM)
#include "medium.glsl"
#endif

#if defined(SHADING_FLAT) || defined(SHADING_SMOOTH)
#include "shade.glsl"

// Of a medium, and of surfaces that a table does not tell apart.
uniform vec4 material;
Material the_material() { return Material(material.x, material.y, material.z, material.w); }

vec3 gradient_at(vec2 position, float depth) {
#ifdef SHADING_FLAT
  return cell_gradient;
#else
  return interpolated_gradient(position, depth);
#endif
}

// A color (RGB associated to A) at the part t of the segment.
vec3 lit(Material m, vec4 color, Segment seg, float t, vec2 position) {
  float depth = mix(seg.entry, seg.exit, t);  // z - focus
  vec2 ray = (position - picture_middle) * vec2(pixel_pitch, -pixel_pitch);
#ifdef PARALLEL
  vec3 to_viewer = vec3(0, 0, -1);
  vec3 at = vec3(ray, depth);
#else
  vec3 to_viewer = -normalize(vec3(ray, 1));
  vec3 at = vec3(ray * (depth + 1 / focus_inverse), depth);
#endif
  return shade(color.rgb, color.a, m, gradient_at(position, depth), at, to_viewer);
}

#ifdef MODE_FULL
#ifdef MATERIAL_TABLE
// Ambient, diffuse and specular coefficient, as far as they are seen, and where most of the light comes from
// (meissner2002 section 4).
uniform sampler3D material_table;
#endif
#ifdef RAMPED_LIGHT
uniform sampler3D back_table;
#endif
#ifdef SURFACE_NORMAL
#include "surface_place.glsl"
#endif

// Of a segment by its unlit light. With RAMPED_LIGHT, that is what remains of it for the front of the segment, the
// opacity is that of all, and the rest is for the back (lum2004).
vec3 lit_medium(vec4 light, Segment seg, vec2 position) {
  Material m = the_material();
  float place = 0.5;
#ifdef MATERIAL_TABLE
  vec4 mean = looked_up_in(material_table, seg);
  m = Material(mean.x, mean.y, mean.z, m.shininess);
#endif
#ifdef RAMPED_LIGHT
  vec4 back = looked_up_in(back_table, seg);
  return lit(m, vec4(light.rgb, light.a - back.a), seg, 0.0, position) + lit(m, back, seg, 1.0, position);
#else
#ifdef WEIGHTED_NORMAL
  place = mean.w;
#elif defined(SURFACE_NORMAL)
  place = surface_place(seg.front, seg.back);
#endif
  return lit(m, light, seg, place, position);
#endif
}
#endif
#endif

#ifdef MODE_ISO
#ifndef TABLE_2D
#include "crossing.glsl"
#endif

// What remains of a surface's color at the part t of the segment (project/depth_cue.h).
float intensity(Segment seg, float t) {
#ifdef DEPTH_CUE
  return clamp((depth_cue.x - mix(seg.entry, seg.exit, t)) * depth_cue.y, 0.0, 1.0);
#else
  return 1;
#endif
}

// The color of surface i (RGB associated to A) met at the part t of the segment.
vec3 surface_light(int i, vec4 color, Segment seg, float t, vec2 position) {
#if !defined(SHADING_FLAT) && !defined(SHADING_SMOOTH)
  return intensity(seg, t) * color.rgb;
#elif defined(TABLE_2D)
  return intensity(seg, t) * lit(the_material(), color, seg, t, position);
#else
  return intensity(seg, t) * lit(surface_material(i), color, seg, t, position);
#endif
}

#ifdef OPAQUE
void write_depth(Segment seg, float t) {
  gl_FragDepth = (mix(seg.entry, seg.exit, t) - depth_range.x) * depth_range.y;
}
#endif

// Surfaces in the segment, nearest first; false if there is none.
bool surfaces_met(Segment seg, vec2 position, out vec4 color) {
#ifdef TABLE_2D
  // The table tells color and opacity but not where: the middle stands for that. Segments of different cells
  // do not overlap, so any of its points will do to tell which is nearer.
  vec4 met = looked_up(seg);
  color = vec4(surface_light(0, met, seg, 0.5, position), met.a);
#ifdef OPAQUE
  write_depth(seg, 0.5);
#endif
  return met.a > 0;
#else
  color = vec4(0);
  bool any = false;
  bool rising = seg.front < seg.back;
  for (int k = 0; k < surface_count; ++k) {
    int i = rising ? k : surface_count - 1 - k;
    if (!crosses(seg.front, seg.back, surface_value(i))) continue;
    any = true;
    float t = clamp((surface_place(i) - seg.front) / (seg.back - seg.front), 0.0, 1.0);
    float opacity = surface_opacity(i);
    vec4 surface = vec4(opacity * surface_color(i), opacity);
    color += (1 - color.a) * vec4(surface_light(i, surface, seg, t, position), opacity);
#ifdef OPAQUE
    write_depth(seg, t);
    break;
#endif
  }
  return any;
#endif
}
#endif

void main() {
  vec2 position = gl_FragCoord.xy + tile_corner;
  Segment seg;
  if (!segment(position, seg)) discard;
#ifdef CLIPPED
  if (!clip(position, seg)) discard;
#endif
#ifdef MODULATED
  // Less of the medium is as much of it on less of the way.
  seg.size *= density;
#endif
#ifdef COUNT_FRAGMENTS
  imageAtomicAdd(counts, ivec2(gl_FragCoord.xy), 1u);
#else
#if defined(MODE_THICKNESS)
  result = seg.size;
#elif defined(MODE_MIP_FIELD)
  result = max(seg.front, seg.back);
#elif defined(MODE_ISO)
  if (!surfaces_met(seg, position, result)) discard;
#elif defined(MODE_EMISSION)
#ifdef TABLE_2D
  result = vec4(seg.size * looked_up(seg).rgb, 0);
#else
  result = vec4(emission(seg.front, seg.back, seg.size), 0);
#endif
#elif defined(MODE_ABSORPTION)
#ifdef TABLE_2D
  result = seg.size * looked_up(seg).a;
#else
  result = optical_depth(seg.front, seg.back, seg.size);
#endif
#elif defined(MODE_MIP_TRANSFER)
#ifdef TABLE_2D
  result = vec4(looked_up(seg).rgb, 1);
#else
  result = vec4(largest_color(seg.front, seg.back), 1);
#endif
#elif defined(MODE_FULL)
#ifdef TABLE_3D
  result = looked_up(seg);
#else
  result = radiance(seg.front, seg.back, seg.size);
#endif
#if defined(SHADING_FLAT) || defined(SHADING_SMOOTH)
  result.rgb = lit_medium(result, seg, position);
#endif
#endif
#ifdef GATHER_FRAGMENTS
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  uint place = imageLoad(firsts, pixel).x + imageAtomicAdd(counts, pixel, 1u);
  depths[place] = seg.entry + seg.exit;
  fragments[place] = result;
#endif
#endif
}
