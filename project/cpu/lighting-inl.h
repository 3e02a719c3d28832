// Light on the field's normals. Compiled for each instruction set: included only by
// tile_kernel.cpp, after highway.h.

#if defined(TETRAGLASS_PROJECT_CPU_LIGHTING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRAGLASS_PROJECT_CPU_LIGHTING_INL_H_
#undef TETRAGLASS_PROJECT_CPU_LIGHTING_INL_H_
#else
#define TETRAGLASS_PROJECT_CPU_LIGHTING_INL_H_
#endif

#include <array>
#include <cstdint>

#include <Eigen/Dense>
#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include "project/cpu/tile_raster-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tetraglass::project::cpu::HWY_NAMESPACE {

using Vector3 = std::array<Float, 3>;

HWY_INLINE Float dot(const Vector3& a, const Vector3& b) {
  return hn::MulAdd(a[0], b[0], hn::MulAdd(a[1], b[1], hn::Mul(a[2], b[2])));
}

/// Ambient, diffuse and specular coefficient and shininess (see preint::Material).
struct MaterialLanes {
  Float ambient, diffuse, specular, shininess;
};

/// Light that reaches some points, before color and material (project/light/phong.h).
struct IlluminationLanes {
  Vector3 diffuse;
  Vector3 specular;
  Float unlit;  ///< 1 where there is no normal: the color stays as it is, and both others are 0
};

/// 1 / sqrt(x) to about 2^-22: a guess and one step of Newton's.
HWY_INLINE Float inverse_root(Float x) {
  const Float guess = hn::ApproximateReciprocalSqrt(x);
  const Float half = hn::Mul(set(0.5F), hn::Mul(x, guess));
  return hn::Mul(guess, hn::NegMulAdd(half, guess, set(1.5F)));
}

/// Part of the way from one to the other.
HWY_INLINE Float mix(Float a, Float b, Float t) {
  return hn::MulAdd(t, hn::Sub(b, a), a);
}
HWY_INLINE Vector3 mix(const Vector3& a, const Vector3& b, Float t) {
  return {mix(a[0], b[0], t), mix(a[1], b[1], t), mix(a[2], b[2], t)};
}
HWY_INLINE IlluminationLanes mix(const IlluminationLanes& a, const IlluminationLanes& b, Float t) {
  return {mix(a.diffuse, b.diffuse, t), mix(a.specular, b.specular, t), mix(a.unlit, b.unlit, t)};
}

/// The field's gradient in the cell in work, in the camera's axes: constant, or linear
/// through the gradients at the vertices.
class CellGradient {
 public:
  explicit CellGradient(const Picture& picture) : picture_(picture) {}

  void begin(std::uint32_t cell) {
    const Lighting& lighting = *picture_.lighting;
    const Eigen::Matrix3d& axes = picture_.projection->axes;
    slope_.setZero();
    origin_.setZero();
    if (lighting.has_cell_normals) {
      constant_ = (axes * lighting.gradients[cell]).cast<float>();
      low_ = high_ = constant_;
      return;
    }
    const mesh::Cell& v = picture_.cells->cells[cell].vertices;
    Eigen::Matrix3d edges;
    Eigen::Matrix3d rises;
    const auto point = [&](std::size_t k) {
      const ViewPoint& p = picture_.points->exact[v[k]];
      return Eigen::Vector3d(p.x, p.y, p.z);
    };
    const auto gradient = [&](std::size_t k) -> Eigen::Vector3d {
      return axes * lighting.gradients[v[k]];
    };
    const Eigen::Vector3d first = gradient(0);
    constant_ = low_ = high_ = first.cast<float>();
    for (std::size_t k = 1; k < 4; ++k) {
      const Eigen::Vector3d g = gradient(k);
      edges.col(static_cast<Eigen::Index>(k) - 1) = point(k) - point(0);
      rises.col(static_cast<Eigen::Index>(k) - 1) = g - first;
      low_ = low_.cwiseMin(g.cast<float>());
      high_ = high_.cwiseMax(g.cast<float>());
    }
    const Eigen::Matrix3d slope = rises * edges.inverse();
    if (slope.array().isFinite().all() && slope.cwiseAbs().maxCoeff() < 1e30) {
      slope_ = slope.cast<float>();
      Eigen::Vector3d origin = point(0);
      if (picture_.projection->perspective) origin.z() -= picture_.projection->middle_depth;
      origin_ = origin.cast<float>();
    }
  }

