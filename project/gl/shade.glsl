// Phong shading by a headlight (meissner2002 Eq. 1 with l = v); project/light/phong.h says the same:
// k_a c + k_d c |n.v| + k_s max(0, r.v)^32, r.v = 2 (n.v)^2 - 1 for the light at the viewer.
// k_a 0.1, k_d 0.7, k_s 0.2. Unshaded where the gradient is 0.

struct Light {
  float of_color;
  float added;
};

// to_viewer: unit length.
Light headlight(vec3 gradient, vec3 to_viewer) {
  // Scaled first: the squares of small components would vanish.
  float largest = max(max(abs(gradient.x), abs(gradient.y)), abs(gradient.z));
  if (!(largest > 0)) return Light(1, 0);
  float cosine = abs(dot(normalize(gradient / largest), to_viewer));
  float reflected = max(0.0, 2 * cosine * cosine - 1);
  // By squaring: pow() goes through logarithms, of which software renderers know few digits.
  float power = reflected * reflected;
  power *= power;
  power *= power;
  power *= power;
  power *= power;
  return Light(0.1 + 0.7 * cosine, 0.2 * power);
}
