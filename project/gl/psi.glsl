// What a piece of a ray sends towards the eye by partial pre-integration (Moreland and Angel 2004; preint/psi_table.h):
// the mean transmittance psi is looked up, its arguments k mapped to k / (k + 1).

uniform sampler2D table;

float psi_axis(float k, float n) { return texel_centre(k / (k + 1), n); }

vec4 piece(vec4 front, vec4 back, float size) {
  float a = size * front.a;
  float b = size * back.a;
  float n = float(textureSize(table, 0).x);
  float psi = textureLod(table, vec2(psi_axis(a, n), psi_axis(b, n)), 0.0).r;
  float transmittance = exp(-0.5 * (a + b));
  // The mean lies between the ends, however the table was rounded.
  psi = clamp(psi, transmittance, 1.0);
  return vec4((1 - psi) * front.rgb + (psi - transmittance) * back.rgb, 1 - transmittance);
}
