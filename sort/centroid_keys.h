#pragma once

#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

#include "sort/key_sort.h"

namespace tetraglass::sort {

/// Keys of the depths square |v|^2 + linear . v of points v: 0 at the depth `farthest`, growing by
/// 1 with every 1 / scale that a point is nearer, up to 2^32 - 1.
struct DepthKeys {
  double square = 0;
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();
  double farthest = 0;
  double scale = 0;
};

/// Coordinates of points, in steps of 2^-31.
struct FixedPoints {
  const std::int32_t* x;
  const std::int32_t* y;
  const std::int32_t* z;
};

/// Writes for `count` points the keys of their depths with their items. By vectors of whatever the
/// machine has, with the same result on all of them.
void write_entries(const DepthKeys& keys, const FixedPoints& points, const std::uint32_t* items,
                   std::size_t count, KeyedItem* entries);

}  // namespace tetraglass::sort
