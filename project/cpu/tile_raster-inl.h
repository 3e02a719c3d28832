// Walks over the blocks of pixels that cells cover, and finds the segment of every ray in every
// cell. Compiled for each instruction set: included only by tile_kernel.cpp, after highway.h.

#if defined(TETRAGLASS_PROJECT_CPU_TILE_RASTER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRAGLASS_PROJECT_CPU_TILE_RASTER_INL_H_
#undef TETRAGLASS_PROJECT_CPU_TILE_RASTER_INL_H_
#else
#define TETRAGLASS_PROJECT_CPU_TILE_RASTER_INL_H_
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "project/cpu/face_planes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tetraglass::project::cpu::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A vector holds a block of pixels, row by row: 4 x 4 where it has 16 lanes.
using FloatTag = hn::CappedTag<float, 16>;
using Float = hn::Vec<FloatTag>;
using Lanes = hn::Mask<FloatTag>;
inline constexpr std::size_t kLanes = hn::MaxLanes(FloatTag());
inline constexpr int kBlockWidth = kLanes < 4 ? 1 : 4;
inline constexpr int kBlockHeight = static_cast<int>(kLanes) / kBlockWidth;
inline constexpr std::size_t kTilePixels = std::size_t{kLargestTile} * kLargestTile;

HWY_INLINE Float set(float value) {
  return hn::Set(FloatTag(), value);
}

/// To about 2^-23.
HWY_INLINE Float reciprocal(Float x) {
  const Float guess = hn::ApproximateReciprocal(x);
  return hn::Mul(guess, hn::NegMulAdd(x, guess, set(2.0F)));
}

/// The segments of a block's rays in one cell.
struct BlockSegments {
  Float entry;  ///< depth (see FaceBatch)
  Float exit;
  Float front;  ///< scaled values, without meaning where the shader has no use for them
  Float back;
  Float length;  ///< in units of the projection's radius
  Float near;    ///< z / m - 1 of the entry, in parallel views its depth
  Float far;     ///< ... and of the exit
};

/// The horizontal or vertical pixel offset of each lane in its block.
HWY_INLINE Float lane_offsets(bool vertical) {
  alignas(64) std::array<float, kLanes> offset{};
  for (std::size_t i = 0; i < kLanes; ++i) {
    const int lane = static_cast<int>(i);
    offset[i] = static_cast<float>(vertical ? lane / kBlockWidth : lane % kBlockWidth);
  }
  return hn::Load(FloatTag(), offset.data());
}

/// The length of a ray between two depths, in units of the projection's radius, divided by the
/// product of depth difference and both z / m; [pixel of block by block]. Perspective only.
HWY_INLINE void fill_stretch(const Projection& projection, int tile_x, int tile_y, int tile_size,
                             float* stretch) {
  const auto inverse = static_cast<float>(1 / projection.focal);
  const Float unit = set(static_cast<float>(projection.middle_depth));
  const Float dx = lane_offsets(false);
  const Float dy = lane_offsets(true);
  for (int y = 0; y < tile_size / kBlockHeight; ++y) {
    const auto top = static_cast<float>(tile_y + y * kBlockHeight - projection.center_y);
    const Float v = hn::Mul(hn::Add(set(top), dy), set(inverse));
    const Float rest = hn::MulAdd(v, v, set(1.0F));
    for (int x = 0; x < tile_size / kBlockWidth; ++x) {
      const auto left = static_cast<float>(tile_x + x * kBlockWidth - projection.center_x);
      const Float u = hn::Mul(hn::Add(set(left), dx), set(inverse));
      hn::Store(hn::Mul(unit, hn::Sqrt(hn::MulAdd(u, u, rest))), FloatTag(), stretch);
      stretch += kLanes;
    }
  }
}

/// A pixel of a tile as its buffers have it.
struct PixelPlace {
  std::size_t block;
  std::size_t lane;
};

HWY_INLINE PixelPlace place_of(int tile_size, int x, int y) {
  const int block = y / kBlockHeight * (tile_size / kBlockWidth) + x / kBlockWidth;
  const int lane = (y % kBlockHeight) * kBlockWidth + x % kBlockWidth;
  return {static_cast<std::size_t>(block), static_cast<std::size_t>(lane)};
}

