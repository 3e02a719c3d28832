// One ray through one cell: where it enters and leaves, what the field is there, and what the mode makes
// of that.

flat in vec4 depth_at_anchor;
flat in vec4 depth_dx;
flat in vec4 depth_dy;
flat in vec4 facing;
flat in vec4 anchors;
#ifdef VALUES
flat in vec4 value_at_anchor;
flat in vec4 value_dx;
flat in vec4 value_dy;
flat in vec4 value_least;
flat in vec4 value_most;
flat in float value_at_eye;
#endif
#ifdef CELL_FIELD
flat in float cell_value;
#endif
#ifdef SHADING_FLAT
flat in vec3 cell_gradient;
#endif
#ifdef SHADING_SMOOTH
flat in vec3 vertex_gradients[4];
#endif

uniform vec2 tile_corner;     // added to gl_FragCoord: pixel positions in the whole picture
uniform vec2 picture_middle;
uniform float pixel_pitch;
uniform float focus_inverse;  // 0 in parallel views
uniform float nearest;        // Z in front of the whole mesh, or at the eye
uniform float farthest;       // Z behind the whole mesh
#ifdef MODE_ISO
uniform vec2 depth_range;     // nearest z - focus, and the inverse of the range
#endif

#ifdef SCALAR_TARGET
layout(location = 0) out float result;
#else
layout(location = 0) out vec4 result;
#endif

struct Segment {
  float entry;  // z - focus where the ray enters
  float exit;
  float front;  // the field's value there
  float back;
};

// No plane lies here.
const float kNowhere = 1e32;

// Not a segment of the ray: false.
bool segment(vec2 position, out Segment seg) {
  vec4 x = position.x - anchors.xzzz;
  vec4 y = position.y - anchors.ywww;
  precise vec4 z = depth_at_anchor + depth_dx * x + depth_dy * y;
#ifdef VALUES
  precise vec4 s = value_at_anchor + value_dx * x + value_dy * y;
#endif
  // The ray enters through the farthest of the front faces and leaves through the nearest of the others.
  float enter = -kNowhere;
  float leave = kNowhere;
  float s_enter = 0;
  float s_leave = 0;
  vec2 enter_range = vec2(0);
  vec2 leave_range = vec2(0);
  for (int i = 0; i < 4; ++i) {
    bool front = facing[i] < 0;
    bool later = front && z[i] > enter;
    bool sooner = !front && z[i] < leave;
    enter = later ? z[i] : enter;
    leave = sooner ? z[i] : leave;
#ifdef VALUES
    s_enter = later ? s[i] : s_enter;
    s_leave = sooner ? s[i] : s_leave;
    enter_range = later ? vec2(value_least[i], value_most[i]) : enter_range;
    leave_range = sooner ? vec2(value_least[i], value_most[i]) : leave_range;
#endif
  }
  if (!(enter < leave) || leave == kNowhere) return false;
  // Without a front face the ray starts in the cell, at the eye: Z -> -infinity, z - focus = -focus.
  bool at_eye = enter == -kNowhere;
  leave = min(leave, farthest);
  enter = clamp(enter, nearest, leave);
  precise float enter_scale = 1 / (1 - focus_inverse * enter);
  precise float leave_scale = 1 / (1 - focus_inverse * leave);
  seg.entry = enter * enter_scale;
  seg.exit = leave * leave_scale;
  seg.front = 0;
  seg.back = 0;
#ifdef VALUES
  // A value on a face lies among those of its corners; so it is exact where they are equal.
  seg.front = at_eye ? value_at_eye : clamp(s_enter * enter_scale, enter_range.x, enter_range.y);
  seg.back = clamp(s_leave * leave_scale, leave_range.x, leave_range.y);
#endif
#ifdef CELL_FIELD
  seg.front = cell_value;
  seg.back = cell_value;
#endif
  return seg.exit > seg.entry;
}

// Length of the ray for each unit of depth.
float stretch(vec2 position) {
#ifdef PARALLEL
  return 1.0;
#else
  vec2 ray = (position - picture_middle) * pixel_pitch;
  return sqrt(1 + dot(ray, ray));
#endif
}

