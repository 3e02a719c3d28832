#include "project/slices/bricks.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/errors.h"

namespace tetraglass::project::slices {
namespace {

using Eigen::Vector3i;

std::size_t product(const Vector3i& v) {
  return static_cast<std::size_t>(v.x()) * static_cast<std::size_t>(v.y()) *
         static_cast<std::size_t>(v.z());
}

}  // namespace

std::vector<Brick> make_bricks(const mesh::RectilinearGrid& grid, const Vector3i& border,
                               std::size_t most_points, int most_side) {
  const Vector3i last = whole_grid(grid).high;
  const auto points_of = [&](const Vector3i& voxels) -> Vector3i {
    return (voxels + 2 * border).cwiseMin(last) + Vector3i::Ones();
  };
  Vector3i side = last;
  while (product(points_of(side)) > most_points || points_of(side).maxCoeff() > most_side) {
    int longest = 0;
    side.maxCoeff(&longest);
    if (side[longest] == 1) {
      throw base::UnavailableError(fmt::format(
          "bricks of {} points cannot hold a voxel and what slices reach around it, {} x {} x {} "
          "points: use larger bricks or more slices",
          most_points, points_of(side).x(), points_of(side).y(), points_of(side).z()));
    }
    side[longest] = (side[longest] + 1) / 2;
  }
  std::vector<Brick> bricks;
  for (int z = 0; z < last.z(); z += side.z()) {
    for (int y = 0; y < last.y(); y += side.y()) {
      for (int x = 0; x < last.x(); x += side.x()) {
        const Vector3i low(x, y, z);
        const Vector3i high = (low + side).cwiseMin(last);
        bricks.push_back(
            {{low, high}, {(low - border).cwiseMax(0), (high + border).cwiseMin(last)}});
      }
    }
  }
  return bricks;
}

void order_bricks(std::vector<Brick>& bricks, const mesh::RectilinearGrid& grid,
                  const GridView& view) {
  // How far off along each axis.
  const auto distances = [&](const Brick& brick) {
    const GridBox box = box_of(brick.voxels, grid);
    std::array<double, 3> result{};
    for (int k = 0; k < 3; ++k) {
      double& distance = result[static_cast<std::size_t>(k)];
      if (view.parallel()) {
        const double away = view.away()[k];
        distance = away > 0 ? box.low[k] : away < 0 ? -box.high[k] : 0.0;
      } else {
        distance = std::max({box.low[k] - view.eye()[k], view.eye()[k] - box.high[k], 0.0});
      }
    }
    return result;
  };
  std::ranges::stable_sort(bricks, std::greater<>(), distances);
}

}  // namespace tetraglass::project::slices
