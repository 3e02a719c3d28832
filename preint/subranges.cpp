#include "preint/subranges.h"

#include <algorithm>
#include <array>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "preint/subranges.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tetraglass::preint::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, kMostLanes>;
using V = hn::Vec<Doubles>;

std::size_t lanes() {
  return hn::Lanes(Doubles());
}

/// 1 / m!
constexpr std::array<double, 33> inverse_factorials() {
  std::array<double, 33> result{1};
  for (std::size_t m = 1; m < result.size(); ++m) {
    result[m] = result[m - 1] / static_cast<double>(m);
  }
  return result;
}

template <std::size_t kSize>
void evaluate(const SeriesInput& input, const double* lengths, double* cells) {
  static constexpr auto kInverse = inverse_factorials();
  const Doubles d;
  const std::size_t step = hn::Lanes(d);
  const V scale = hn::LoadU(d, lengths);
  const double longest = std::max(lengths[0], lengths[step - 1]);
  for (std::size_t cell = 0; cell < input.count; ++cell) {
    const double depth = input.depth[cell];
    std::size_t terms = 1;
    while (depth * longest > input.depth_of_terms[terms - 1]) ++terms;
    const double* moments = input.moments + cell * input.terms * (kSize - 1);
    const V x = hn::Neg(hn::Min(hn::Mul(scale, hn::Set(d, depth)), hn::Set(d, input.deepest)));
    // Horner's rule on series side by side: the latency of one hides behind the others.
    V q[kSize];
    for (V& sum : q) sum = hn::Zero(d);
    for (std::size_t m = terms; m-- > 0;) {
      const double* moment = moments + m * (kSize - 1);
      for (std::size_t i = 0; i < 3; ++i) q[i] = hn::MulAdd(q[i], x, hn::Set(d, moment[i]));
      q[3] = hn::MulAdd(q[3], x, hn::Set(d, kInverse[m + 1]));
      for (std::size_t i = 4; i < kSize; ++i) {
        q[i] = hn::MulAdd(q[i], x, hn::Set(d, moment[i - 1]));
      }
    }
    for (std::size_t i = 0; i < kSize; ++i) {
      if (i != 3) q[i] = hn::Mul(q[i], scale);
    }
    // -x q[3] is the opacity.
    q[3] = kSize == 4 ? hn::MulAdd(x, q[3], hn::Set(d, 1.0)) : hn::Neg(hn::Mul(x, q[3]));
    double* at = cells + cell * kSize * step;
    for (std::size_t i = 0; i < kSize; ++i) hn::StoreU(q[i], d, at + i * step);
  }
}

void evaluate_light(const SeriesInput& input, const double* lengths, double* cells) {
  evaluate<4>(input, lengths, cells);
}
void evaluate_ramped(const SeriesInput& input, const double* lengths, double* cells) {
  evaluate<8>(input, lengths, cells);
}

/// Front over back, into `back`.
HWY_INLINE void composite(const V (&front)[4], V /*front_cells*/, V (&back)[4]) {
  for (std::size_t i = 0; i < 3; ++i) back[i] = hn::MulAdd(front[3], back[i], front[i]);
  back[3] = hn::Mul(front[3], back[3]);
}

HWY_INLINE void composite(const V (&front)[8], V front_cells, V (&back)[8]) {
  const V t = hn::Sub(hn::Set(Doubles(), 1.0), front[3]);
  const V shift = hn::Mul(t, front_cells);
  for (std::size_t i = 4; i < 8; ++i) {
    back[i] = hn::MulAdd(shift, back[i - 4], hn::MulAdd(t, back[i], front[i]));
  }
  for (std::size_t i = 0; i < 4; ++i) back[i] = hn::MulAdd(t, back[i], front[i]);
}

template <std::size_t kSize>
HWY_INLINE void load(const double* from, V (&span)[kSize]) {
  const Doubles d;
  for (std::size_t i = 0; i < kSize; ++i) span[i] = hn::LoadU(d, from + i * hn::Lanes(d));
}

template <std::size_t kSize>
HWY_INLINE void set_to_nothing(V (&span)[kSize]) {
  for (V& v : span) v = hn::Zero(Doubles());
  if (kSize == 4) span[3] = hn::Set(Doubles(), 1.0);
}

/// A finished span, as doubles ...
template <std::size_t kSize>
HWY_INLINE void store(const V (&span)[kSize], double* out) {
  const Doubles d;
  for (std::size_t i = 0; i < kSize; i += 4) {
    hn::StoreInterleaved4(span[i], span[i + 1], span[i + 2], span[i + 3], d,
                          out + i * hn::Lanes(d));
  }
}

/// ... and as an entry.
HWY_INLINE void store(const V (&span)[4], float* out) {
  const hn::Rebind<float, Doubles> d;
  const V alpha = hn::Sub(hn::Set(Doubles(), 1.0), span[3]);
  hn::StoreInterleaved4(hn::DemoteTo(d, span[0]), hn::DemoteTo(d, span[1]),
                        hn::DemoteTo(d, span[2]), hn::DemoteTo(d, alpha), d, out);
}