#if defined(TABLE_2D) || defined(TABLE_3D)
// Where the samples of an axis of n texels are that stand for [0, 1].
float texel_centre(float x, float n) { return (clamp(x, 0.0, 1.0) * (n - 1) + 0.5) / n; }
float value_axis(float s, float n) { return texel_centre(0.5 * s + 0.5, n); }
#endif

#ifdef TABLE_2D
uniform sampler2D table;  // over (front, back)

vec4 looked_up(Segment seg) {
  float n = float(textureSize(table, 0).x);
  return textureLod(table, vec2(value_axis(seg.front, n), value_axis(seg.back, n)), 0.0);
}
#endif

#ifdef TABLE_3D
uniform sampler3D table;       // over (front, back, length)
uniform float table_length;    // the longest

vec4 looked_up(Segment seg, float size) {
  vec3 n = vec3(textureSize(table, 0));
  return textureLod(table, vec3(value_axis(seg.front, n.x), value_axis(seg.back, n.y),
                                texel_centre(size / table_length, n.z)), 0.0);
}
#endif

#if defined(NEEDS_MEDIUM)
#include "medium.glsl"
#endif

#ifdef MODE_ISO
#if defined(SHADING_FLAT) || defined(SHADING_SMOOTH)
#include "shade.glsl"
#endif
#ifndef TABLE_2D
#include "crossing.glsl"
#endif

// The color of a surface (RGB associated to A) met at the part t of the segment, lit.
vec3 lit(vec4 color, Segment seg, float t, vec2 position) {
#if defined(SHADING_FLAT) || defined(SHADING_SMOOTH)
#ifdef PARALLEL
  vec3 to_viewer = vec3(0, 0, -1);
#else
  vec2 ray = (position - picture_middle) * pixel_pitch;
  vec3 to_viewer = -normalize(vec3(ray.x, -ray.y, 1));
#endif
#ifdef SHADING_FLAT
  vec3 gradient = cell_gradient;
#else
  // lambda_i of a point at Z is facing_i (Z_i - Z), but for a factor common to the four.
  float depth = mix(seg.entry, seg.exit, t);
  float z = depth / (1 + focus_inverse * depth);
  vec4 x = position.x - anchors.xzzz;
  vec4 y = position.y - anchors.ywww;
  vec4 lambda = max(facing * (depth_at_anchor + depth_dx * x + depth_dy * y - z), 0.0);
  lambda /= max(max(max(lambda.x, lambda.y), max(lambda.z, lambda.w)), 1e-37);
  vec3 gradient = lambda.x * vertex_gradients[0] + lambda.y * vertex_gradients[1] +
                  lambda.z * vertex_gradients[2] + lambda.w * vertex_gradients[3];
#endif
  Light light = headlight(gradient, to_viewer);
  return light.of_color * color.rgb + light.added * color.a;
#else
  return color.rgb;
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
  color = vec4(lit(met, seg, 0.5, position), met.a);
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
    float t = (surface_value(i) - seg.front) / (seg.back - seg.front);
    float opacity = surface_opacity(i);
    vec4 surface = vec4(opacity * surface_color(i), opacity);
    color += (1 - color.a) * vec4(lit(surface, seg, t, position), opacity);
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
  float size = (seg.exit - seg.entry) * stretch(position);
#if defined(MODE_THICKNESS)
  result = size;
#elif defined(MODE_MIP_FIELD)
  result = max(seg.front, seg.back);
#elif defined(MODE_ISO)
  if (!surfaces_met(seg, position, result)) discard;
#elif defined(MODE_EMISSION)
#ifdef TABLE_2D
  result = vec4(size * looked_up(seg).rgb, 0);
#else
  result = vec4(emission(seg.front, seg.back, size), 0);
#endif
#elif defined(MODE_ABSORPTION)
#ifdef TABLE_2D
  result = size * looked_up(seg).a;
#else
  result = optical_depth(seg.front, seg.back, size);
#endif
#elif defined(MODE_MIP_TRANSFER)
#ifdef TABLE_2D
  result = vec4(looked_up(seg).rgb, 1);
#else
  result = vec4(largest_color(seg.front, seg.back), 1);
#endif
#elif defined(MODE_FULL)
#ifdef TABLE_3D
  result = looked_up(seg, size);
#else
  result = radiance(seg.front, seg.back, size);
#endif
#endif
}