/// The part of the rays of a tile that clip planes and the ends of rays keep, near and far of block
/// by block.
HWY_INLINE void fill_clipped(const Picture& picture, int tile_x, int tile_y, float* depths) {
  for (int y = 0; y < picture.tile_size; ++y) {
    for (int x = 0; x < picture.tile_size; ++x) {
      const PixelPlace pixel = place_of(picture.tile_size, x, y);
      const ClippedDepths kept = clipped_depths(picture.clip, picture.ends, *picture.frame,
                                                *picture.projection, tile_x + x, tile_y + y);
      float* place = depths + 2 * pixel.block * kLanes + pixel.lane;
      place[0] = kept.near;
      place[kLanes] = kept.far;
    }
  }
}

/// The faces of a cell, front faces first, by the bits of the front faces.
inline constexpr auto kFrontToBack = [] {
  std::array<std::array<std::uint8_t, 4>, 16> orders{};
  for (unsigned front = 0; front < 16; ++front) {
    std::size_t next = 0;
    for (unsigned side = 2; side-- > 0;) {
      for (std::uint8_t k = 0; k < 4; ++k) {
        if ((front >> k & 1U) == side) orders[front][next++] = k;
      }
    }
  }
  return orders;
}();

/// Feeds a shader with the segments of a tile. A shader has
///   static constexpr bool kValues;        whether it reads front and back
///   static constexpr bool kKeys;          whether it reads near and far
///   void prefetch(std::uint32_t cell);    what begin() will read
///   bool begin(std::uint32_t cell);       false: the cell shows nothing
///   bool wants(std::size_t block);        false: the segments there show nothing
///   void add(std::size_t block, Lanes covered, const BlockSegments&);
template <bool kPerspective, class Shader>
class TileRaster {
 public:
  /// `stretch`: from fill_stretch (perspective only). `clipped`: from fill_clipped, null where
  /// nothing is clipped.
  TileRaster(const Picture& picture, int tile_x, int tile_y, const float* stretch,
             const float* clipped, Shader& shader)
      : picture_(picture),
        shader_(shader),
        tile_x_(tile_x),
        tile_y_(tile_y),
        tile_size_(picture.tile_size),
        stretch_(stretch),
        clipped_(clipped),
        in_block_x_(lane_offsets(false)),
        in_block_y_(lane_offsets(true)) {}

  /// Returns the number of segments.
  std::uint64_t draw(std::span<const std::uint32_t> cells) {
    const Projection& projection = *picture_.projection;
    const TileOrigin origin = {projection.center_x - (tile_x_ + tile_size_ / 2),
                               projection.center_y - (tile_y_ + tile_size_ / 2)};
    std::array<std::uint32_t, kBatch> numbers;
    for (std::size_t first = 0; first < cells.size(); first += kBatch) {
      const std::size_t count = std::min(kBatch, cells.size() - first);
      for (std::size_t i = 0; i < kBatch; ++i) numbers[i] = cells[first + std::min(i, count - 1)];
      prefetch(cells, first + kBatch);
      FaceSetup<kPerspective, Shader::kValues>::set_up(picture_, origin, numbers.data(), batch_);
      for (std::size_t i = 0; i < count; ++i) draw_cell(numbers[i], i);
    }
    return segments_;
  }

 private:
  /// Asks for what the batch after the next and, of its points, the next will read: cells lie
  /// anywhere in memory.
  HWY_INLINE void prefetch(std::span<const std::uint32_t> cells, std::size_t next) const {
    const DrawnCell* drawn = picture_.cells->cells.data();
    const ViewPoint* points = picture_.points->exact.data();
    for (std::size_t i = next + kBatch; i < std::min(next + 2 * kBatch, cells.size()); ++i) {
      hwy::Prefetch(drawn + cells[i]);
      shader_.prefetch(cells[i]);
    }
    for (std::size_t i = next; i < std::min(next + kBatch, cells.size()); ++i) {
      for (const std::uint32_t v : drawn[cells[i]].vertices) hwy::Prefetch(points + v);
    }
  }

