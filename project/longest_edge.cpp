#include "project/longest_edge.h"

#include <algorithm>

namespace tetraglass::project {

double longest_edge(const Scene& scene) {
  double longest = 0;
  for (const std::uint32_t index : scene.drawable.cells) {
    const mesh::Cell& cell = scene.mesh->cells[index];
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) {
        const Eigen::Vector3d edge = scene.mesh->points[cell[i]] - scene.mesh->points[cell[j]];
        longest = std::max(longest, edge.stableNorm());
      }
    }
  }
  return longest;
}

}  // namespace tetraglass::project
