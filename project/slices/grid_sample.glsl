// The field of the grid at a place of a ray.

uniform vec3 last_point;   // of each axis, from 0
uniform vec3 texel_scale;
uniform vec3 texel_offset;
uniform vec2 texel_value;  // factor and summand
#ifdef LAYER
uniform sampler2DArray grid;
uniform float last_layer;
#else
uniform sampler3D grid;
#endif

#ifdef UNEVEN
uniform samplerBuffer grid_points;  // of the three axes one after the other, in units of half extents

float point_of(int first, float index) {
  int low = int(index);
  float a = texelFetch(grid_points, first + low).x;
  float part = index - float(low);
  return part > 0 ? mix(a, texelFetch(grid_points, first + low + 1).x, part) : a;
}

float index_on_axis(int first, int last, float place) {
  int low = 0;
  int high = last - 1;
  while (low < high) {
    int middle = (low + high + 1) >> 1;
    bool above = texelFetch(grid_points, first + middle).x <= place;
    low = above ? middle : low;
    high = above ? high : middle - 1;
  }
  float a = texelFetch(grid_points, first + low).x;
  float b = texelFetch(grid_points, first + low + 1).x;
  return float(low) + clamp((place - a) / (b - a), 0.0, 1.0);
}
#endif

// In units of points.
vec3 index_at(vec3 place) {
#ifdef UNEVEN
  ivec3 last = ivec3(last_point);
  int second = last.x + 1;
  int third = second + last.y + 1;
  return vec3(index_on_axis(0, last.x, place.x), index_on_axis(second, last.y, place.y),
              index_on_axis(third, last.z, place.z));
#else
  return clamp(0.5 * place + 0.5, 0.0, 1.0) * last_point;
#endif
}

vec4 texel_at(vec3 index) {
  vec3 at = index * texel_scale + texel_offset;
#ifdef LAYER
#ifdef NEAREST
  vec4 texel = textureLod(grid, vec3(at.PLANE, floor(at.LAYER + 0.5)), 0.0);
#else
  float layer = clamp(floor(at.LAYER), 0.0, last_layer);
  float next = min(layer + 1, last_layer);
  vec4 texel = mix(textureLod(grid, vec3(at.PLANE, layer), 0.0), textureLod(grid, vec3(at.PLANE, next), 0.0),
                   at.LAYER - layer);
#endif
#else
  vec4 texel = textureLod(grid, at, 0.0);
#endif
  return texel * texel_value.x + texel_value.y;
}

float value_at(vec3 index) { return texel_at(index).x; }

#if defined(SHADING_SMOOTH) || defined(MODULATED)
// The mean over the places one point up and down the axes other than k, weights (1, 2, 1) / 4 along each.
float smoothed_value(vec3 index, int k) {
#ifdef SOBEL
  int a = (k + 1) % 3;
  int b = (k + 2) % 3;
  float sum = 0;
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      vec3 at = index;
      at[a] = clamp(index[a] + float(i), 0.0, last_point[a]);
      at[b] = clamp(index[b] + float(j), 0.0, last_point[b]);
      sum += float((2 - abs(i)) * (2 - abs(j))) * value_at(at);
    }
  }
  return sum / 16;
#else
  return value_at(index);
#endif
}

// In camera space, for each unit of length. From the values one point up and down along each axis
// (grid_reference.h, grid_gradient).
vec3 gradient_at(vec3 index) {
  vec3 slope;
#ifdef UNEVEN
  int first = 0;
#endif
  for (int k = 0; k < 3; ++k) {
    vec3 up = index;
    vec3 down = index;
    up[k] = min(index[k] + 1, last_point[k]);
    down[k] = max(index[k] - 1, 0.0);
#ifdef UNEVEN
    float apart = point_of(first, up[k]) - point_of(first, down[k]);
    first += int(last_point[k]) + 1;
#else
    float apart = 2 * (up[k] - down[k]) / last_point[k];
#endif
    slope[k] = (smoothed_value(up, k) - smoothed_value(down, k)) / apart;
  }
  return vec3(dot(slope, grid_right), dot(slope, grid_up), dot(slope, grid_away));
}
#endif
