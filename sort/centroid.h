#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/tet_mesh.h"
#include "sort/key_sort.h"
#include "sort/order.h"

namespace tetraglass::sort {

/// Sorts cells by the depth of their centroids, farthest first (parallel view: along the direction;
/// perspective: by distance from the eye). An approximation, `exact` is never set: about a fifth of
/// the faces of a Delaunay mesh come out in the wrong order. Centroids are kept in steps of
/// 2^-32 to 2^-31 of the longest side of the mesh's box, and their depths (in perspective: squared
/// distances) are compared in steps of 2^-32 of the range that the box has, so that neither a mesh
/// far from the origin nor a far eye costs resolution. Stable: cells of equal depth keep the order
/// in which they were given. The order does not depend on the number of threads.
class CentroidSorter {
 public:
  /// `cells` are indices into mesh.cells; only these are sorted. Cells with a coordinate that is
  /// not finite come first. Computes the centroids (16 bytes per cell); the mesh is not needed
  /// later. Cost: linear, in parallel.
  CentroidSorter(const mesh::TetMesh& mesh, std::span<const std::uint32_t> cells);

  /// Valid until the next call; buffers are kept (20 bytes per cell). Cost: linear, in parallel
  /// (key_sort.h).
  [[nodiscard]] const Order& sort(const View& view);

 private:
  std::vector<std::uint32_t> cells_;  // those without a depth first
  std::size_t without_depth_ = 0;
  // The centroids of the others, relative to the middle of the mesh, in steps of unit_ / 2^31.
  std::vector<std::int32_t> x_;
  std::vector<std::int32_t> y_;
  std::vector<std::int32_t> z_;
  Eigen::Vector3d middle_;
  Eigen::Vector3d half_;  // of the mesh's box
  double unit_ = 1;       // a power of two, more than half_

  KeySorter sorter_;
  Order order_;
};

/// The same, once.
[[nodiscard]] Order sort_centroid(const mesh::TetMesh& mesh, std::span<const std::uint32_t> cells,
                                  const View& view);

}  // namespace tetraglass::sort
