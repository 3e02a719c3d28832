// Four vertices for each cell (six where its faces are a strip), made from its number: the cell's planes for the fragment stage, the same at all
// four, and the position of one corner.

uniform usamplerBuffer cells;     // vertex ids, ascending; the top bit of the last: negatively oriented so
uniform samplerBuffer vertices;   // position relative to the mesh's centre and half diagonal; value
#ifdef ORDERED
uniform usamplerBuffer order;     // cell to draw as the k-th
#endif
#ifdef CELL_FIELD
uniform samplerBuffer cell_values;
#endif
#ifdef MODULATED
uniform samplerBuffer densities;  // of each cell
#endif
#ifdef SHADING_SMOOTH
uniform samplerBuffer gradients;  // of each vertex
#endif

uniform dmat3 axes;     // world to camera: rows right, up, away
uniform dvec3 origin;   // the mesh's centre in camera space
uniform double pitch;   // of the pixels, on the image plane
uniform dvec2 middle;   // of the picture, in pixels
uniform double focus;   // depth at which Z is 0
uniform dvec2 tie_shift;  // right and up, in pixels
uniform dvec2 tile_origin;
uniform dvec2 tile_size;
uniform float margin;   // in pixels

flat out vec4 depth_at_anchor;
flat out vec4 depth_dx;
flat out vec4 depth_dy;
flat out vec4 facing;
flat out vec4 anchors;  // pixel positions: of face 0; of the others
#ifdef VALUES
flat out vec4 value_at_anchor;
flat out vec4 value_dx;
flat out vec4 value_dy;
flat out vec4 value_least;  // of each face
flat out vec4 value_most;
flat out float value_at_eye;
#endif
#ifdef CELL_FIELD
flat out float cell_value;
#endif
#ifdef MODULATED
flat out float density;
#endif
#ifdef SHADING_FLAT
flat out vec3 cell_gradient;
#endif
#ifdef SHADING_SMOOTH
flat out vec3 vertex_gradients[4];
#endif

// Where the ray of a pixel position meets the image plane.
dvec2 image_plane(dvec2 position) { return dvec2(position.x - middle.x, middle.y - position.y) * pitch; }

dvec2 pixel_position(dvec3 p) {
#ifdef PARALLEL
  return middle + dvec2(p.x, -p.y) / pitch;
#else
  return middle + dvec2(p.x, -p.y) / (p.z * pitch);
#endif
}

#include "face_planes.glsl"
#include "outline.glsl"

// Sums and products of a few of these stay finite.
float finite(double value) { return float(clamp(value, -1e30, 1e30)); }

float least(float a, float b, float c) { return min(min(a, b), c); }
float most(float a, float b, float c) { return max(max(a, b), c); }

// Clip coordinates of a point in camera space, for this tile; row 0 of the picture is row 0 of the target.
vec4 clip_position(dvec3 p) {
#ifdef PARALLEL
  double w = 1;
#else
  double w = p.z;
#endif
  dvec2 scaled = dvec2(p.x, -p.y) / pitch + (middle - tile_origin) * w;  // pixel position in the tile, times w
  return vec4(vec2(2 * scaled / tile_size - w), 0, float(w));
}

// Within this many screens of the tile, floats hold a position well below the margin.
const double kScreens = 16;

vec4 corner_position(dvec3 p[4], int corner) {
  dvec2 position[4];
  bool near_eye = false;
  for (int i = 0; i < 4; ++i) {
#ifndef PARALLEL
    near_eye = near_eye || !(p[i].z > 0);
#endif
    position[i] = pixel_position(p[i]) - tile_origin;
    near_eye = near_eye || any(greaterThan(abs(position[i]), kScreens * tile_size));
  }
  if (near_eye) {
    // No outline, or one too large for floats: the rasterizer clips the cell in space. The margin is made by
    // growing the cell about its centre, by far less than its size but more than the rasterizer rounds.
    dvec3 centre = 0.25 * (p[0] + p[1] + p[2] + p[3]);
    return clip_position(centre + (p[corner] - centre) * 1.015625);
  }
  dvec2 own = position[corner];
  vec2 moved = outward(vec2(position[(corner + 1) & 3] - own), vec2(position[(corner + 2) & 3] - own),
                       vec2(position[(corner + 3) & 3] - own), margin);
  return vec4(vec2(2 * (own + moved) / tile_size - 1), 0, 1);
}

