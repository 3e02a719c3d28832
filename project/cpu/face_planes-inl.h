// The faces of cells as planes over the pixels of a tile, many cells at a time in vectors of
// doubles. Compiled for each instruction set: included only by tile_kernel.cpp, after highway.h.

#if defined(TETRAGLASS_PROJECT_CPU_FACE_PLANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRAGLASS_PROJECT_CPU_FACE_PLANES_INL_H_
#undef TETRAGLASS_PROJECT_CPU_FACE_PLANES_INL_H_
#else
#define TETRAGLASS_PROJECT_CPU_FACE_PLANES_INL_H_
#endif

#include <array>
#include <cstdint>
#include <span>

#include <hwy/highway.h>

#include "project/cpu/tile_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace tetraglass::project::cpu::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using DoubleTag = hn::CappedTag<double, 8>;
inline constexpr std::size_t kBatch = hn::MaxLanes(DoubleTag());

/// Functions that are linear over the tile: start + dx X + dy Y, (X, Y) from the tile's middle.
template <class T>
struct PlanesOf {
  alignas(64) std::array<std::array<T, kBatch>, 4> start;  // [face][cell]
  alignas(64) std::array<std::array<T, kBatch>, 4> dx;
  alignas(64) std::array<std::array<T, kBatch>, 4> dy;
};
struct Planes : PlanesOf<double> {
  PlanesOf<float> rounded;
};

/// The faces of a batch of cells. Face k lies opposite the cell's vertex k (ascending order).
///
/// Depths: in parallel views z. In perspective 1 - m / z with the projection's middle depth m,
/// which is linear over the picture, grows with z and is 0 where z = m. Values: in parallel views
/// the field; in perspective field * m / z. Both are functions of the face's three vertices alone:
/// the two cells at a face get them equal to the last bit.
struct FaceBatch {
  Planes depth;
  Planes value;
  std::array<std::uint8_t, kBatch> front;  ///< bit k: rays enter through face k, else they leave
  /// Bit k: over a tile, face k changes so much that floats would round it by more than 2^-20 (of
  /// the mesh's half diagonal, of the field's range).
  std::array<std::uint8_t, kBatch> steep;
  /// Not 0: the cell is so flat that floats cannot tell on which side of its silhouette a ray
  /// passes.
  std::array<std::uint8_t, kBatch> flat;
};

/// The slope per pixel above which a face is steep.
inline constexpr double kSteep = 0.5;

/// A cell is flat where, this far (in pixels) outside of its silhouette, its front faces may seem
/// to lie before its back faces: depths of faces are rounded four times on their way through
/// floats, by 2^-22 of their largest terms together.
inline constexpr double kSilhouette = 0x1p-6;
inline constexpr double kDepthRounding = 0x1p-22;

/// Where a tile lies: what is to be added to homogeneous pixels (times z in perspective) to make
/// them relative to its middle.
struct TileOrigin {
  double x;
  double y;
};

/// A face is at least this steep, times its slope along the picture: a face seen edge on is
/// replaced by one that is 2^-40 of its depth wide.
inline constexpr double kSteepest = 0x1p-40;

/// How far rays are moved, in pixels, to be decided on such a face. In the middle of a block (see
/// TileRaster::at_block) floats hold positions to 2^-23 of a pixel.
inline constexpr double kShiftRight = 0x1p-20;
inline constexpr double kShiftUp = 0x1p-21;

template <bool kPerspective, bool kValues>
class FaceSetup {
  using V = hn::Vec<DoubleTag>;
  static constexpr DoubleTag kD{};

  struct Vector {
    V x, y, z;
  };
  struct Vertex {
    Vector at;
    V value;
  };

