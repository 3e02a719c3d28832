// The isosurfaces that a segment crosses, nearest first (weiler2002 section 5.2).

// Ascending: (value that segments are compared with, opacity, value, 0), color, material; see
// ValueScale::isovalue_threshold.
uniform samplerBuffer surfaces;
uniform int surface_count;

// Half open: of two segments that share an end value exactly one has the crossing (preint::crosses).
bool crosses(float front, float back, float isovalue) { return (front < isovalue) != (back < isovalue); }

float surface_value(int i) { return texelFetch(surfaces, 3 * i).x; }
float surface_place(int i) { return texelFetch(surfaces, 3 * i).z; }
float surface_opacity(int i) { return texelFetch(surfaces, 3 * i).y; }
vec3 surface_color(int i) { return texelFetch(surfaces, 3 * i + 1).rgb; }
#if defined(SHADING_FLAT) || defined(SHADING_SMOOTH)
Material surface_material(int i) {
  vec4 m = texelFetch(surfaces, 3 * i + 2);
  return Material(m.x, m.y, m.z, m.w);
}
#endif
