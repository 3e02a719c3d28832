#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/tet_mesh.h"
#include "sort/order.h"

namespace tetraglass::sort {

/// Sorts cells by the depth of their centroids, farthest first (parallel view: along the direction; perspective: by
/// distance from the eye). An approximation: about a fifth of the faces of a Delaunay mesh come out in the wrong order.
/// Stable: cells of equal depth keep the order in which they were given. Keeps its buffers between frames.
class CentroidSorter {
 public:
  /// `cells` are indices into mesh.cells; only these are sorted. Cost: linear (radix sort on 32-bit keys).
  [[nodiscard]] Order sort(const mesh::TetMesh& mesh, std::span<const std::uint32_t> cells, const View& view);

 private:
  std::vector<std::uint32_t> keys_;
  std::vector<std::uint32_t> keys_spare_;
  std::vector<std::uint32_t> cells_spare_;
};

/// The same, once.
[[nodiscard]] Order sort_centroid(const mesh::TetMesh& mesh, std::span<const std::uint32_t> cells, const View& view);

}  // namespace tetraglass::sort