  /// A plane of one cell, in all lanes.
  struct Plane {
    Float start, dx, dy;
  };

  /// Where a front face and a back face of a flat cell meet: the difference of their depths, taken
  /// before it is rounded, which is not negative in the silhouette.
  struct Silhouette {
    struct Line {
      double start;
      double dx;
      double dy;
    };
    std::size_t count = 0;  ///< 0: the cell is not flat
    std::array<Line, 4> lines;
  };

  /// The same in double, evaluated once per block: what a steep plane needs. It is the face that is
  /// steep, so that both cells at it do the same.
  struct ExactPlane {
    double start = 0;
    double dx = 0;
    double dy = 0;
    bool steep = false;
    bool edge_on = false;  ///< so steep that each lane needs it
  };

  /// The slope of depths per pixel above which a face counts as seen edge on: 2^-22 pixels are then
  /// 2^-20 (see FaceBatch::steep).
  static constexpr double kEdgeOn = 4;

  template <std::size_t kFaces>
  struct CellPlanes {
    std::array<Plane, kFaces> depth;
    std::array<Plane, kFaces> value;
    std::array<ExactPlane, kFaces> exact_depth;
    std::array<ExactPlane, kFaces> exact_value;
  };

  static HWY_INLINE Plane plane(const Planes& planes, std::size_t face, std::size_t i) {
    return {set(planes.rounded.start[face][i]), set(planes.rounded.dx[face][i]),
            set(planes.rounded.dy[face][i])};
  }

  template <std::size_t kFaces>
  HWY_INLINE void load_planes(std::size_t face, std::size_t i, std::size_t k,
                              CellPlanes<kFaces>& planes) const {
    planes.depth[k] = plane(batch_.depth, face, i);
    if constexpr (Shader::kValues) planes.value[k] = plane(batch_.value, face, i);
  }

  template <std::size_t kFaces>
  HWY_INLINE void load_exact_planes(std::size_t face, std::size_t i, std::size_t k,
                                    CellPlanes<kFaces>& planes) const {
    const bool steep = (batch_.steep[i] >> face & 1U) != 0;
    const bool edge_on =
        steep && std::abs(batch_.depth.dx[face][i]) + std::abs(batch_.depth.dy[face][i]) > kEdgeOn;
    const auto load = [&](const Planes& from) {
      return ExactPlane{from.start[face][i], from.dx[face][i], from.dy[face][i], steep, edge_on};
    };
    planes.exact_depth[k] = load(batch_.depth);
    if constexpr (Shader::kValues) planes.exact_value[k] = load(batch_.value);
  }

  /// The plane at the pixels of the block whose first pixel lies at (x, y) from the tile's middle.
  HWY_INLINE Float at_block(const ExactPlane& p, const Plane& rounded, int x, int y) const {
    if (HWY_UNLIKELY(p.edge_on)) return at_lanes(p, x, y);
    const double first = p.start + p.dx * x + p.dy * y;
    return hn::MulAdd(rounded.dx, in_block_x_,
                      hn::MulAdd(rounded.dy, in_block_y_, set(static_cast<float>(first))));
  }

  /// The same in double in every lane. Within the block, floats move a plane by up to 2^-22 pixels:
  /// depth and value of a face seen nearly edge on would be moved apart, and no longer belong to
  /// one point.
  HWY_NOINLINE Float at_lanes(const ExactPlane& p, int x, int y) const {
    alignas(64) std::array<float, kLanes> result;
    for (std::size_t i = 0; i < kLanes; ++i) {
      const int lane = static_cast<int>(i);
      const double at = p.start + p.dx * (x + lane % kBlockWidth) + p.dy * (y + lane / kBlockWidth);
      result[i] = static_cast<float>(std::clamp(at, -1e30, 1e30));
    }
    return hn::Load(FloatTag(), result.data());
  }

