// Isosurfaces, nearest first. Compiled for each instruction set: included only by tile_kernel.cpp,
// after highway.h.

#if defined(TETRAGLASS_PROJECT_CPU_ISO_SHADER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRAGLASS_PROJECT_CPU_ISO_SHADER_INL_H_
#undef TETRAGLASS_PROJECT_CPU_ISO_SHADER_INL_H_
#else
#define TETRAGLASS_PROJECT_CPU_ISO_SHADER_INL_H_
#endif

#include <array>
#include <cstdint>

#include <Eigen/Dense>
#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include "project/cpu/ordered_shader-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tetraglass::project::cpu::HWY_NAMESPACE {

/// The field's gradient in the cell in work, in the camera's axes: constant (flat), or linear
/// through the gradients at the vertices (smooth).
class CellGradient {
 public:
  using Vector = std::array<Float, 3>;

  explicit CellGradient(const Picture& picture) : picture_(picture) {}

  void begin(std::uint32_t cell) {
    const Surfaces& surfaces = *picture_.surfaces;
    const Eigen::Matrix3d& axes = picture_.projection->axes;
    slope_.setZero();
    origin_.setZero();
    if (surfaces.shading == Shading::flat) {
      constant_ = (axes * surfaces.gradients[cell]).cast<float>();
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
      return axes * surfaces.gradients[v[k]];
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
  [[nodiscard]] HWY_INLINE Vector at(Float x, Float y, Float z) const {
    const Float dx = hn::Sub(x, set(origin_[0]));
    const Float dy = hn::Sub(y, set(origin_[1]));
    const Float dz = hn::Sub(z, set(origin_[2]));
    Vector result;
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

/// The crossings of rays with isosurfaces (weiler2002 section 5.2), lit by a headlight, go to the
/// delay line of their block.
class IsoShader {
 public:
  static constexpr bool kValues = true;
  static constexpr bool kKeys = true;

  IsoShader(const Picture& picture, int x, int y, OrderedBlocks& blocks)
      : picture_(picture),
        surfaces_(*picture.surfaces),
        blocks_(blocks),
        gradient_(picture),
        tile_x_(static_cast<float>(x - picture.projection->center_x)),
        tile_y_(static_cast<float>(y - picture.projection->center_y)),
        columns_(static_cast<std::size_t>(picture.tile_size / kBlockWidth)) {}

  HWY_INLINE void prefetch(std::uint32_t) const {}
  HWY_INLINE bool begin(std::uint32_t cell) {
    blocks_.begin(cell);
    if (surfaces_.shading != Shading::none) gradient_.begin(cell);
    return true;
  }
  [[nodiscard]] HWY_INLINE bool wants(std::size_t block) const { return blocks_.wants(block); }

  HWY_INLINE void add(std::size_t block, Lanes covered, const BlockSegments& s) {
    for (const Surfaces::Surface& surface : surfaces_.surfaces) {
      const Float value = set(surface.value);
      // Half open, as preint::crosses: of two segments with a common end exactly one is crossed.
      const Lanes front_below = hn::Lt(s.front, value);
      const Lanes back_below = hn::Lt(s.back, value);
      const Lanes crossed = hn::And(covered, hn::Xor(front_below, back_below));
      if (hn::AllFalse(FloatTag(), crossed)) continue;
      const Float span = hn::IfThenElse(crossed, hn::Sub(s.back, s.front), set(1));
      const Float t = hn::Min(hn::Max(hn::Div(hn::Sub(value, s.front), span), set(0)), set(1));
      const Float depth = hn::MulAdd(t, hn::Sub(s.far, s.near), s.near);
      Fragment f;
      f.channel[0] = hn::Add(depth, depth);
      const Float opacity = hn::IfThenElseZero(crossed, set(surface.opacity));
      shade(surface, block, depth, opacity, f);
      f.channel[4] = opacity;
      blocks_.insert(block, crossed, f);
    }
  }

 private:
  HWY_INLINE void shade(const Surfaces::Surface& surface, std::size_t block, Float depth,
                        Float opacity, Fragment& f) const {
    Float diffuse = set(1);
    Float specular = set(0);
    if (surfaces_.shading != Shading::none) light(block, depth, diffuse, specular);
    for (std::size_t c = 0; c < 3; ++c) {
      const Float color = hn::MulAdd(set(surface.color[c]), diffuse, specular);
      f.channel[1 + c] = hn::Mul(opacity, color);
    }
  }

  /// shade_headlight: color * diffuse + specular.
  HWY_INLINE void light(std::size_t block, Float depth, Float& diffuse, Float& specular) const {
    const FloatTag d;
    const Projection& projection = *picture_.projection;
    const auto row = static_cast<float>(block / columns_ * static_cast<std::size_t>(kBlockHeight));
    const auto column =
        static_cast<float>(block % columns_ * static_cast<std::size_t>(kBlockWidth));
    const Float x = hn::Add(set(tile_x_ + column), lane_offsets(false));
    const Float y = hn::Add(set(tile_y_ + row), lane_offsets(true));
    CellGradient::Vector g;
    Float along = set(0);  // gradient . ray
    Float ray_square = set(1);
    if (projection.perspective) {
      const Float middle = set(static_cast<float>(projection.middle_depth));
      const Float beyond = hn::Mul(depth, middle);
      const Float z = hn::Add(beyond, middle);
      g = gradient_.at(hn::Mul(x, z), hn::Mul(y, z), beyond);
      const Float inverse = set(static_cast<float>(1 / projection.focal));
      const Float u = hn::Mul(x, inverse);
      const Float v = hn::Neg(hn::Mul(y, inverse));  // up
      along = hn::MulAdd(g[0], u, hn::MulAdd(g[1], v, g[2]));
      ray_square = hn::MulAdd(u, u, hn::MulAdd(v, v, set(1)));
    } else {
      g = gradient_.at(x, y, depth);
      along = g[2];
    }
    const Float square = hn::MulAdd(g[0], g[0], hn::MulAdd(g[1], g[1], hn::Mul(g[2], g[2])));
    const Lanes lit = hn::Lt(set(1e-30F), square);  // nothing has a direction below
    const Float cosine = hn::Min(
        hn::Div(hn::Abs(along), hn::Sqrt(hn::Mul(hn::IfThenElse(lit, square, set(1)), ray_square))),
        set(1));
    const Material& m = surfaces_.material;
    const Float reflected = hn::MulAdd(hn::Add(cosine, cosine), cosine, set(-1));
    const Float power = hn::Exp(d, hn::Mul(set(static_cast<float>(m.shininess)),
                                           hn::Log(d, hn::Max(reflected, set(1e-30F)))));
    diffuse = hn::IfThenElse(
        lit,
        hn::MulAdd(set(static_cast<float>(m.diffuse)), cosine, set(static_cast<float>(m.ambient))),
        set(1));
    specular = hn::IfThenElseZero(lit, hn::Mul(set(static_cast<float>(m.specular)), power));
  }

  const Picture& picture_;
  const Surfaces& surfaces_;
  OrderedBlocks& blocks_;
  CellGradient gradient_;
  float tile_x_;  // the tile's first pixel, from the camera's axis
  float tile_y_;
  std::size_t columns_;
};

}  // namespace tetraglass::project::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