void main() {
#ifdef STRIP
  int k = gl_VertexID / 6;
  int corner = int[6](1, 0, 2, 3, 1, 0)[gl_VertexID - 6 * k];
#else
  int k = gl_VertexID >> 2;
  int corner = gl_VertexID & 3;
#endif
#ifdef ORDERED
  int cell = int(texelFetch(order, k).x);
#else
  int cell = k;
#endif
  uvec4 ids = texelFetch(cells, cell);
  bool negative = (ids.w & 0x80000000u) != 0;
  ids.w &= 0x7fffffffu;

  dvec3 p[4];
  float s[4];
  for (int i = 0; i < 4; ++i) {
    vec4 vertex = texelFetch(vertices, int(ids[i]));
    precise dvec3 placed = axes * dvec3(vertex.xyz) + origin;
    p[i] = placed;
    s[i] = vertex.w;
  }

  // The anchor of a face is the image of its first vertex, which its two cells share. In front of the eye
  // only; and no farther off than floats hold.
  vec2 anchor[2];
  for (int i = 0; i < 2; ++i) {
    dvec2 position = pixel_position(p[i]);
#ifndef PARALLEL
    if (!(p[i].z > 0)) position = middle;
#endif
    anchor[i] = vec2(clamp(position, -middle, 3 * middle));
  }
  anchors = vec4(anchor[1], anchor[0]);

  Face faces[4];
  faces[0] = face_planes(p[1], p[2], p[3], dvec3(s[1], s[2], s[3]), dvec2(anchor[1]));
  faces[1] = face_planes(p[0], p[2], p[3], dvec3(s[0], s[2], s[3]), dvec2(anchor[0]));
  faces[2] = face_planes(p[0], p[1], p[3], dvec3(s[0], s[1], s[3]), dvec2(anchor[0]));
  faces[3] = face_planes(p[0], p[1], p[2], dvec3(s[0], s[1], s[2]), dvec2(anchor[0]));

  // lambda_i(eye) = +-facing_i / volume: the sign alternates with the face, and camera space is left-handed.
  double orientation = negative ? 1 : -1;
  dvec4 mu = orientation * dvec4(faces[0].facing, -faces[1].facing, faces[2].facing, -faces[3].facing);
  double largest = max(max(abs(mu.x), abs(mu.y)), max(abs(mu.z), abs(mu.w)));
  facing = vec4(mu / largest);

  for (int i = 0; i < 4; ++i) {
    depth_at_anchor[i] = finite(faces[i].depth.at_anchor);
    depth_dx[i] = finite(faces[i].depth.dx);
    depth_dy[i] = finite(faces[i].depth.dy);
#ifdef VALUES
    value_at_anchor[i] = finite(faces[i].value.at_anchor);
    value_dx[i] = finite(faces[i].value.dx);
    value_dy[i] = finite(faces[i].value.dy);
#endif
  }
#ifdef VALUES
  value_least = vec4(least(s[1], s[2], s[3]), least(s[0], s[2], s[3]), least(s[0], s[1], s[3]), least(s[0], s[1], s[2]));
  value_most = vec4(most(s[1], s[2], s[3]), most(s[0], s[2], s[3]), most(s[0], s[1], s[3]), most(s[0], s[1], s[2]));
  value_at_eye = 0;
#ifndef PARALLEL
  // Needed where the eye is in the cell, all four are positive then, or on its boundary.
  float volume = dot(facing, vec4(1));
  if (volume != 0) value_at_eye = dot(facing, vec4(s[0], s[1], s[2], s[3])) / volume;
#endif
#endif
#ifdef CELL_FIELD
  cell_value = texelFetch(cell_values, cell).x;
#endif
#ifdef MODULATED
  density = texelFetch(densities, cell).x;
#endif
#ifdef SHADING_FLAT
  // grad s = sum s_i grad lambda_i; the gradients' sum is 0, and the normal's length and sign do not matter.
  dvec3 n1 = cross(p[2] - p[0], p[3] - p[0]);
  dvec3 n2 = cross(p[1] - p[0], p[3] - p[0]);
  dvec3 n3 = cross(p[1] - p[0], p[2] - p[0]);
  dvec3 gradient = -(double(s[1]) - s[0]) * n1 + (double(s[2]) - s[0]) * n2 - (double(s[3]) - s[0]) * n3;
  double size = length(gradient);
  cell_gradient = size > 0 ? vec3(gradient / size) : vec3(0);
#endif
#ifdef SHADING_SMOOTH
  for (int i = 0; i < 4; ++i) {
    vertex_gradients[i] = mat3(axes) * texelFetch(gradients, int(ids[i])).xyz;
#ifdef UNIT_VERTICES
    float size = length(vertex_gradients[i]);
    if (size > 0) vertex_gradients[i] /= size;
#endif
  }
#endif

  // Faces are numbered for positive cells: the mirror image of those swaps two corners.
  if (negative && corner >= 2) corner = 5 - corner;
  gl_Position = corner_position(p, corner);
}
