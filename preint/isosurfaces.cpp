#include "preint/isosurfaces.h"

#include <algorithm>

namespace tetraglass::preint {

std::vector<std::size_t> crossed(const std::vector<Isosurface>& surfaces, double front,
                                 double back) {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (crosses(front, back, surfaces[i].value)) result.push_back(i);
  }
  const bool rising = front < back;
  std::stable_sort(result.begin(), result.end(), [&](std::size_t a, std::size_t b) {
    return rising ? surfaces[a].value < surfaces[b].value : surfaces[a].value > surfaces[b].value;
  });
  return result;
}

}  // namespace tetraglass::preint
