// Phong shading (meissner2002 Eq. 1); project/light/phong.h says the same. With LIGHTS by these, else by
// a headlight: white light at the viewer, and white ambient light. Unshaded where the gradient is 0.

struct Material {
  float ambient;
  float diffuse;
  float specular;
  float shininess;
};

#if defined(LIGHT_MAPS)
// Light by the normal and by the reflected viewer (project/light/light_maps.h), in the mesh's axes.
uniform samplerCube diffuse_map;
uniform samplerCube specular_map;
uniform dmat3 axes;  // mesh to camera
uniform vec3 ambient_light;
#elif defined(LIGHTS)
// Of each light (place, 1), or (unit vector towards it, 0) where it is far away; then its color. In the
// camera's axes, in units of half the mesh's diagonal, from the camera's axis at the depth of the focus.
uniform samplerBuffer lights;
uniform int light_count;
uniform vec3 ambient_light;
#endif

// base^exponent for base from 0 to 1. The whole part by squaring: pow() goes through logarithms, of which
// software renderers know few digits.
float power(float base, float exponent) {
  if (!(base > 0)) return 0;
  int whole = int(min(exponent, 1048576.0));
  float result = exponent > whole ? pow(base, exponent - whole) : 1;
  for (float factor = base; whole > 0; whole >>= 1) {
    if ((whole & 1) != 0) result *= factor;
    factor *= factor;
  }
  return result;
}

// Of a color times its opacity. `at`: where, in the coordinates of the lights. `to_viewer`: unit length.
vec3 shade(vec3 color, float opacity, Material material, vec3 gradient, vec3 at, vec3 to_viewer) {
  // Scaled first: the squares of small components would vanish.
  float largest = max(max(abs(gradient.x), abs(gradient.y)), abs(gradient.z));
  if (!(largest > 0)) return color;
#ifdef UNIT_VERTICES
  vec3 normal = gradient;
#else
  vec3 normal = normalize(gradient / largest);
#endif
  float facing = dot(normal, to_viewer);
#ifdef LIGHTS
  if (facing < 0) {
    normal = -normal;
    facing = -facing;
  }
#ifdef LIGHT_MAPS
  vec3 reflected = 2 * facing * normal - to_viewer;
  vec3 diffuse = textureLod(diffuse_map, normal * mat3(axes), 0.0).rgb;
  vec3 specular = textureLod(specular_map, reflected * mat3(axes), 0.0).rgb;
#else
  vec3 diffuse = vec3(0);
  vec3 specular = vec3(0);
  for (int i = 0; i < light_count; ++i) {
    vec4 place = texelFetch(lights, 2 * i);
    vec3 light = texelFetch(lights, 2 * i + 1).rgb;
    vec3 to_light = place.xyz;
    if (place.w > 0) {
      to_light -= at;
      to_light /= max(length(to_light), 1e-15);
    }
    float cosine = dot(normal, to_light);
    diffuse += max(cosine, 0.0) * light;
    float reflected = 2 * cosine * facing - dot(to_light, to_viewer);
    specular += power(min(reflected, 1.0), material.shininess) * light;
  }
#endif
  vec3 ambient = material.ambient * ambient_light;
#else
  facing = abs(facing);
  float diffuse = facing;
  float specular = power(2 * facing * facing - 1, material.shininess);
  float ambient = material.ambient;
#endif
  return color * (ambient + material.diffuse * diffuse) + opacity * material.specular * specular;
}
