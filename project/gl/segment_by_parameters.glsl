// The segment of a ray in a cell from interpolated ray parameters (weiler2002, sections 3.2 and 4.1): the fragment
// lies on a front face, the ray leaves through the nearest of the three others.

in vec3 parameters;   // of the three other faces; a large number where one cannot be the exit
flat in float longest_edge;
#ifdef PARALLEL
uniform vec3 direction;  // of the rays
#else
in vec3 from_eye;     // to the point on the front face
#endif
#ifdef ENTRY_DEPTH
in float entry_depth; // z - focus of that point
#endif
#ifdef VALUES
in float value;       // there
flat in vec3 gradient;
#endif
#ifdef CELL_FIELD
flat in float value;
#endif

#ifdef MINIMUM_TEXTURE
uniform sampler3D minima;

// `scale` makes the parameters lengths. The largest of them that can be the exit's is the longest edge.
float smallest(vec3 t, float scale) {
  float n = float(textureSize(minima, 0).x);
  vec3 position = t * (scale / longest_edge);
  return textureLod(minima, vec3(texel_centre(position.x, n), texel_centre(position.y, n), texel_centre(position.z, n)),
                    0.0).r * (longest_edge / scale);
}
#else
float smallest(vec3 t, float scale) { return max(min(min(t.x, t.y), t.z), 0.0); }
#endif

// What is thinner than nothing by rounding has no length: false.
bool segment(vec2 position, out Segment seg) {
#ifdef PARALLEL
  vec3 forward = direction;
  seg.size = smallest(parameters, 1.0);
#else
  float distance = length(from_eye);
  vec3 forward = from_eye / distance;
#ifdef INTERPOLATED_LENGTHS
  seg.size = smallest(parameters, 1.0);
#else
  // The ray leaves at the distance (1 + r) |from_eye|, r = q / (1 - q): q is linear on the face, r is not.
  float q = min(smallest(parameters, distance), 0.9999999);
  seg.size = distance * (q / (1 - q));
#endif
#endif
  seg.entry = 0;
#ifdef ENTRY_DEPTH
  seg.entry = entry_depth;
#endif
  seg.exit = seg.entry + seg.size / stretch(position);
  seg.front = 0;
  seg.back = 0;
#ifdef VALUES
  // Equation 1; the gradient of a sliver knows no bounds, the field does.
  seg.front = clamp(value, -1.0, 1.0);
  seg.back = clamp(value + dot(gradient, forward) * seg.size, -1.0, 1.0);
#endif
#ifdef CELL_FIELD
  seg.front = value;
  seg.back = value;
#endif
  return seg.size > 0;
}