  HWY_INLINE void draw_cell(std::uint32_t cell, std::size_t i) {
    const unsigned front = batch_.front[i];
    // All faces in front: the eye is on one of them, and the cell behind it.
    if (front == 15) return;
    const DrawnCell& drawn = picture_.cells->cells[cell];
    if (!shader_.begin(cell)) return;
    const PixelBounds& bounds = drawn.bounds;
    first_x_ = std::max(bounds.first_x - tile_x_, 0) / kBlockWidth;
    first_y_ = std::max(bounds.first_y - tile_y_, 0) / kBlockHeight;
    last_x_ = std::min(bounds.last_x - tile_x_, tile_size_ - 1) / kBlockWidth;
    last_y_ = std::min(bounds.last_y - tile_y_, tile_size_ - 1) / kBlockHeight;
    if (!is_wanted()) return;
    if constexpr (Shader::kValues) set_value_range(drawn.vertices);
    silhouette_.count = 0;
    if (kPerspective && front == 0) {
      draw_around_eye(drawn.vertices, i);
      return;
    }
    if (HWY_UNLIKELY(batch_.flat[i] != 0)) find_silhouette(i);
    const std::array<std::uint8_t, 4>& face = kFrontToBack[front];
    CellPlanes<4> planes;
    for (std::size_t k = 0; k < 4; ++k) load_planes(face[k], i, k, planes);
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const float second = (front >> face[1] & 1U) != 0 ? kInfinity : -kInfinity;
    const float third = (front >> face[2] & 1U) != 0 ? kInfinity : -kInfinity;
    if (HWY_LIKELY(batch_.steep[i] == 0 && batch_.flat[i] == 0)) {
      draw_blocks<4, false>(planes, second, third);
    } else {
      for (std::size_t k = 0; k < 4; ++k) load_exact_planes(face[k], i, k, planes);
      draw_blocks<4, true>(planes, second, third);
    }
  }

  /// Whether any block of the cell in work is.
  [[nodiscard]] HWY_INLINE bool is_wanted() const {
    const int columns = tile_size_ / kBlockWidth;
    for (int by = first_y_; by <= last_y_; ++by) {
      for (int bx = first_x_; bx <= last_x_; ++bx) {
        if (shader_.wants(static_cast<std::size_t>(by * columns + bx))) return true;
      }
    }
    return false;
  }

  HWY_NOINLINE void find_silhouette(std::size_t i) {
    const Planes& depth = batch_.depth;
    for (std::size_t f = 0; f < 4; ++f) {
      if ((batch_.front[i] >> f & 1U) == 0) continue;
      for (std::size_t b = 0; b < 4; ++b) {
        if ((batch_.front[i] >> b & 1U) != 0) continue;
        silhouette_.lines[silhouette_.count++] = {depth.start[b][i] - depth.start[f][i],
                                                  depth.dx[b][i] - depth.dx[f][i],
                                                  depth.dy[b][i] - depth.dy[f][i]};
      }
    }
  }

  /// The lanes of the block whose first pixel lies at (x, y) from the tile's middle that are in the
  /// silhouette.
  HWY_NOINLINE Lanes in_silhouette(int x, int y) const {
    Lanes result = hn::FirstN(FloatTag(), kLanes);
    for (std::size_t k = 0; k < silhouette_.count; ++k) {
      const typename Silhouette::Line& line = silhouette_.lines[k];
      // Scaled: differences may be too small for floats, and those of faces seen edge on too large.
      const double scale =
          1 / (std::abs(line.dx) + std::abs(line.dy) + std::numeric_limits<double>::min());
      const double first = (line.start + line.dx * x + line.dy * y) * scale;
      const Float at =
          hn::MulAdd(set(static_cast<float>(line.dx * scale)), in_block_x_,
                     hn::MulAdd(set(static_cast<float>(line.dy * scale)), in_block_y_,
                                set(static_cast<float>(std::clamp(first, -1e30, 1e30)))));
      result = hn::And(result, hn::Le(set(0), at));
    }
    return result;
  }

  /// The eye is inside the cell: all faces are back faces, and the rays start at the eye, that is
  /// at z / m of 2^-30.
  HWY_NOINLINE void draw_around_eye(const mesh::Cell& vertices, std::size_t i) {
    constexpr float kNearest = 0x1p30F;
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    CellPlanes<5> planes;
    const Float zero = set(0);
    planes.depth[0] = {set(-kNearest), zero, zero};
    const auto at_eye = static_cast<float>(value_at_eye(vertices, *picture_.points));
    planes.value[0] = {set((1 + kNearest) * at_eye), zero, zero};
    for (std::size_t k = 0; k < 4; ++k) {
      load_planes(k, i, k + 1, planes);
      load_exact_planes(k, i, k + 1, planes);
    }
    draw_blocks<5, true>(planes, -kInfinity, -kInfinity);
  }

