// A ray through the grid, in units of the grid's half extents about its centre, and the part of it in one slab.

flat in vec2 slab;

uniform vec2 tile_corner;     // added to gl_FragCoord: pixel positions in the whole picture
uniform vec2 picture_middle;
uniform float pixel_pitch;
uniform float focus_inverse;  // 0 in parallel views
uniform vec3 grid_start;      // at the focus of the view axis
uniform vec3 grid_right;      // change for a unit of length to the right, up and away
uniform vec3 grid_up;
uniform vec3 grid_away;
uniform vec3 grid_drift;      // where a ray in an outer face counts as moved to

struct Ray {
  vec3 start;    // where z is at the focus
  vec3 slope;    // for each unit of depth
  float stretch; // length for each unit of depth
  vec3 to_viewer;
};

Ray ray_of(vec2 position) {
  vec2 plane = (position - picture_middle) * pixel_pitch * vec2(1, -1);
  precise vec3 across = plane.x * grid_right + plane.y * grid_up;
  Ray ray;
#ifdef PARALLEL
  ray.start = grid_start + across;
  ray.slope = grid_away;
  ray.stretch = 1;
  ray.to_viewer = vec3(0, 0, -1);
#else
  precise vec3 start = grid_start + across / focus_inverse;
  precise vec3 slope = across + grid_away;
  ray.start = start;
  ray.slope = slope;
  ray.stretch = sqrt(1 + dot(plane, plane));
  ray.to_viewer = -vec3(plane, 1) / ray.stretch;
#endif
  return ray;
}

// In the camera's axes, from its axis at the depth of the focus: the coordinates of lights.
vec3 camera_point(vec2 position, float depth) {
  vec2 plane = (position - picture_middle) * pixel_pitch * vec2(1, -1);
#ifdef PARALLEL
  return vec3(plane, depth);
#else
  return vec3(plane * (depth + 1 / focus_inverse), depth);
#endif
}

// Cuts [near, far] at low <= start + t slope <= high; false where nothing is left. A ray along one of the two
// faces counts as moved by `drift`.
bool cut(float start, float slope, float low, float high, float drift, inout float near, inout float far) {
  if (slope == 0) {
    return (start > low || (start == low && drift > 0)) && (start < high || (start == high && drift < 0));
  }
  precise float a = (low - start) / slope;
  precise float b = (high - start) / slope;
  near = max(near, min(a, b));
  far = min(far, max(a, b));
  return true;
}

#ifdef CLIP_PLANES
#include "clip_range.glsl"
#endif

// The part of the ray in the grid and in the slab: z - focus; false where there is none.
bool segment_of(vec2 position, Ray ray, out float near, out float far) {
#ifdef PARALLEL
  near = -1e30;
#else
  near = -1 / focus_inverse;
#endif
  far = 1e30;
  for (int k = 0; k < 3; ++k) {
    if (!cut(ray.start[k], ray.slope[k], -1, 1, grid_drift[k], near, far)) return false;
  }
#ifdef CLIP_PLANES
  if (!clip_range(position, near, far)) return false;
#endif
#if defined(SLAB_AXIS)
  if (!cut(ray.start[SLAB_AXIS], ray.slope[SLAB_AXIS], slab.x, slab.y, grid_drift[SLAB_AXIS], near, far)) return false;
#elif defined(SHELLS)
  // At the distance d from the eye, z - focus is d / stretch - focus: for d = focus + slab written without the
  // difference of the large numbers.
  float beyond = (ray.stretch * ray.stretch - 1) / (ray.stretch * (ray.stretch + 1) * focus_inverse);
  precise float first = slab.x / ray.stretch - beyond;
  precise float second = slab.y / ray.stretch - beyond;
  near = max(near, first);
  far = min(far, second);
#else
  near = max(near, slab.x);
  far = min(far, slab.y);
#endif
  return near < far;
}