  /// At points in homogeneous pixels (see ViewPoint), z from the middle depth in perspective: far
  /// away floats would lose it.
  [[nodiscard]] HWY_INLINE Vector3 at(Float x, Float y, Float z) const {
    const Float dx = hn::Sub(x, set(origin_[0]));
    const Float dy = hn::Sub(y, set(origin_[1]));
    const Float dz = hn::Sub(z, set(origin_[2]));
    Vector3 result;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto i = static_cast<Eigen::Index>(c);
      Float sum = hn::MulAdd(set(slope_(i, 0)), dx, set(constant_[i]));
      sum = hn::MulAdd(set(slope_(i, 1)), dy, sum);
      sum = hn::MulAdd(set(slope_(i, 2)), dz, sum);
      // Within what the vertices have: slivers have unbounded slopes.
      result[c] = hn::Min(hn::Max(sum, set(low_[i])), set(high_[i]));
    }
    return result;
  }

 private:
  const Picture& picture_;
  Eigen::Vector3f constant_ = Eigen::Vector3f::Zero();
  Eigen::Matrix3f slope_ = Eigen::Matrix3f::Zero();
  Eigen::Vector3f origin_ = Eigen::Vector3f::Zero();
  Eigen::Vector3f low_ = Eigen::Vector3f::Zero();
  Eigen::Vector3f high_ = Eigen::Vector3f::Zero();
};

/// Lights the points of the rays of blocks of pixels inside the cell in work (project/light/phong.h
/// in floats).
class CellLighting {
 public:
  /// The rays of a block, from the eye or parallel.
  struct Rays {
    Float x;  ///< pixels from the camera's axis
    Float y;
    Vector3 to_viewer;  ///< of unit length, in the camera's axes
  };

  /// (x, y): the first pixel of the tile.
  CellLighting(const Picture& picture, int x, int y)
      : picture_(picture),
        lighting_(*picture.lighting),
        gradient_(picture),
        tile_x_(static_cast<float>(x - picture.projection->center_x)),
        tile_y_(static_cast<float>(y - picture.projection->center_y)),
        columns_(static_cast<std::size_t>(picture.tile_size / kBlockWidth)) {}

  void begin(std::uint32_t cell) { gradient_.begin(cell); }

  [[nodiscard]] HWY_INLINE Rays rays(std::size_t block) const {
    const auto row = static_cast<float>(block / columns_ * static_cast<std::size_t>(kBlockHeight));
    const auto column =
        static_cast<float>(block % columns_ * static_cast<std::size_t>(kBlockWidth));
    Rays rays;
    rays.x = hn::Add(set(tile_x_ + column), lane_offsets(false));
    rays.y = hn::Add(set(tile_y_ + row), lane_offsets(true));
    if (!picture_.projection->perspective) {
      rays.to_viewer = {set(0), set(0), set(-1)};
      return rays;
    }
    const Float inverse = set(static_cast<float>(1 / picture_.projection->focal));
    const Float u = hn::Neg(hn::Mul(rays.x, inverse));
    const Float v = hn::Mul(rays.y, inverse);  // pixels count down
    const Float length = hn::Sqrt(hn::MulAdd(u, u, hn::MulAdd(v, v, set(1))));
    const Float one = hn::Div(set(1), length);
    rays.to_viewer = {hn::Mul(u, one), hn::Mul(v, one), hn::Neg(one)};
    return rays;
  }

  /// The field's gradient where the rays are at these depths (BlockSegments::near and far).
  [[nodiscard]] HWY_INLINE Vector3 gradient(const Rays& rays, Float depth) const {
    if (!picture_.projection->perspective) return gradient_.at(rays.x, rays.y, depth);
    const Float middle = set(static_cast<float>(picture_.projection->middle_depth));
    const Float beyond = hn::Mul(depth, middle);
    const Float z = hn::Add(beyond, middle);
    return gradient_.at(hn::Mul(rays.x, z), hn::Mul(rays.y, z), beyond);
  }

  /// Light on normals along these gradients, at these depths.
  [[nodiscard]] HWY_INLINE IlluminationLanes illuminate(const Rays& rays, Float depth,
                                                        const Vector3& gradient,
                                                        Float shininess) const {
    const Float square = dot(gradient, gradient);
    const Lanes has_normal = hn::Lt(set(1e-30F), square);  // nothing has a direction below
    const Float facing = dot(gradient, rays.to_viewer);
    // Turned to the viewer; 0 where there is none.
    const Float scale = hn::IfThenElseZero(
        has_normal,
        hn::CopySign(hn::Div(set(1), hn::Sqrt(hn::IfThenElse(has_normal, square, set(1)))),
                     facing));
    const Vector3 normal = {hn::Mul(gradient[0], scale), hn::Mul(gradient[1], scale),
                            hn::Mul(gradient[2], scale)};
    const Float cosine = hn::Min(hn::Mul(facing, scale), set(1));
    IlluminationLanes result = lighting_.is_headlight ? headlight(cosine, shininess)
                                                      : sum(rays, depth, normal, cosine, shininess);
    result.unlit = hn::IfThenElse(has_normal, set(0), set(1));
    for (Float& channel : result.specular) channel = hn::IfThenElseZero(has_normal, channel);
    return result;
  }

