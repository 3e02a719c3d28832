#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sort/order.h"
#include "sort/power_spheres.h"

namespace tetraglass::sort {

/// The power of the eye with respect to spheres, less a number that all have in common; in parallel
/// views its limit. It grows with the depth of the cells of a Delaunay mesh.
class PowerOfEye {
 public:
  /// Of spheres relative to `middle`.
  PowerOfEye(const View& view, const Eigen::Vector3d& middle);

  [[nodiscard]] double of(const PowerSphere& sphere) const {
    return constant_ * sphere.constant +
           (linear_.x() * sphere.center.x() + linear_.y() * sphere.center.y() +
            linear_.z() * sphere.center.z());
  }
  /// How far off it is at most.
  [[nodiscard]] double doubt(const PowerSphere& sphere) const {
    return constant_ * sphere.constant_error + sum_ * sphere.center_error;
  }

 private:
  double constant_;
  Eigen::Vector3d linear_;
  double sum_;  // of the absolute values of linear_, enlarged for the rounding of its own
};

/// Keys of 32 bits that grow as the power falls. Half of them are for the range that most powers
/// have, in steps of equal width; the others are for what lies beyond it, as spheres of slivers do,
/// in steps that grow with the distance.
class PowerKeys {
 public:
  /// From a sample of the powers, in any order; it is sorted.
  explicit PowerKeys(std::vector<double> sample);

  [[nodiscard]] std::uint32_t key(double power) const;
  /// Whether a key that is off by `doubt` is less than half a step off.
  [[nodiscard]] bool is_certain(double doubt) const { return doubt * scale_ <= 0x1p-33; }

 private:
  double high_ = 0;
  double scale_ = 0;
};

/// Keys from `low` to `high`, that a power may have.
struct KeyRange {
  std::uint32_t low;
  std::uint32_t high;
};

/// Joins ranges that overlap; the result is ascending.
void join_overlapping(std::vector<KeyRange>& ranges);

/// Finds where entries in the order of their keys can be cut. `doubtful` ranges are disjoint and
/// ascending.
class CutFinder {
 public:
  explicit CutFinder(std::span<const KeyRange> doubtful) : doubtful_(doubtful) {}

  /// Whether all entries up to one of key `before` are certain to be farther than all from the next
  /// one on, of key `after`: neither are the keys next to each other, nor does a doubtful range
  /// reach over the gap. From call to call `after` does not fall. Cost: constant on average.
  [[nodiscard]] bool is_cut(std::uint32_t before, std::uint32_t after) {
    while (next_ < doubtful_.size() && doubtful_[next_].high < after) ++next_;
    return after - before >= 2 && (next_ == doubtful_.size() || doubtful_[next_].low > before);
  }

 private:
  std::span<const KeyRange> doubtful_;
  std::size_t next_ = 0;
};

}  // namespace tetraglass::sort