/// The tails of the bin that begins at sample `bin`: tails[(cells of it) * block ...].
template <std::size_t kSize>
HWY_INLINE void compose_tails(const double* cells, std::size_t bin, std::size_t longest,
                              double* tails) {
  const Doubles d;
  const std::size_t step = hn::Lanes(d);
  V tail[kSize], next[kSize];
  set_to_nothing(tail);
  // Ranges of tails that begin before the first cell are never read.
  for (std::size_t t = 0; t <= std::min(longest, bin); ++t) {
    if (t > 0) {
      load(cells + (bin - t) * kSize * step, next);
      composite(next, hn::Set(d, 1.0), tail);
    }
    for (std::size_t i = 0; i < kSize; ++i) {
      hn::StoreU(tail[i], d, tails + (t * kSize + i) * step);
    }
  }
}

template <std::size_t kSize, class T>
void compose(const double* cells, std::size_t count, Run run, double* tails, T* spans) {
  const Doubles d;
  const hn::RebindToSigned<Doubles> integers;
  const std::size_t step = hn::Lanes(d);
  const std::size_t block = kSize * step;  // doubles of one cell or tail
  // How many cells the range of each lane has, and where its tail would be if all were in the tail.
  HWY_ALIGN double widths[kMostLanes] = {};
  HWY_ALIGN std::int64_t tail_places[kMostLanes] = {};
  for (std::size_t j = 0; j < step; ++j) {
    const std::size_t width = run.width(j);
    widths[j] = static_cast<double>(width);
    tail_places[j] = static_cast<std::int64_t>(width * block + j);
  }
  const V width = hn::Load(d, widths);
  const auto places = hn::Load(integers, tail_places);
  V tail[kSize], head[kSize], next[kSize];
  for (std::size_t bin = 0; bin < count; bin += run.narrowest) {
    compose_tails<kSize>(cells, bin, run.narrowest + step - 1, tails);
    set_to_nothing(head);
    for (std::size_t end = bin + 1; end <= std::min(bin + run.narrowest, count); ++end) {
      const std::size_t head_cells = end - bin;
      load(cells + (end - 1) * block, next);
      composite(head, hn::Set(d, static_cast<double>(head_cells - 1)), next);
      for (std::size_t i = 0; i < kSize; ++i) head[i] = next[i];
      const auto index =
          hn::Sub(places, hn::Set(integers, static_cast<std::int64_t>(head_cells * block)));
      for (std::size_t i = 0; i < kSize; ++i) {
        tail[i] = hn::GatherIndex(d, tails + i * step, index);
      }
      composite(tail, hn::Sub(width, hn::Set(d, static_cast<double>(head_cells))), next);
      store(next, spans + span_offset(kSize, step, end, 0));
    }
  }
}

void compose_light(const double* cells, std::size_t count, Run run, double* tails, double* spans) {
  compose<4>(cells, count, run, tails, spans);
}
void compose_ramped(const double* cells, std::size_t count, Run run, double* tails, double* spans) {
  compose<8>(cells, count, run, tails, spans);
}
void compose_rgba(const double* cells, std::size_t count, Run run, double* tails, float* rgba) {
  compose<4>(cells, count, run, tails, rgba);
}

}  // namespace tetraglass::preint::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tetraglass::preint {

HWY_EXPORT(lanes);
HWY_EXPORT(evaluate_light);
HWY_EXPORT(evaluate_ramped);
HWY_EXPORT(compose_light);
HWY_EXPORT(compose_ramped);
HWY_EXPORT(compose_rgba);

std::size_t run_lanes() {
  return HWY_DYNAMIC_DISPATCH(lanes)();
}

void evaluate_series(const SeriesInput& input, std::size_t span_size, const double* lengths,
                     double* cells) {
  if (span_size == 4) {
    HWY_DYNAMIC_DISPATCH(evaluate_light)(input, lengths, cells);
  } else {
    HWY_DYNAMIC_DISPATCH(evaluate_ramped)(input, lengths, cells);
  }
}

void compose_subranges(const double* cells, std::size_t count, std::size_t span_size, Run run,
                       double* tails, double* spans) {
  if (span_size == 4) {
    HWY_DYNAMIC_DISPATCH(compose_light)(cells, count, run, tails, spans);
  } else {
    HWY_DYNAMIC_DISPATCH(compose_ramped)(cells, count, run, tails, spans);
  }
}

void compose_entries(const double* cells, std::size_t count, Run run, double* tails, float* rgba) {
  HWY_DYNAMIC_DISPATCH(compose_rgba)(cells, count, run, tails, rgba);
}

}  // namespace tetraglass::preint
#endif  // HWY_ONCE
