// The isosurfaces that a segment crosses, nearest first (weiler2002 section 5.2).

uniform samplerBuffer surfaces;  // ascending: (value, opacity, 0, 0), color
uniform int surface_count;

// Half open: of two segments that share an end value exactly one has the crossing (preint::crosses).
bool crosses(float front, float back, float isovalue) { return (front < isovalue) != (back < isovalue); }

float surface_value(int i) { return texelFetch(surfaces, 2 * i).x; }
float surface_opacity(int i) { return texelFetch(surfaces, 2 * i).y; }
vec3 surface_color(int i) { return texelFetch(surfaces, 2 * i + 1).rgb; }
