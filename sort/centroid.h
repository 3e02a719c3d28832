#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/tet_mesh.h"
#include "sort/order.h"

namespace tetraglass::sort {

/// Sorts cells by the depth of their centroids, farthest first (parallel view: along the direction;
/// perspective: by distance from the eye). An approximation: about a fifth of the faces of a
/// Delaunay mesh come out in the wrong order. Depths (in perspective: squared distances) are
/// computed in double relative to the mesh itself, so that neither a mesh far from the origin nor a
/// far eye costs resolution, and compared in steps of 2^-32 of their range. Stable: cells of equal
/// depth keep the order in which they were given. The order does not depend on the number of
/// threads. Keeps its buffers between frames (16 bytes per cell).
class CentroidSorter {
 public:
  /// `cells` are indices into mesh.cells; only these are sorted. Cells with a coordinate that is
  /// not finite come first. Cost: linear, in parallel (radix sort, the highest digit first, then
  /// within its buckets from the lowest up: Knuth, The Art of Computer Programming, vol. 3, 5.2.5).
  [[nodiscard]] Order sort(const mesh::TetMesh& mesh, std::span<const std::uint32_t> cells,
                           const View& view);

 private:
  std::vector<std::uint64_t> entries_;
  std::vector<std::uint64_t> spare_;
  std::vector<std::uint32_t> places_;
};

/// The same, once.
[[nodiscard]] Order sort_centroid(const mesh::TetMesh& mesh, std::span<const std::uint32_t> cells,
                                  const View& view);

}  // namespace tetraglass::sort
