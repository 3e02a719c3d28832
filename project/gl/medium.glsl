// The transfer function as a row of pieces on each of which it is linear, and walks along them.

// Piece i: (low, high, 1 / (high - low), 0); color and extinction at its low end; their rise to its
// high end. The first and the last piece are constant and unbounded.
uniform samplerBuffer medium_pieces;
// For equal bins of [-1, 1]: a piece not above the bin's lower end.
uniform usamplerBuffer medium_index;

struct Medium {
  float high;
  vec4 front;
  vec4 back;
};

// The piece that holds s and values just above it.
int piece_above(float s) {
  int bins = textureSize(medium_index);
  int bin = clamp(int((0.5 * s + 0.5) * float(bins)), 0, bins - 1);
  int index = int(texelFetch(medium_index, bin).x);
  while (texelFetch(medium_pieces, 3 * index).y <= s) ++index;
  return index;
}

// Piece `index` between the values `from` and `to`, the latter at most at its end.
Medium medium_between(int index, float from, float most) {
  vec4 range = texelFetch(medium_pieces, 3 * index);
  vec4 low = texelFetch(medium_pieces, 3 * index + 1);
  vec4 rise = texelFetch(medium_pieces, 3 * index + 2);
  float to = min(range.y, most);
  return Medium(range.y, low + rise * ((from - range.x) * range.z), low + rise * ((to - range.x) * range.z));
}

// The part of a segment of the values [low, high] that lies between `from` and `to`.
float part_of(float from, float to, float low, float high) {
  return high > low ? (to - from) / (high - low) : 1.0;
}

#ifdef LINEAR
vec4 medium_at(float s) {
  int index = piece_above(s);
  return medium_between(index, s, s).front;
}
#endif

#ifdef MODE_EMISSION
// int kappa c: exact, the integrand is quadratic on every piece.
vec3 emission(float front, float back, float size) {
#ifdef LINEAR
  vec4 a = medium_at(front);
  vec4 b = medium_at(back);
  return 0.5 * size * (a.a * a.rgb + b.a * b.rgb);
#else
  float low = min(front, back);
  float high = max(front, back);
  vec3 sum = vec3(0);
  float from = low;
  for (int index = piece_above(low);; ++index) {
    Medium m = medium_between(index, from, high);
    float to = min(m.high, high);
    float part = part_of(from, to, low, high);
    sum += part * ((m.front.a / 3 + m.back.a / 6) * m.front.rgb + (m.front.a / 6 + m.back.a / 3) * m.back.rgb);
    if (m.high >= high) break;
    from = to;
  }
  return sum * size;
#endif
}
#endif

#ifdef MODE_ABSORPTION
// int kappa: exact.
float optical_depth(float front, float back, float size) {
#ifdef LINEAR
  return 0.5 * size * (medium_at(front).a + medium_at(back).a);
#else
  float low = min(front, back);
  float high = max(front, back);
  float sum = 0;
  float from = low;
  for (int index = piece_above(low);; ++index) {
    Medium m = medium_between(index, from, high);
    float to = min(m.high, high);
    sum += part_of(from, to, low, high) * 0.5 * (m.front.a + m.back.a);
    if (m.high >= high) break;
    from = to;
  }
  return sum * size;
#endif
}
#endif

#ifdef MODE_MIP_TRANSFER
// The channel-wise largest color; at a jump both of its sides count if the segment has them.
vec3 largest_color(float front, float back) {
  float high = max(front, back);
  float from = min(front, back);
  vec3 largest = vec3(0);
  for (int index = piece_above(from);; ++index) {
    Medium m = medium_between(index, from, high);
    largest = max(largest, max(m.front.rgb, m.back.rgb));
    if (m.high > high) break;
    from = m.high;
  }
  return largest;
}
#endif

#ifdef MODE_FULL
#ifdef PSI
#include "psi.glsl"
#elif !defined(LINEAR)
#include "model.glsl"
#endif

// Associated color and opacity. Pieces are met in the order of rising values, which is front to back or
// back to front.
vec4 radiance(float front, float back, float size) {
#ifdef LINEAR
  vec4 a = medium_at(front);
  vec4 b = medium_at(back);
  float opacity = 1 - exp(-0.5 * size * (a.a + b.a));
  return vec4(opacity * 0.5 * (a.rgb + b.rgb), opacity);
#else
  float low = min(front, back);
  float high = max(front, back);
  bool rising = front <= back;
  vec4 sum = vec4(0);
  float from = low;
  for (int index = piece_above(low);; ++index) {
    Medium m = medium_between(index, from, high);
    float to = min(m.high, high);
    vec4 light = piece(rising ? m.front : m.back, rising ? m.back : m.front, size * part_of(from, to, low, high));
    sum = rising ? sum + (1 - sum.a) * light : light + (1 - light.a) * sum;
    if (m.high >= high) break;
    from = to;
  }
  return sum;
#endif
}
#endif
