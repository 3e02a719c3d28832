#include "project/modulation.h"

#include <algorithm>

#include "mesh/gradients.h"

namespace tetraglass::project {

std::vector<double> cell_densities(const Scene& scene) {
  std::vector<double> result;
  for (const Eigen::Vector3d& gradient : mesh::cell_gradients(*scene.mesh, scene.field)) {
    result.push_back(std::min(1.0, gradient.stableNorm() / *scene.modulation));
  }
  return result;
}

}  // namespace tetraglass::project
