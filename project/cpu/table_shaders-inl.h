// What becomes of segments that are integrated by a lookup table, or from their ends alone.
// Compiled for each instruction set: included only by tile_kernel.cpp, after highway.h.

#if defined(TETRAGLASS_PROJECT_CPU_TABLE_SHADERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRAGLASS_PROJECT_CPU_TABLE_SHADERS_INL_H_
#undef TETRAGLASS_PROJECT_CPU_TABLE_SHADERS_INL_H_
#else
#define TETRAGLASS_PROJECT_CPU_TABLE_SHADERS_INL_H_
#endif

#include <array>
#include <cstdint>
#include <optional>

#include <hwy/highway.h>

#include "project/cpu/lookup_table.h"
#include "project/cpu/tile_shaders-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tetraglass::project::cpu::HWY_NAMESPACE {

/// Entries of a table between its samples: linear along each axis. Coordinates run from 0 to 1 and
/// are bounded so.
class TableLookup {
 public:
  explicit TableLookup(const LookupTable& table)
      : texels_(table.texels.data()), n_(table.n), m_(table.m), channels_(table.channels) {}

  /// In two dimensions.
  [[nodiscard]] HWY_INLINE Float at(Float front, Float back, int channel) const {
    const Step f = step(front, n_);
    const Step b = step(back, n_);
    return plane(f, b, index(f, b, channel));
  }

  /// In three.
  [[nodiscard]] HWY_INLINE std::array<Float, 4> at(Float front, Float back, Float length) const {
    const Step f = step(front, n_);
    const Step b = step(back, n_);
    const Step l = step(length, m_);
    const Index next = hn::Set(IntTag(), n_ * n_ * channels_);
    std::array<Float, 4> result;
    for (int c = 0; c < 4; ++c) {
      const Index first = hn::Add(index(f, b, c), hn::Mul(l.sample, next));
      const Float low = plane(f, b, first);
      const Float high = plane(f, b, hn::Add(first, next));
      result[static_cast<std::size_t>(c)] = mix(low, high, l.part);
    }
    return result;
  }

 private:
  using IntTag = hn::RebindToSigned<FloatTag>;
  using Index = hn::Vec<IntTag>;

  /// The sample before a coordinate, never the last one, and what follows of the way to the next.
  struct Step {
    Index sample;
    Float part;
  };

  static HWY_INLINE Step step(Float coordinate, int samples) {
    const Float last = set(static_cast<float>(samples - 1));
    const Float at = hn::Min(hn::Max(hn::Mul(coordinate, last), set(0)), last);
    const Index sample = hn::Min(hn::ConvertTo(IntTag(), at), hn::Set(IntTag(), samples - 2));
    return {sample, hn::Sub(at, hn::ConvertTo(FloatTag(), sample))};
  }

  [[nodiscard]] HWY_INLINE Index index(const Step& f, const Step& b, int channel) const {
    const Index pixel = hn::Add(hn::Mul(b.sample, hn::Set(IntTag(), n_)), f.sample);
    return hn::Add(hn::Mul(pixel, hn::Set(IntTag(), channels_)), hn::Set(IntTag(), channel));
  }

  static HWY_INLINE Float mix(Float from, Float to, Float part) {
    return hn::MulAdd(hn::Sub(to, from), part, from);
  }

  [[nodiscard]] HWY_INLINE Float plane(const Step& f, const Step& b, Index first) const {
    const FloatTag d;
    const Index column = hn::Set(IntTag(), channels_);
    const Index row = hn::Add(first, hn::Set(IntTag(), n_ * channels_));
    const Float low = mix(hn::GatherIndex(d, texels_, first),
                          hn::GatherIndex(d, texels_, hn::Add(first, column)), f.part);
    const Float high = mix(hn::GatherIndex(d, texels_, row),
                           hn::GatherIndex(d, texels_, hn::Add(row, column)), f.part);
    return mix(low, high, b.part);
  }

  const float* texels_;
  int n_;
  int m_;
  int channels_;
};

/// A medium along whole segments, by a table of it or from their ends.
class ApproximateMedium : public MediumShader {
 public:
  explicit ApproximateMedium(const Picture& picture) : MediumShader(picture) {
    if (picture.table == nullptr) return;
    lookup_.emplace(*picture.table);
    if (picture.integrator == Integrator::table3d) {
      inverse_length_ = 1 / picture.table->most_length;
    }
  }

 protected:
  [[nodiscard]] bool is_tabled() const { return lookup_.has_value(); }

  /// Of table2d and table3d what the table holds. From the ends: the mean color, by extinction
  /// where `weighted`, and the mean extinction.
  [[nodiscard]] HWY_INLINE std::array<Float, 4> mean(const BlockSegments& s, Float length,
                                                     Lanes covered, bool weighted = false) const {
    if (!lookup_) return of_ends(s, weighted);
    // Lanes that are not covered hold anything.
    const auto coordinate = [&](Float value) HWY_ATTR {
      return hn::IfThenElseZero(covered, hn::MulAdd(value, set(0.5F), set(0.5F)));
    };
    const Float front = coordinate(s.front);
    const Float back = coordinate(s.back);
    if (inverse_length_ > 0) {
      return lookup_->at(front, back, hn::Mul(length, set(inverse_length_)));
    }
    std::array<Float, 4> result;
    for (int c = 0; c < 4; ++c) {
      result[static_cast<std::size_t>(c)] = lookup_->at(front, back, c);
    }
    return result;
  }

