#pragma once

#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

#include "sort/key_sort.h"

namespace tetraglass::sort {

/// Keys of the depths square w + linear . v of points v, w being |v|^2 or a number of its own: 0 at
/// the depth `farthest`, growing by 1 with every 1 / scale that a point is nearer, up to 2^32 - 1.
struct DepthKeys {
  double square = 0;
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();
  double farthest = 0;
  double scale = 0;
};

/// Coordinates of points, in steps of 2^-31, and maybe w.
struct FixedPoints {
  const std::int32_t* x;
  const std::int32_t* y;
  const std::int32_t* z;
  const std::int32_t* w = nullptr;  ///< null: |v|^2
};

/// The number of steps nearest to x, which is to lie between -1 and 1.
[[nodiscard]] std::int32_t in_steps(double x);

/// Writes for `count` points the keys of their depths with their items. By vectors of whatever the
/// machine has, with the same result on all of them.
void write_entries(const DepthKeys& keys, const FixedPoints& points, const std::uint32_t* items,
                   std::size_t count, KeyedItem* entries);

}  // namespace tetraglass::sort
