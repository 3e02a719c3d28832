#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "sort/depth_keys.h"
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

  [[nodiscard]] double constant() const { return constant_; }
  [[nodiscard]] const Eigen::Vector3d& linear() const { return linear_; }

 private:
  double constant_;
  Eigen::Vector3d linear_;
  double sum_;  // of the absolute values of linear_, enlarged for the rounding of its own
};

/// Keys from `low` to `high`, that a power may have.
struct KeyRange {
  std::uint32_t low;
  std::uint32_t high;
};

/// Entries from `begin` to before `end`, of which it is uncertain which ones are farther.
struct Run {
  std::size_t begin;
  std::size_t end;
};

/// Spheres by four numbers of 32 bits each, for keys that grow as the power falls: in equal steps
/// over the range that most powers have. Far spheres, as those of slivers, are
/// few, and keyed one by one.
class KeyedSpheres {
 public:
  /// What keys depend on the view.
  struct Keys {
    DepthKeys depth;
    std::uint32_t doubt = 0;  ///< how many steps the key of a near sphere is off, at most
  };

  KeyedSpheres() = default;
  /// Far is a sphere with a center more than twice `radius` from the middle, and with a constant or
  /// errors out of proportion. `items` stand for the spheres; as long.
  KeyedSpheres(const std::vector<PowerSphere>& spheres, double radius, double largest_weight,
               std::vector<std::uint32_t> items);

  [[nodiscard]] std::size_t size() const { return items_.size(); }

  [[nodiscard]] Keys choose_keys(const PowerOfEye& power) const;

  /// Writes `count` entries from the one of number `begin` on; those of far spheres are not valid.
  void write(const Keys& keys, std::size_t begin, std::size_t count, KeyedItem* target) const;

  /// The numbers of far spheres, ascending.
  [[nodiscard]] const std::vector<std::uint32_t>& far() const { return far_; }
  [[nodiscard]] std::uint32_t item(std::size_t i) const { return items_[i]; }

 private:
  [[nodiscard]] std::pair<double, double> range_of_most(const Eigen::Vector4d& slopes) const;

  std::vector<std::int32_t> x_;
  std::vector<std::int32_t> y_;
  std::vector<std::int32_t> z_;
  std::vector<std::int32_t> constants_;
  std::vector<std::uint32_t> items_;
  std::vector<std::uint32_t> far_;
  double unit_ = 1;           // of the centers, a power of two
  double constant_unit_ = 1;  // a power of two
  double center_error_ = 0;
  double constant_error_ = 0;
};

/// The keys from which near spheres are certainly farther, or nearer, than one of this power, its
/// own key in between.
[[nodiscard]] KeyRange doubtful_range(const KeyedSpheres::Keys& keys, double power, double doubt);

/// Whether near spheres of these keys are certain to be in this order.
[[nodiscard]] inline bool is_cut(const KeyedSpheres::Keys& keys, std::uint32_t before,
                                 std::uint32_t after) {
  return after - before > 2 * std::uint64_t{keys.doubt};
}

/// Joins ranges that overlap; the result is ascending.
void join_overlapping(std::vector<KeyRange>& ranges);

/// Joins runs that have entries in common; the result is ascending.
void join_overlapping(std::vector<Run>& runs);

}  // namespace tetraglass::sort
