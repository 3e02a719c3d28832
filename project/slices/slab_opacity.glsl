// Colors and opacities of slabs of a nominal length, made those of another (wilson1994, lum2004 Eq. 1):
// alpha' = 1 - (1 - alpha)^(size / nominal), C' = C alpha' / alpha; as alpha goes to 0, C size / nominal.

uniform float nominal_inverse;

// -ln(1 - alpha) / alpha.
float depth_of_opacity(float alpha) {
  // Below 1/16 by its power series: the first term left out is at most 2^-24 / 7.
  if (alpha < 0.0625) {
    return 1 + alpha * (1.0 / 2 + alpha * (1.0 / 3 + alpha * (1.0 / 4 + alpha * (1.0 / 5 + alpha / 6))));
  }
  return -log(max(1 - alpha, 1e-37)) / alpha;
}

// (1 - exp(-depth)) / depth.
float opacity_of_depth(float depth) {
  // Below 1/16 by its power series: the first term left out is at most 2^-20 / 720.
  if (depth < 0.0625) return 1 - depth / 2 * (1 - depth / 3 * (1 - depth / 4 * (1 - depth / 5)));
  return (1 - exp(-depth)) / depth;
}

// What colors and opacities of a slab of the nominal length, this the opacity, are multiplied by.
float slab_factor(float nominal, float size) {
  float alpha = clamp(nominal, 0.0, 1.0);
  float factor = depth_of_opacity(alpha) * (size * nominal_inverse);
  return factor * opacity_of_depth(alpha * factor);
}

vec4 slab_of(vec4 nominal, float size) {
  float factor = slab_factor(nominal.a, size);
  return vec4(nominal.rgb * factor, min(clamp(nominal.a, 0.0, 1.0) * factor, 1.0));
}
