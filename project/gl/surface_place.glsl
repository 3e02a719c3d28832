// The one value at which segments are lit (Shading::surface).
uniform float lit_value;

// The part of a segment where the field, linear along it, comes nearest to that value.
float surface_place(float front, float back) {
  float difference = back - front;
  // 2^-22, four roundings of the largest values: there is no direction.
  if (abs(difference) < 2.3841858e-7) return 0.5;
  return clamp((lit_value - front) / difference, 0.0, 1.0);
}
