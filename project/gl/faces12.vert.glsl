// One of the three vertices of one of a cell's four faces (weiler2002, section 4.2): knows the plane of the face
// opposite to it, hence its own ray parameter, and the normal of the face across the edge that starts here, hence
// whether that face can be the exit (section 4.3). 15 numbers in all.
//
// The parameters of the other two faces are 0 here, because the vertex lies on both of them; so each of the three
// is linear on the face. In perspective not the length t is, but q = N / (n.eye - a) = t / (|v - eye| + t), with N the
// distance of the vertex from its opposite plane.

layout(location = 0) in vec4 position_and_constant;  // of the plane n.x = a of the opposite face
layout(location = 1) in vec4 value_and_gradient;
layout(location = 2) in vec4 normal_index_edge;      // two components of n; of `parameters`; the longest edge
layout(location = 3) in vec3 adjacent_normal;        // outwards

uniform mat4 to_clip;
uniform vec3 eye;
#ifdef PARALLEL
uniform vec3 direction;
#endif
#ifdef ENTRY_DEPTH
uniform vec4 to_depth;   // z - focus of a point: its product with (x, y, z, 1)
#endif
#ifdef MODULATED
uniform float modulation;  // times the length of a gradient: the density, up to 1
#endif
#ifdef SHADING_FLAT
uniform dmat3 axes;      // world to camera
#endif
uniform vec4 scale;        // of values, gradients, normals and edges: what the short layout was divided by

out vec3 parameters;
flat out float longest_edge;
#ifndef PARALLEL
out vec3 from_eye;
#endif
#ifdef ENTRY_DEPTH
out float entry_depth;
#endif
#ifdef VALUES
out float value;
flat out vec3 gradient;
#endif
#ifdef CELL_FIELD
flat out float value;
#endif
#ifdef MODULATED
flat out float density;
#endif
#ifdef SHADING_FLAT
flat out vec3 cell_gradient;
#endif

// Times the longest length that a parameter can have as the exit's.
const float kNotTheExit = 1e4;

invariant gl_Position;

void main() {
  vec3 point = position_and_constant.xyz;
  gl_Position = to_clip * vec4(point, 1);
  longest_edge = normal_index_edge.w * scale.w;
  vec3 own_gradient = value_and_gradient.yzw * scale.y;

  // The third component is not stored: n and -n, with the constants a and -a, are the same plane (equation 4). As
  // the buffers were made from the same sum, its roundings must be the same too.
  vec2 n = normal_index_edge.xy * scale.z;
  precise float rest = 1 - n.x * n.x - n.y * n.y;
  vec3 normal = vec3(n, sqrt(max(rest, 0.0)));
  float height = position_and_constant.w - dot(normal, point);
#ifdef PARALLEL
  float own = height / dot(normal, direction);
  bool adjacent_enters = dot(adjacent_normal, direction) < 0;
  float not_the_exit = kNotTheExit * longest_edge;
#else
  from_eye = point - eye;
  bool adjacent_enters = dot(adjacent_normal, from_eye) < 0;
#ifdef INTERPOLATED_LENGTHS
  float own = height / dot(normal, normalize(from_eye));
  float not_the_exit = kNotTheExit * longest_edge;
#else
  float own = height / (position_and_constant.w - dot(normal, eye));
  float not_the_exit = kNotTheExit;
#endif
#endif
  if (!(own >= 0 && own < not_the_exit)) own = not_the_exit;

  int index = int(normal_index_edge.z);
  parameters = vec3(0);
  parameters[index] = own;
#ifdef EDGE_FIX
  // Counter-clockwise: the edge to the next vertex lies across from the one before.
  if (adjacent_enters) parameters[index == 0 ? 2 : index - 1] = not_the_exit;
#endif
#ifdef ENTRY_DEPTH
  entry_depth = dot(to_depth, vec4(point, 1));
#endif
#ifdef VALUES
  value = value_and_gradient.x * scale.x;
  gradient = own_gradient;
#endif
#ifdef CELL_FIELD
  value = value_and_gradient.x * scale.x;
#endif
#ifdef MODULATED
  // Scaled first: the squares of large components would not be finite.
  float largest = max(max(abs(own_gradient.x), abs(own_gradient.y)), abs(own_gradient.z));
  density = largest > 0 ? min(length(own_gradient / largest) * (largest * modulation), 1.0) : 0.0;
#endif
#ifdef SHADING_FLAT
  cell_gradient = mat3(axes) * own_gradient;
#endif
}
