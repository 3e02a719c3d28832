#include "preint/series_kernel.h"

#include <array>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "preint/series_kernel.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tetraglass::preint::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// 1 / m!
constexpr std::array<double, 33> inverse_factorials() {
  std::array<double, 33> result{1};
  for (std::size_t m = 1; m < result.size(); ++m) {
    result[m] = result[m - 1] / static_cast<double>(m);
  }
  return result;
}

void evaluate(const SeriesInput& input, std::size_t quantities, double* spans) {
  static constexpr auto kInverse = inverse_factorials();
  const hn::CappedTag<double, 8> d;
  using V = hn::Vec<decltype(d)>;
  const std::size_t lanes = hn::Lanes(d);
  const std::size_t stride = quantities == kLightQuantities ? 4 : 8;
  const auto terms = static_cast<std::size_t>(input.terms);
  const V scale = hn::Set(d, input.length);
  HWY_ALIGN double interleaved[32];
  const auto store = [&](V a, V b, V c, V e, std::size_t cell, std::size_t offset) {
    hn::StoreInterleaved4(a, b, c, e, d, interleaved);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      std::memcpy(spans + (cell + lane) * stride + offset, &interleaved[4 * lane], 32);
    }
  };
  for (std::size_t cell = 0; cell < input.count; cell += lanes) {
    const V depth = hn::Mul(scale, hn::LoadU(d, input.depth + cell));
    const V x = hn::Neg(hn::Min(depth, hn::Set(d, input.deepest)));
    // Horner's rule on four series side by side: the latency of one hides behind the others.
    V q0 = hn::Zero(d), q1 = q0, q2 = q0, q3 = q0;
    for (std::size_t m = terms; m-- > 0;) {
      const double* moment = input.moments + m * quantities * input.count + cell;
      q0 = hn::MulAdd(q0, x, hn::LoadU(d, moment));
      q1 = hn::MulAdd(q1, x, hn::LoadU(d, moment + input.count));
      q2 = hn::MulAdd(q2, x, hn::LoadU(d, moment + 2 * input.count));
      q3 = hn::MulAdd(q3, x, hn::Set(d, kInverse[m + 1]));
    }
    const V opacity = hn::Neg(hn::Mul(x, q3));
    const bool ramped = quantities == kRampedQuantities;
    store(hn::Mul(q0, scale), hn::Mul(q1, scale), hn::Mul(q2, scale),
          ramped ? opacity : hn::Sub(hn::Set(d, 1.0), opacity), cell, 0);
    if (!ramped) continue;
    q0 = q1 = q2 = q3 = hn::Zero(d);
    for (std::size_t m = terms; m-- > 0;) {
      const double* moment = input.moments + (m * quantities + 3) * input.count + cell;
      q0 = hn::MulAdd(q0, x, hn::LoadU(d, moment));
      q1 = hn::MulAdd(q1, x, hn::LoadU(d, moment + input.count));
      q2 = hn::MulAdd(q2, x, hn::LoadU(d, moment + 2 * input.count));
      q3 = hn::MulAdd(q3, x, hn::LoadU(d, moment + 3 * input.count));
    }
    store(hn::Mul(q0, scale), hn::Mul(q1, scale), hn::Mul(q2, scale), hn::Mul(q3, scale), cell, 4);
  }
}

}  // namespace tetraglass::preint::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tetraglass::preint {

HWY_EXPORT(evaluate);

void evaluate_series(const SeriesInput& input, std::size_t quantities, double* spans) {
  HWY_DYNAMIC_DISPATCH(evaluate)(input, quantities, spans);
}

}  // namespace tetraglass::preint
#endif  // HWY_ONCE
