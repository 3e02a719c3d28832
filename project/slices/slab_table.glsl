// What a slab sends towards the eye, from a table over the values at its front and back (lum2004, meissner2002
// section 2.4) of slabs of a nominal length.

uniform sampler2D table;

vec4 slab_light(float front, float back, float size) {
  float n = float(textureSize(table, 0).x);
  vec2 at = clamp(0.5 * vec2(front, back) + 0.5, 0.0, 1.0);
  return slab_of(textureLod(table, (at * (n - 1) + 0.5) / n, 0.0), size);
}