 private:
  [[nodiscard]] HWY_INLINE std::array<Float, 4> of_ends(const BlockSegments& s,
                                                        bool weighted) const {
    const std::array<Float, 4> a = at(s.front);
    const std::array<Float, 4> b = at(s.back);
    const Float half = set(0.5F);
    std::array<Float, 4> result;
    for (std::size_t c = 0; c < 3; ++c) {
      const Float sum =
          weighted ? hn::MulAdd(a[3], a[c], hn::Mul(b[3], b[c])) : hn::Add(a[c], b[c]);
      result[c] = hn::Mul(half, sum);
    }
    result[3] = hn::Mul(half, hn::Add(a[3], b[3]));
    return result;
  }

  /// Color and extinction at values of the cell in work.
  [[nodiscard]] HWY_INLINE std::array<Float, 4> at(Float value) const {
    const auto in = [&](const MediumInterval& interval) HWY_ATTR {
      const Float inside = hn::Min(hn::Max(value, set(interval.low)), set(interval.high));
      const Float t = position(interval, inside);
      return std::array<Float, 4>{color(interval, 0, t), color(interval, 1, t),
                                  color(interval, 2, t), extinction(interval, t)};
    };
    std::array<Float, 4> result = in(medium_.intervals()[range_.first]);
    for (std::uint32_t k = range_.first + 1; k <= range_.last; ++k) {
      const MediumInterval& interval = medium_.intervals()[k];
      const Lanes here = hn::Le(set(interval.low), value);
      const std::array<Float, 4> found = in(interval);
      for (std::size_t c = 0; c < 4; ++c) result[c] = hn::IfThenElse(here, found[c], result[c]);
    }
    return result;
  }

  std::optional<TableLookup> lookup_;
  float inverse_length_ = 0;  // of table3d
};

/// int kappa c dl.
class ApproximateEmissionShader : public ApproximateMedium {
 public:
  ApproximateEmissionShader(const Picture& picture, int, int, float* sums)
      : ApproximateMedium(picture), sums_(sums, 0) {}

  HWY_INLINE void add(std::size_t block, Lanes covered, const BlockSegments& segments) {
    const BlockSegments s = with_cell_value(segments);
    const Float through = length(s, covered);
    const std::array<Float, 4> light = mean(s, through, covered, true);
    for (std::size_t c = 0; c < 3; ++c) {
      sums_.add(block, c, hn::IfThenElseZero(covered, hn::Mul(through, light[c])));
    }
  }

  [[nodiscard]] std::array<float, 4> pixel(std::size_t i) const {
    return {sums_.pixel(i, 0), sums_.pixel(i, 1), sums_.pixel(i, 2), 0};
  }

 private:
  BlockSums<3> sums_;
};

/// int kappa dl.
class ApproximateAbsorptionShader : public ApproximateMedium {
 public:
  ApproximateAbsorptionShader(const Picture& picture, int, int, float* sums)
      : ApproximateMedium(picture), sums_(sums, 0) {}

  HWY_INLINE void add(std::size_t block, Lanes covered, const BlockSegments& segments) {
    const BlockSegments s = with_cell_value(segments);
    const Float through = length(s, covered);
    const Float depth = hn::Mul(through, mean(s, through, covered)[3]);
    sums_.add(block, 0, hn::IfThenElseZero(covered, depth));
  }

  [[nodiscard]] std::array<float, 4> pixel(std::size_t i) const {
    return {0, 0, 0, -std::expm1(-sums_.pixel(i, 0))};
  }

 private:
  BlockSums<1> sums_;
};

/// The largest color of each channel, by a table.
class TabledMaximumShader : public ApproximateMedium {
 public:
  TabledMaximumShader(const Picture& picture, int, int, float* largest)
      : ApproximateMedium(picture), largest_(largest, kNone) {}

  HWY_INLINE void add(std::size_t block, Lanes covered, const BlockSegments& segments) {
    const BlockSegments s = with_cell_value(segments);
    const std::array<Float, 4> most = mean(s, set(0), covered);
    for (std::size_t c = 0; c < 3; ++c) {
      largest_.raise(block, c, hn::IfThenElse(covered, most[c], set(kNone)));
    }
  }

  [[nodiscard]] std::array<float, 4> pixel(std::size_t i) const {
    if (largest_.pixel(i, 0) == kNone) return {};
    return {largest_.pixel(i, 0), largest_.pixel(i, 1), largest_.pixel(i, 2), 1};
  }

 private:
  static constexpr float kNone = std::numeric_limits<float>::lowest();
  BlockSums<3> largest_;
};

}  // namespace tetraglass::project::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
