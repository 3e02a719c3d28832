#include "project/light/phong.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "preint/gauss.h"

namespace tetraglass::project {
namespace {

using Eigen::Vector3d;

/// What a light gives, without its color: of unit vectors all.
struct Lobes {
  double diffuse = 0;
  double specular = 0;

  Lobes& operator+=(const Lobes& other) {
    diffuse += other.diffuse;
    specular += other.specular;
    return *this;
  }
  [[nodiscard]] Lobes operator*(double factor) const {
    return {diffuse * factor, specular * factor};
  }
};

/// Of unit length also where squares overflow or vanish; 0 stays 0.
Vector3d unit(const Vector3d& vector) {
  const double largest = vector.cwiseAbs().maxCoeff();
  if (!(largest > 0) || !std::isfinite(largest)) return Vector3d::Zero();
  return (vector / largest).normalized();
}

/// A point of a surface as lights see it.
struct SurfacePoint {
  const Vector3d& at;
  Vector3d normal;  // turned to the viewer
  const Vector3d& to_viewer;
  double shininess;

  [[nodiscard]] Lobes lit_from(const Vector3d& to_light) const {
    const double cosine = normal.dot(to_light);
    const double reflected = 2 * cosine * normal.dot(to_viewer) - to_light.dot(to_viewer);
    const bool is_lit = to_light != Vector3d::Zero();
    return {std::max(0.0, cosine), is_lit && reflected > 0 ? std::pow(reflected, shininess) : 0.0};
  }
};

/// The mean over a part of a rectangle, by a rule of 16 points.
Lobes mean(const SurfacePoint& surface, const Vector3d& corner,
           const std::array<Vector3d, 2>& edges) {
  Lobes sum;
  for (const preint::GaussNode& a : preint::kGauss4) {
    for (const preint::GaussNode& b : preint::kGauss4) {
      const Vector3d place = corner + a.x * edges[0] + b.x * edges[1];
      sum += surface.lit_from(unit(place - surface.at)) * (a.weight * b.weight);
    }
  }
  return sum;
}

/// Quartered until a part and its quarters agree to `tolerance`: the quarters' error is then far
/// smaller where the light is smooth. The edge of the lit half and points near the light are no
/// smooth places: there quartering ends at parts whose share is below the tolerance.
Lobes integrate(const SurfacePoint& surface, const Vector3d& corner,
                const std::array<Vector3d, 2>& edges, const Lobes& whole, double tolerance,
                double share) {
  const std::array<Vector3d, 2> halves = {0.5 * edges[0], 0.5 * edges[1]};
  std::array<Lobes, 4> quarters;
  std::array<Vector3d, 4> corners;
  Lobes sum;
  for (std::size_t i = 0; i < 4; ++i) {
    corners[i] =
        corner + static_cast<double>(i % 2) * halves[0] + static_cast<double>(i / 2) * halves[1];
    quarters[i] = mean(surface, corners[i], halves);
    sum += quarters[i] * 0.25;
  }
  const double change =
      std::max(std::abs(sum.diffuse - whole.diffuse), std::abs(sum.specular - whole.specular));
  // Along a line where the light is not smooth lie 1 / sqrt(share) parts of this share.
  if (change < tolerance || change * std::sqrt(share) < tolerance) return sum;
  sum = {};
  for (std::size_t i = 0; i < 4; ++i) {
    sum += integrate(surface, corners[i], halves, quarters[i], tolerance, 0.25 * share) * 0.25;
  }
  return sum;
}

Lobes lobes(const SurfacePoint& surface, const DirectionalLight& light) {
  return surface.lit_from(-unit(light.direction));
}

Lobes lobes(const SurfacePoint& surface, const PointLight& light) {
  return surface.lit_from(unit(light.position - surface.at));
}

Lobes lobes(const SurfacePoint& surface, const RectangleLight& light) {
  constexpr double kTolerance = 1e-5;
  return integrate(surface, light.corner, light.edges, mean(surface, light.corner, light.edges),
                   kTolerance, 1);
}

}  // namespace

Illumination illuminate(const std::optional<Lights>& lights, const Vector3d& point,
                        const Vector3d& normal, const Vector3d& to_viewer, double shininess) {
  const SurfacePoint surface{point, normal.dot(to_viewer) < 0 ? Vector3d(-normal) : normal,
                             to_viewer, shininess};
  Illumination result;
  if (!lights) {
    const Lobes head = surface.lit_from(to_viewer);
    result.diffuse.setConstant(head.diffuse);
    result.specular.setConstant(head.specular);
    return result;
  }
  result.ambient = lights->ambient;
  for (const auto& any : lights->lights) {
    std::visit(
        [&](const auto& light) {
          const Lobes lobe = lobes(surface, light);
          result.diffuse += lobe.diffuse * light.color;
          result.specular += lobe.specular * light.color;
        },
        any);
  }
  return result;
}

preint::Color shade(const std::optional<Lights>& lights, const preint::Color& color,
                    const preint::Material& material, const Vector3d& point,
                    const Vector3d& gradient, const Vector3d& to_viewer) {
  const Vector3d normal = unit(gradient);
  if (normal.isZero(0)) return color;
  return illuminate(lights, point, normal, to_viewer, material.shininess).shade(color, material);
}

}  // namespace tetraglass::project
