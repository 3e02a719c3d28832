#include "sort/depth_keys.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sort/depth_keys.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tetraglass::sort::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Writes as many entries as vectors of `d` hold, from `begin` on; says where it ended. Products are
// rounded before they are added, whether or not the machine could do without.
template <bool kHasW, class D>
HWY_INLINE std::size_t write_vectors(D d, const DepthKeys& keys, const FixedPoints& points,
                                     const std::uint32_t* items, std::size_t begin,
                                     std::size_t count, KeyedItem* entries) {
  const hn::Rebind<std::int32_t, D> di;
  const hn::Rebind<std::uint32_t, D> du;
  const hn::Rebind<std::int64_t, D> di64;
  const hn::Rebind<std::uint64_t, D> du64;
  const auto square = hn::Set(d, keys.square);
  const auto linear_x = hn::Set(d, keys.linear.x());
  const auto linear_y = hn::Set(d, keys.linear.y());
  const auto linear_z = hn::Set(d, keys.linear.z());
  const auto farthest = hn::Set(d, keys.farthest);
  const auto scale = hn::Set(d, keys.scale);
  const auto last = hn::Set(d, 4294967295.0);  // 2^32 - 1
  const auto step = hn::Set(d, 0x1p-31);
  std::size_t i = begin;
  for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d)) {
    const auto coordinate = [&](const std::int32_t* fixed) {
      return hn::Mul(hn::PromoteTo(d, hn::LoadU(di, fixed + i)), step);
    };
    const auto x = coordinate(points.x);
    const auto y = coordinate(points.y);
    const auto z = coordinate(points.z);
    const auto w = [&] {
      if constexpr (kHasW) return coordinate(points.w);
      return hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
    }();
    const auto along =
        hn::Add(hn::Add(hn::Mul(linear_x, x), hn::Mul(linear_y, y)), hn::Mul(linear_z, z));
    const auto depth = hn::Add(hn::Mul(square, w), along);
    const auto steps = hn::Mul(hn::Sub(farthest, depth), scale);
    const auto key = hn::ConvertTo(di64, hn::Min(hn::Max(steps, hn::Zero(d)), last));
    hn::StoreU(hn::Or(hn::ShiftLeft<32>(hn::BitCast(du64, key)),
                      hn::PromoteTo(du64, hn::LoadU(du, items + i))),
               du64, entries + i);
  }
  return i;
}

template <bool kHasW>
void write_all(const DepthKeys& keys, const FixedPoints& points, const std::uint32_t* items,
               std::size_t count, KeyedItem* entries) {
  const std::size_t rest =
      write_vectors<kHasW>(hn::ScalableTag<double>(), keys, points, items, 0, count, entries);
  write_vectors<kHasW>(hn::CappedTag<double, 1>(), keys, points, items, rest, count, entries);
}

void write_entries(const DepthKeys& keys, const FixedPoints& points, const std::uint32_t* items,
                   std::size_t count, KeyedItem* entries) {
  (points.w == nullptr ? write_all<false> : write_all<true>)(keys, points, items, count, entries);
}

}  // namespace tetraglass::sort::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace tetraglass::sort {

HWY_EXPORT(write_entries);

std::int32_t in_steps(double x) {
  constexpr double kSteps = 0x1p31;
  return static_cast<std::int32_t>(std::clamp(std::rint(x * kSteps), -kSteps, kSteps - 1));
}

void write_entries(const DepthKeys& keys, const FixedPoints& points, const std::uint32_t* items,
                   std::size_t count, KeyedItem* entries) {
  HWY_DYNAMIC_DISPATCH(write_entries)(keys, points, items, count, entries);
}

}  // namespace tetraglass::sort

#endif
