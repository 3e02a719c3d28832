// What a segment of a ray sends towards the eye, for a medium whose color c and extinction kappa are
// linear along it.

// The optical depth from the front is tau(x) = x (a + (b - a) x / 2), x in [0, 1], with a and b the
// length times the extinction at the ends. The colors c0 at the front and c1 at the back reach the front as
//   int tau' (c0 + (c1 - c0) x) exp(-tau) dx = c0 (1 - E) + (c1 - c0) W,
// E = exp(-tau(1)), W = int x tau' exp(-tau) dx = M - E by parts, M the mean transmittance.

// Thinner than this, W by its series to the fourth order in tau is exact to 2.2e-7 (the first term left
// out is at most tau^5 / 144), and 1 - E to 4e-10; both are 0 at 0 without rounding.
const float kThin = 0.125;

// Up to this depth four Gauss points hold M to 1.5e-7: tau^8 (4!)^4 / (9 (8!)^3).
const float kThick = 2;

// What lies behind this depth adds less than 2^-24 to a color.
const float kOpaque = 17;

const float kLog2E = 1.44269504;

float thin_opacity(float depth) {
  return depth * (1 - depth / 2 * (1 - depth / 3 * (1 - depth / 4 * (1 - depth / 5))));
}

float thin_weight(float a, float b) {
  float g = 0.5 * (b - a);
  float a2 = a * a;
  float g2 = g * g;
  float order1 = a / 2 + g * (2.0 / 3);
  float order2 = a2 / 3 + a * g * (3.0 / 4) + g2 * (2.0 / 5);
  float order3 = a2 * a / 4 + a2 * g * (4.0 / 5) + a * g2 * (5.0 / 6) + g2 * g * (2.0 / 7);
  float order4 = a2 * a2 / 5 + a2 * a * g * (5.0 / 6) + a2 * g2 * (9.0 / 7) + a * g2 * g * (7.0 / 8) +
                 g2 * g2 * (2.0 / 9);
  return order1 - order2 + order3 / 2 - order4 / 6;
}

float thick_weight(float a, float b, float transmittance) {
  const vec4 x = vec4(0.06943184420297371, 0.33000947820757187, 0.6699905217924281, 0.9305681557970263);
  const vec2 weight = vec2(0.17392742256872693, 0.32607257743127307);
  vec4 t = exp2(-kLog2E * x * (a + 0.5 * (b - a) * x));
  return dot(t, weight.xyyx) - transmittance;
}

// Associated color (RGB) and opacity (A) of a piece with the extinctions a, b times its length.
vec4 shallow_piece(vec3 front, vec3 back, float a, float b) {
  float depth = 0.5 * (a + b);
  float opacity = thin_opacity(depth);
  float weight = thin_weight(a, b);
  if (depth > kThin) {
    float transmittance = exp2(-kLog2E * depth);
    opacity = 1 - transmittance;
    weight = thick_weight(a, b, transmittance);
  }
  return vec4(opacity * front + weight * (back - front), opacity);
}

// The part of the piece in front of the depth `part`: the root of tau(x) = part in the form without
// cancellation.
float position_of_depth(float a, float b, float depth, float part) {
  float front = a / depth;
  float u = part / depth;
  return min(1.0, 2 * u / (front + sqrt(max(0.0, front * front + 2 * (b / depth - front) * u))));
}

vec4 piece(vec4 front, vec4 back, float size) {
  float a = size * front.a;
  float b = size * back.a;
  float depth = 0.5 * (a + b);
  if (depth <= kThick) return shallow_piece(front.rgb, back.rgb, a, b);
  // Parts of equal depth, front to back, as far as light comes through.
  vec4 sum = vec4(0);
  float from = 0;
  float visible = min(depth, kOpaque);
  for (float reached = 0; reached < visible;) {
    reached = reached + kThick < visible ? reached + kThick : visible;
    float to = position_of_depth(a, b, depth, reached);
    vec2 x = vec2(from, to);
    vec2 extinction = (a + (b - a) * x) * (to - from);
    vec4 part = shallow_piece(mix(front.rgb, back.rgb, from), mix(front.rgb, back.rgb, to), extinction.x,
                              extinction.y);
    sum += (1 - sum.a) * part;
    from = to;
  }
  return sum;
}
