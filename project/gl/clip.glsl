// Cuts the segment where the scene's planes do: the values along it are linear, so they are cut with it.

// Relative to the point at the focus depth on the view axis, in camera space: normal.q <= the fourth.
uniform vec4 clip_planes[CLIP_PLANES];

// Nothing is left: false.
bool clip(vec2 position, inout Segment seg) {
  vec2 ray = (position - picture_middle) * pixel_pitch * vec2(1, -1);
  float near = seg.entry;
  float far = seg.exit;
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
  if (!(near < far)) return false;
  float inverse = 1 / (seg.exit - seg.entry);
  float t0 = (near - seg.entry) * inverse;
  float t1 = (far - seg.entry) * inverse;
  seg = Segment(near, far, mix(seg.front, seg.back, t0), mix(seg.front, seg.back, t1), seg.size * (t1 - t0));
  return true;
}
