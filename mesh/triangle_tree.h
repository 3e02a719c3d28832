#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace tetraglass::mesh {

/// A bounding volume hierarchy over triangles, for the nearest one to a place. Built in parallel.
class TriangleTree {
 public:
  using Triangle = std::array<Eigen::Vector3d, 3>;

  explicit TriangleTree(std::vector<Triangle> triangles);

  /// The squared distance of p to the nearest triangle, of which there is at least one. `nearest`
  /// is a guess, and then that triangle. Numbers are the tree's own; `number` gives the caller's.
  [[nodiscard]] double squared_distance_to(const Eigen::Vector3d& p, std::uint32_t& nearest) const;

  /// The place in the list that the tree was made of.
  [[nodiscard]] std::uint32_t number(std::uint32_t own) const { return numbers_[own]; }

 private:
  static constexpr std::size_t kLeaf = 4;
  static constexpr std::size_t kParallel = 4096;

  struct Node {
    Eigen::AlignedBox3d box;
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    std::uint32_t right = 0;  ///< 0 for a leaf; the left child follows its parent
  };

  void build(std::size_t index, std::size_t begin, std::size_t end,
             const std::vector<Triangle>& triangles);

  std::vector<std::uint32_t> numbers_;
  std::vector<Triangle> triangles_;  ///< in the order of the leaves
  std::vector<Node> nodes_;
};

}  // namespace tetraglass::mesh