  /// Illumination::shade.
  [[nodiscard]] HWY_INLINE Vector3 shade(const IlluminationLanes& light, const Vector3& color,
                                         const MaterialLanes& m) const {
    const Float lit = hn::Sub(set(1), light.unlit);
    Vector3 result;
    for (std::size_t c = 0; c < 3; ++c) {
      const Float ambient = hn::Mul(m.ambient, set(lighting_.ambient[c]));
      const Float factor =
          hn::MulAdd(ambient, lit, hn::MulAdd(m.diffuse, light.diffuse[c], light.unlit));
      result[c] = hn::MulAdd(factor, color[c], hn::Mul(m.specular, light.specular[c]));
    }
    return result;
  }

 private:
  /// base^exponent for a base of at most 1; 0 for negative ones.
  static HWY_INLINE Float power(Float base, Float exponent) {
    const FloatTag d;
    constexpr float kLeast = 1e-30F;
    const Float log = hn::Log(d, hn::Max(base, set(kLeast)));
    return hn::IfThenElseZero(hn::Lt(set(0), base), hn::Exp(d, hn::Mul(exponent, log)));
  }

  static HWY_INLINE IlluminationLanes headlight(Float cosine, Float shininess) {
    const Float reflected = hn::MulAdd(hn::Add(cosine, cosine), cosine, set(-1));
    const Float shine = power(reflected, shininess);
    return {{cosine, cosine, cosine}, {shine, shine, shine}, set(0)};
  }

  /// Over all lights. `cosine`: of normal and viewer.
  HWY_INLINE IlluminationLanes sum(const Rays& rays, Float depth, const Vector3& normal,
                                   Float cosine, Float shininess) const {
    const Vector3 at = place(rays, depth);
    // Below this cosine a lobe holds less than exp(-14), a millionth of its light.
    const Float dark = hn::Exp(FloatTag(), hn::Div(set(-14), hn::Max(shininess, set(1e-3F))));
    IlluminationLanes result = {{set(0), set(0), set(0)}, {set(0), set(0), set(0)}, set(0)};
    for (const ViewedLight& light : picture_.lights) {
      Vector3 l = {set(light.place[0]), set(light.place[1]), set(light.place[2])};
      if (!light.far_away) {
        for (std::size_t c = 0; c < 3; ++c) l[c] = hn::Sub(l[c], at[c]);
        const Float one = inverse_root(hn::Max(dot(l, l), set(1e-30F)));
        for (std::size_t c = 0; c < 3; ++c) l[c] = hn::Mul(l[c], one);
      }
      const Float toward = dot(normal, l);
      const Float reflected = hn::MulSub(hn::Add(toward, toward), cosine, dot(l, rays.to_viewer));
      const Float lit = hn::Max(toward, set(0));
      for (std::size_t c = 0; c < 3; ++c) {
        result.diffuse[c] = hn::MulAdd(set(light.color[c]), lit, result.diffuse[c]);
      }
      if (hn::AllTrue(FloatTag(), hn::Lt(reflected, dark))) continue;
      const Float shine = power(hn::Min(reflected, set(1)), shininess);
      for (std::size_t c = 0; c < 3; ++c) {
        result.specular[c] = hn::MulAdd(set(light.color[c]), shine, result.specular[c]);
      }
    }
    return result;
  }

  /// In the coordinates of ViewedLight.
  [[nodiscard]] HWY_INLINE Vector3 place(const Rays& rays, Float depth) const {
    const Projection& projection = *picture_.projection;
    if (!projection.perspective) {
      const Float unit = set(static_cast<float>(1 / (projection.focal * projection.radius)));
      return {hn::Mul(rays.x, unit), hn::Neg(hn::Mul(rays.y, unit)), depth};
    }
    const Float middle = set(static_cast<float>(projection.middle_depth));
    const Float beyond = hn::Mul(depth, middle);
    const Float unit =
        hn::Mul(hn::Add(beyond, middle), set(static_cast<float>(1 / projection.focal)));
    return {hn::Mul(rays.x, unit), hn::Neg(hn::Mul(rays.y, unit)), beyond};
  }

  const Picture& picture_;
  const Lighting& lighting_;
  CellGradient gradient_;
  float tile_x_;  // the tile's first pixel, from the camera's axis
  float tile_y_;
  std::size_t columns_;
};

}  // namespace tetraglass::project::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
