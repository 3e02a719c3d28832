// Cuts the segment where the scene's planes do, and where opaque geometry ends the ray: the values along it are
// linear, so they are cut with it.

#ifdef CLIP_PLANES
#include "clip_range.glsl"
#endif
#ifdef RAY_ENDS
uniform sampler2D ray_ends;  // z - focus, of each pixel of the tile
#endif

// Nothing is left: false.
bool clip(vec2 position, inout Segment seg) {
  float near = seg.entry;
  float far = seg.exit;
#ifdef CLIP_PLANES
  if (!clip_range(position, near, far)) return false;
#endif
#ifdef RAY_ENDS
  far = min(far, texelFetch(ray_ends, ivec2(gl_FragCoord.xy), 0).r);
  if (!(near < far)) return false;
#endif
  if (near == seg.entry && far == seg.exit) return true;
  float inverse = 1 / (seg.exit - seg.entry);
  float t0 = (near - seg.entry) * inverse;
  float t1 = (far - seg.entry) * inverse;
  seg = Segment(near, far, mix(seg.front, seg.back, t0), mix(seg.front, seg.back, t1), seg.size * (t1 - t0));
  return true;
}
