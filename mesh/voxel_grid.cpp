#include "mesh/voxel_grid.h"

#include <array>
#include <cstdint>
#include <limits>

#include <tbb/parallel_for.h>

namespace tetraglass::mesh {
namespace {

constexpr std::size_t kCellsPerVoxel = 5;

// The corners of a voxel are numbered by their offsets: bit 0 is x, bit 1 y, bit 2 z. A voxel keeps
// the tetrahedron of four alternating corners and cuts off the other four; the odd voxel is the
// mirror image of the even one, so the diagonals of a common side agree.
constexpr std::array<std::array<std::array<int, 4>, kCellsPerVoxel>, 2> kVoxelCells = {{
    {{{0, 3, 6, 5}, {1, 3, 0, 5}, {2, 0, 3, 6}, {4, 5, 0, 6}, {7, 3, 5, 6}}},
    {{{1, 2, 4, 7}, {0, 1, 2, 4}, {3, 2, 1, 7}, {5, 1, 4, 7}, {6, 4, 2, 7}}},
}};

}  // namespace

TetMesh make_voxel_grid(const std::vector<double>& axis) {
  const std::size_t n = axis.size();
  TetMesh mesh;
  mesh.points.resize(n * n * n);
  tbb::parallel_for(std::size_t{0}, n, [&](std::size_t k) {
    Eigen::Vector3d* next = mesh.points.data() + k * n * n;
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t i = 0; i < n; ++i) *next++ = {axis[i], axis[j], axis[k]};
    }
  });
  const std::size_t voxels = n - 1;
  mesh.cells.resize(kCellsPerVoxel * voxels * voxels * voxels);
  tbb::parallel_for(std::size_t{0}, voxels, [&](std::size_t k) {
    Cell* next = mesh.cells.data() + kCellsPerVoxel * voxels * voxels * k;
    for (std::size_t j = 0; j < voxels; ++j) {
      for (std::size_t i = 0; i < voxels; ++i) {
        for (const auto& corners : kVoxelCells[(i + j + k) % 2]) {
          Cell& cell = *next++;
          for (std::size_t v = 0; v < 4; ++v) {
            const auto bits = static_cast<std::size_t>(corners[v]);
            cell[v] = static_cast<std::uint32_t>(((k + (bits >> 2)) * n + j + (bits >> 1 & 1)) * n +
                                                 i + (bits & 1));
          }
        }
      }
    }
  });
  return mesh;
}

void keep_voxels(TetMesh& mesh, const std::function<bool(const Eigen::Vector3d& center)>& keep) {
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> names(mesh.points.size(), kUnused);
  std::vector<Eigen::Vector3d> points;
  std::vector<Cell> cells;
  for (std::size_t first = 0; first < mesh.cells.size(); first += kCellsPerVoxel) {
    // The first cell of a voxel has four alternating corners: their mean is the centre.
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    for (const std::uint32_t v : mesh.cells[first]) center += 0.25 * mesh.points[v];
    if (!keep(center)) continue;
    for (std::size_t i = first; i < first + kCellsPerVoxel; ++i) {
      Cell& cell = cells.emplace_back(mesh.cells[i]);
      for (std::uint32_t& v : cell) {
        if (names[v] == kUnused) {
          names[v] = static_cast<std::uint32_t>(points.size());
          points.push_back(mesh.points[v]);
        }
        v = names[v];
      }
    }
  }
  mesh.points = std::move(points);
  mesh.cells = std::move(cells);
}

}  // namespace tetraglass::mesh