  HWY_INLINE void set_value_range(const mesh::Cell& vertices) {
    const std::vector<ViewPoint>& points = picture_.points->exact;
    float low = std::numeric_limits<float>::infinity();
    float high = -low;
    for (const std::uint32_t v : vertices) {
      low = std::min(low, static_cast<float>(points[v].value));
      high = std::max(high, static_cast<float>(points[v].value));
    }
    low_ = set(low);
    high_ = set(high);
  }

  /// Planes in the order of kFrontToBack; `second` and `third` are +infinity where these faces are
  /// front faces, -infinity where they are back faces; what comes after them are back faces.
  /// `kCareful`: the cell is flat or has steep faces.
  template <std::size_t kFaces, bool kCareful>
  HWY_INLINE void draw_blocks(const CellPlanes<kFaces>& planes, float second, float third) {
    const Float side1 = set(second);
    const Float side2 = set(third);
    // What the stores of the shader cannot change.
    const int first_x = first_x_;
    const int last_x = last_x_;
    const int last_y = last_y_;
    const int half_tile = tile_size_ / 2;
    const int columns = tile_size_ / kBlockWidth;
    const Float in_block_x = in_block_x_;
    std::uint64_t segments = 0;
    for (int by = first_y_; by <= last_y; ++by) {
      const int top = by * kBlockHeight - half_tile;
      const Float y = hn::Add(in_block_y_, set(static_cast<float>(top)));
      std::array<Float, kFaces> row;
      for (std::size_t k = 0; k < kFaces; ++k) {
        row[k] = hn::MulAdd(planes.depth[k].dy, y, planes.depth[k].start);
      }
      for (int bx = first_x; bx <= last_x; ++bx) {
        const auto block = static_cast<std::size_t>(by * columns + bx);
        if (!shader_.wants(block)) continue;
        const int left = bx * kBlockWidth - half_tile;
        const Float x = hn::Add(in_block_x, set(static_cast<float>(left)));
        std::array<Float, kFaces> p;
        for (std::size_t k = 0; k < kFaces; ++k) {
          p[k] = hn::MulAdd(planes.depth[k].dx, x, row[k]);
          if constexpr (kCareful) {
            if (planes.exact_depth[k].steep)
              p[k] = at_block(planes.exact_depth[k], planes.depth[k], left, top);
          }
        }
        // A second or third face counts on one side only: on the other, infinity stands for it.
        const Float entry1 = hn::Min(p[1], side1);
        const Float entry2 = hn::Min(p[2], side2);
        const Float exit1 = hn::Max(p[1], side1);
        const Float exit2 = hn::Max(p[2], side2);
        BlockSegments s;
        s.entry = hn::Max(p[0], hn::Max(entry1, entry2));
        s.exit = hn::Min(p[3], hn::Min(exit1, exit2));
        if constexpr (kFaces == 5) s.exit = hn::Min(s.exit, p[4]);
        Lanes covered = hn::Lt(s.entry, s.exit);
        if constexpr (kCareful) {
          if (silhouette_.count != 0) covered = in_silhouette(left, top);
        }
        // What lies behind the eye has 1 - m / z > 1.
        if constexpr (kPerspective) covered = hn::And(covered, hn::Lt(s.exit, set(1)));
        if (hn::AllFalse(FloatTag(), covered)) continue;
        if constexpr (Shader::kValues) {
          std::array<Float, kFaces> v;
          for (std::size_t k = 0; k < kFaces; ++k) {
            const Plane& value = planes.value[k];
            v[k] = hn::MulAdd(value.dx, x, hn::MulAdd(value.dy, y, value.start));
            if constexpr (kCareful) {
              if (planes.exact_value[k].steep)
                v[k] = at_block(planes.exact_value[k], value, left, top);
            }
          }
          s.front = hn::IfThenElse(hn::Eq(s.entry, entry1), v[1], v[0]);
          s.front = hn::IfThenElse(hn::Eq(s.entry, entry2), v[2], s.front);
          s.back = hn::IfThenElse(hn::Eq(s.exit, exit1), v[1], v[3]);
          s.back = hn::IfThenElse(hn::Eq(s.exit, exit2), v[2], s.back);
          if constexpr (kFaces == 5) s.back = hn::IfThenElse(hn::Eq(s.exit, p[4]), v[4], s.back);
        }
        if constexpr (kCareful) {
          if (silhouette_.count != 0) s.exit = hn::Max(s.entry, s.exit);
        }
        if (HWY_UNLIKELY(clipped_ != nullptr)) {
          covered = clip(block, covered, s);
          if (hn::AllFalse(FloatTag(), covered)) continue;
        }
        finish(block, s);
        segments += hn::CountTrue(FloatTag(), covered);
        shader_.add(block, covered, s);
      }
    }
    segments_ += segments;
  }