  static HWY_INLINE Vector sub(const Vector& a, const Vector& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
  }
  // No fused multiply-add: the cross product of equal edges must vanish, that of exchanged ones
  // change its sign.
  static HWY_INLINE Vector cross(const Vector& a, const Vector& b) {
    return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)),
            hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
            hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
  }
  static HWY_INLINE V dot(const Vector& a, const Vector& b) {
    return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
  }

 public:
  /// `cells`: kBatch numbers of drawn cells.
  static void set_up(const Picture& picture, const TileOrigin& origin, const std::uint32_t* cells,
                     FaceBatch& batch) {
    std::array<Vertex, 4> v;
    for (std::size_t k = 0; k < 4; ++k) v[k] = load(picture, origin, cells, k);
    alignas(64) std::array<double, kBatch> sign;
    for (std::size_t i = 0; i < kBatch; ++i) {
      sign[i] = picture.cells->cells[cells[i]].mirrored ? -1.0 : 1.0;
      batch.front[i] = 0;
      batch.steep[i] = 0;
      batch.flat[i] = 0;
    }
    const V even = hn::Load(kD, sign.data());
    const V odd = hn::Neg(even);
    const V unit = hn::Set(kD, kPerspective ? picture.projection->middle_depth : 1.0);
    face(v[1], v[2], v[3], odd, unit, 0, batch);
    face(v[0], v[2], v[3], even, unit, 1, batch);
    face(v[0], v[1], v[3], odd, unit, 2, batch);
    face(v[0], v[1], v[2], even, unit, 3, batch);
    find_flat(picture.tile_size / 2, batch);
  }

 private:
  static HWY_INLINE Vertex load(const Picture& picture, const TileOrigin& origin,
                                const std::uint32_t* cells, std::size_t k) {
    alignas(64) std::array<std::array<double, kBatch>, 4> component;
    for (std::size_t i = 0; i < kBatch; ++i) {
      const ViewPoint& p = picture.points->exact[picture.cells->cells[cells[i]].vertices[k]];
      component[0][i] = p.x;
      component[1][i] = p.y;
      component[2][i] = p.z;
      component[3][i] = p.value;
    }
    Vertex vertex;
    vertex.at = {hn::Load(kD, component[0].data()), hn::Load(kD, component[1].data()),
                 hn::Load(kD, component[2].data())};
    vertex.value = hn::Load(kD, component[3].data());
    const V x = hn::Set(kD, origin.x);
    const V y = hn::Set(kD, origin.y);
    if constexpr (kPerspective) {
      vertex.at.x = hn::MulAdd(x, vertex.at.z, vertex.at.x);
      vertex.at.y = hn::MulAdd(y, vertex.at.z, vertex.at.y);
    } else {
      vertex.at.x = hn::Add(vertex.at.x, x);
      vertex.at.y = hn::Add(vertex.at.y, y);
    }
    return vertex;
  }

  /// Two faces with nearly the same plane: their depths differ by less than their rounding.
  static HWY_INLINE void find_flat(double half_tile, FaceBatch& batch) {
    std::array<V, 4> dx;
    std::array<V, 4> dy;
    std::array<V, 4> rounding;
    for (std::size_t k = 0; k < 4; ++k) {
      dx[k] = hn::Load(kD, batch.depth.dx[k].data());
      dy[k] = hn::Load(kD, batch.depth.dy[k].data());
      const V change = hn::Add(hn::Abs(dx[k]), hn::Abs(dy[k]));
      const V largest = hn::MulAdd(hn::Set(kD, half_tile), change,
                                   hn::Abs(hn::Load(kD, batch.depth.start[k].data())));
      rounding[k] = hn::Mul(hn::Set(kD, kDepthRounding / kSilhouette), largest);
    }
    auto flat = hn::Lt(dx[0], dx[0]);  // none
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = i + 1; k < 4; ++k) {
        const V slope = hn::Add(hn::Abs(hn::Sub(dx[i], dx[k])), hn::Abs(hn::Sub(dy[i], dy[k])));
        flat = hn::Or(flat, hn::Lt(slope, hn::Add(rounding[i], rounding[k])));
      }
    }
    set_bits(batch.flat, 0, flat);
  }

  static HWY_INLINE void store(Planes& planes, std::size_t k, V start, V dx, V dy) {
    hn::Store(start, kD, planes.start[k].data());
    hn::Store(dx, kD, planes.dx[k].data());
    hn::Store(dy, kD, planes.dy[k].data());
    const hn::Rebind<float, DoubleTag> f;
    hn::Store(hn::DemoteTo(f, start), f, planes.rounded.start[k].data());
    hn::Store(hn::DemoteTo(f, dx), f, planes.rounded.dx[k].data());
    hn::Store(hn::DemoteTo(f, dy), f, planes.rounded.dy[k].data());
  }

  /// Sets bit k of those cells that the mask holds for.
  static HWY_INLINE void set_bits(std::array<std::uint8_t, kBatch>& bits, std::size_t k,
                                  hn::Mask<DoubleTag> mask) {
    alignas(8) std::array<std::uint8_t, 8> packed{};
    hn::StoreMaskBits(kD, mask, packed.data());
    for (std::size_t i = 0; i < kBatch; ++i) {
      bits[i] = static_cast<std::uint8_t>(bits[i] | ((packed[0] >> i & 1U) << k));
    }
  }

  /// What moving the ray adds to a plane of this slope.
  static HWY_INLINE V shift(V dx, V dy) {
    return hn::Sub(hn::Mul(dx, hn::Set(kD, kShiftRight)), hn::Mul(dy, hn::Set(kD, kShiftUp)));
  }

  /// The face with vertices a, b, c (ascending). `inside`: the sign of ((b - a) x (c - a)).(v - a)
  /// of the fourth vertex v, known without rounding from the orientation of the cell.
  static HWY_INLINE void face(const Vertex& a, const Vertex& b, const Vertex& c, V inside, V unit,
                              std::size_t k, FaceBatch& batch) {
    const Vector e1 = sub(b.at, a.at);
    const Vector e2 = sub(c.at, a.at);
    const Vector n = cross(e1, e2);
    // The plane n.P = n.a in camera space; its depth is a quotient by `facing`, which is 0 where
    // the face is seen edge on.
    const V facing = kPerspective ? dot(n, a.at) : n.z;
    V slope = hn::Add(hn::Abs(n.x), hn::Abs(n.y));
    if constexpr (kPerspective) slope = hn::Add(slope, hn::Abs(n.z));
    // Never 0: the smallest normal number, for faces too small for their normal.
    const V least = hn::Max(hn::Mul(slope, hn::Set(kD, kSteepest)), hn::Set(kD, 0x1p-1022));
    const auto edge_on = hn::Lt(hn::Abs(facing), least);
    const V bounded = hn::CopySign(hn::Max(hn::Abs(facing), least), facing);
    const V inverse = hn::Div(unit, bounded);

    set_bits(batch.front, k, hn::Lt(hn::Zero(kD), hn::Mul(inside, bounded)));
    const V minus = hn::Neg(inverse);
    const V dx = hn::Mul(n.x, minus);
    const V dy = hn::Mul(n.y, minus);
    V start;
    if constexpr (kPerspective) {
      start = hn::MulAdd(n.z, minus, hn::Set(kD, 1.0));
    } else {
      start = hn::Sub(a.at.z, hn::MulAdd(dx, a.at.x, hn::Mul(dy, a.at.y)));
    }
    start = hn::Add(start, hn::IfThenElseZero(edge_on, shift(dx, dy)));
    store(batch.depth, k, start, dx, dy);
    const V steep = hn::Set(kD, kSteep);
    // Depths of perspective views are in units of the middle depth.
    auto is_steep = hn::Lt(steep, hn::Mul(unit, hn::Add(hn::Abs(dx), hn::Abs(dy))));
    if constexpr (kValues) {
      const V slope_of_values = values(a, b, c, e1, e2, n, inverse, edge_on, k, batch);
      is_steep = hn::Or(is_steep, hn::Lt(steep, slope_of_values));
    }
    set_bits(batch.steep, k, is_steep);
  }

  /// The field on the face: in parallel views the linear function of (X, Y) through the values at
  /// the vertices. In perspective the function g with g.P = value at the three vertices, which
  /// divided by z is linear in (X, Y) = (P.x, P.y) / z. Returns the slope.
  static HWY_INLINE V values(const Vertex& a, const Vertex& b, const Vertex& c, const Vector& e1,
                             const Vector& e2, const Vector& n, V inverse,
                             hn::Mask<DoubleTag> edge_on, std::size_t k, FaceBatch& batch) {
    const V d1 = hn::Sub(b.value, a.value);
    const V d2 = hn::Sub(c.value, a.value);
    const Vector w = {hn::Sub(hn::Mul(d1, e2.x), hn::Mul(d2, e1.x)),
                      hn::Sub(hn::Mul(d1, e2.y), hn::Mul(d2, e1.y)),
                      hn::Sub(hn::Mul(d1, e2.z), hn::Mul(d2, e1.z))};
    V start;
    V dx;
    V dy;
    if constexpr (kPerspective) {
      const Vector g = cross(w, a.at);
      start = hn::Mul(hn::MulAdd(a.value, n.z, g.z), inverse);
      dx = hn::Mul(hn::MulAdd(a.value, n.x, g.x), inverse);
      dy = hn::Mul(hn::MulAdd(a.value, n.y, g.y), inverse);
    } else {
      dx = hn::Mul(w.y, inverse);
      dy = hn::Neg(hn::Mul(w.x, inverse));
      start = hn::Sub(a.value, hn::MulAdd(dx, a.at.x, hn::Mul(dy, a.at.y)));
    }
    start = hn::Add(start, hn::IfThenElseZero(edge_on, shift(dx, dy)));
    store(batch.value, k, start, dx, dy);
    return hn::Add(hn::Abs(dx), hn::Abs(dy));
  }
};

}  // namespace tetraglass::project::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
