#include "mesh/distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "mesh/adjacency.h"
#include "mesh/triangle_tree.h"

namespace tetraglass::mesh {
namespace {

using Eigen::Vector3d;

enum class Place : std::uint8_t { unused, interior, boundary };

}  // namespace

std::vector<double> boundary_distance(const TetMesh& mesh) {
  const Adjacency adjacency = face_adjacency(mesh);
  std::vector<Place> places(mesh.points.size(), Place::unused);
  for (const Cell& cell : mesh.cells) {
    for (const std::uint32_t v : cell) {
      if (mesh.points[v].allFinite()) places[v] = Place::interior;
    }
  }
  std::vector<TriangleTree::Triangle> triangles;
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell) {
    for (std::size_t face = 0; face < 4; ++face) {
      if (adjacency.neighbors[cell][face] != kNoCell) continue;
      std::array<Vector3d, 3> p;
      bool finite = true;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t v = mesh.cells[cell][static_cast<std::size_t>(kFaceVertices[face][i])];
        p[i] = mesh.points[v];
        finite = finite && p[i].allFinite();
        if (places[v] == Place::interior) places[v] = Place::boundary;
      }
      if (finite) triangles.push_back({p[0], p[1], p[2]});
    }
  }
  std::vector<double> distances(mesh.points.size(), 0);
  if (triangles.empty()) return distances;
  const TriangleTree tree(std::move(triangles));
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.points.size(), 256),
                    [&](const auto& range) {
                      // Neighbouring indices are mostly neighbouring points: the last one's
                      // triangle is a good guess.
                      std::uint32_t nearest = 0;
                      for (std::size_t i = range.begin(); i != range.end(); ++i) {
                        if (places[i] != Place::interior) continue;
                        distances[i] = std::sqrt(tree.squared_distance_to(mesh.points[i], nearest));
                      }
                    });
  return distances;
}

}  // namespace tetraglass::mesh
