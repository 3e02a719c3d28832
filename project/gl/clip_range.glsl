// Cuts a part of a ray where the scene's planes do.

// Relative to the point at the focus depth on the view axis, in camera space: normal.q <= the fourth.
uniform vec4 clip_planes[CLIP_PLANES];

// Nothing is left: false.
bool clip_range(vec2 position, inout float near, inout float far) {
  vec2 ray = (position - picture_middle) * pixel_pitch * vec2(1, -1);
  for (int i = 0; i < CLIP_PLANES; ++i) {
    vec4 plane = clip_planes[i];
#ifdef PARALLEL
    // q = (ray, z - focus)
    float slope = plane.z;
    float room = plane.w - dot(plane.xy, ray);
#else
    // q = (z ray, z - focus)
    float across = dot(plane.xy, ray);
    float slope = across + plane.z;
    float room = plane.w - across / focus_inverse;
#endif
    if (slope > 0) {
      far = min(far, room / slope);
    } else if (slope < 0) {
      near = max(near, room / slope);
    } else if (room < 0) {
      return false;
    }
  }
  return near < far;
}
