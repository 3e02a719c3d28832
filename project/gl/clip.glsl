// Cuts the segment where the scene's planes do: the values along it are linear, so they are cut with it.

#include "clip_range.glsl"

// Nothing is left: false.
bool clip(vec2 position, inout Segment seg) {
  float near = seg.entry;
  float far = seg.exit;
  if (!clip_range(position, near, far)) return false;
  float inverse = 1 / (seg.exit - seg.entry);
  float t0 = (near - seg.entry) * inverse;
  float t1 = (far - seg.entry) * inverse;
  seg = Segment(near, far, mix(seg.front, seg.back, t0), mix(seg.front, seg.back, t1), seg.size * (t1 - t0));
  return true;
}