  /// Cuts segments; returns the lanes where something is left. Depths, and values as the faces have
  /// them, are linear along each ray.
  HWY_NOINLINE Lanes clip(std::size_t block, Lanes covered, BlockSegments& s) const {
    const float* kept = clipped_ + 2 * block * kLanes;
    const Float entry = hn::Max(s.entry, hn::Load(FloatTag(), kept));
    const Float exit = hn::Min(s.exit, hn::Load(FloatTag(), kept + kLanes));
    const Lanes left = hn::And(covered, hn::Lt(entry, exit));
    if constexpr (Shader::kValues) {
      const Float inverse = hn::Div(set(1), hn::IfThenElse(left, hn::Sub(s.exit, s.entry), set(1)));
      const Float rise = hn::Mul(hn::Sub(s.back, s.front), inverse);
      // From the exit: a segment that starts at the eye starts with numbers beyond measure.
      s.front = hn::MulAdd(rise, hn::Sub(entry, s.exit), s.back);
      s.back = hn::MulAdd(rise, hn::Sub(exit, s.exit), s.back);
    }
    s.entry = entry;
    s.exit = exit;
    return left;
  }

  /// Lengths, and in perspective values, from what is linear over the picture.
  HWY_INLINE void finish(std::size_t block, BlockSegments& s) const {
    const Float depth = hn::Sub(s.exit, s.entry);
    if constexpr (kPerspective) {
      const Float near = reciprocal(hn::Sub(set(1), s.entry));  // z / m
      const Float far = reciprocal(hn::Sub(set(1), s.exit));
      const Float stretch = hn::Load(FloatTag(), stretch_ + block * kLanes);
      s.length = hn::Mul(hn::Mul(depth, stretch), hn::Mul(near, far));
      // z / m - 1 = d / (1 - d) for the depth d = 1 - m / z: exact far away, where z / m is
      // nearly 1.
      if constexpr (Shader::kKeys) {
        s.near = hn::Mul(s.entry, near);
        s.far = hn::Mul(s.exit, far);
      }
      if constexpr (Shader::kValues) {
        s.front = hn::Mul(s.front, near);
        s.back = hn::Mul(s.back, far);
      }
    } else {
      s.length = depth;
      s.near = s.entry;
      s.far = s.exit;
    }
    if constexpr (Shader::kValues) {  // rounding of steep faces
      s.front = hn::Min(hn::Max(s.front, low_), high_);
      s.back = hn::Min(hn::Max(s.back, low_), high_);
    }
  }

  const Picture& picture_;
  Shader& shader_;
  int tile_x_;
  int tile_y_;
  int tile_size_;
  const float* stretch_;
  const float* clipped_;
  Float in_block_x_;
  Float in_block_y_;
  FaceBatch batch_;
  Silhouette silhouette_;
  // Of the cell in work: its blocks and the range of its values.
  int first_x_ = 0;
  int first_y_ = 0;
  int last_x_ = -1;
  int last_y_ = -1;
  Float low_ = set(0);
  Float high_ = set(0);
  std::uint64_t segments_ = 0;
};

}  // namespace tetraglass::project::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
