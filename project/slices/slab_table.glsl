// Tables over the values at the front and at the back of a slab (SlabTables).

vec4 looked_up_in(sampler2D values, float front, float back) {
  float n = float(textureSize(values, 0).x);
  vec2 at = clamp(0.5 * vec2(front, back) + 0.5, 0.0, 1.0);
  return textureLod(values, (at * (n - 1) + 0.5) / n, 0.0);
}

#ifdef TABLE_2D
uniform sampler2D table;

// What a slab sends towards the eye, from that of slabs of a nominal length (lum2004, meissner2002 section 2.4).
vec4 slab_light(float front, float back, float size) { return slab_of(looked_up_in(table, front, back), size); }
#endif
