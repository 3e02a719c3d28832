#include "sort/cell_links.h"

#include <algorithm>
#include <array>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "mesh/predicates.h"

namespace tetraglass::sort {
namespace {

using Range = tbb::blocked_range<std::size_t>;
constexpr std::size_t kGrain = 4096;

// Whether the neighbour beyond a face lists its vertices in the other sense. Of two positively
// oriented cells it does exactly if they lie on both sides of the face.
bool is_beyond(const mesh::Cell& cell, std::size_t face, const mesh::Cell& neighbor) {
  const auto vertex = [](const mesh::Cell& c, int i) { return c[static_cast<std::size_t>(i)]; };
  const auto& mine = mesh::kFaceVertices[face];
  const std::array<std::uint32_t, 3> wanted = {vertex(cell, mine[0]), vertex(cell, mine[2]),
                                               vertex(cell, mine[1])};
  return std::any_of(mesh::kFaceVertices.begin(), mesh::kFaceVertices.end(), [&](const auto& f) {
    for (std::size_t turn = 0; turn < 3; ++turn) {
      if (vertex(neighbor, f[turn]) == wanted[0] &&
          vertex(neighbor, f[(turn + 1) % 3]) == wanted[1] &&
          vertex(neighbor, f[(turn + 2) % 3]) == wanted[2]) {
        return true;
      }
    }
    return false;
  });
}

}  // namespace

CellLinks link_cells(const mesh::TetMesh& mesh, std::span<const std::uint32_t> cells) {
  CellLinks links;
  links.adjacency = mesh::face_adjacency(mesh);
  std::vector<std::uint8_t> is_linked(mesh.cells.size(), 0);
  tbb::parallel_for(Range(0, cells.size(), kGrain), [&](const Range& range) {
    const auto& p = mesh.points;
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const mesh::Cell& c = mesh.cells[cells[i]];
      is_linked[cells[i]] = mesh::orientation(p[c[0]], p[c[1]], p[c[2]], p[c[3]]) > 0 ? 1 : 0;
    }
  });
  for (const std::uint32_t cell : cells) {
    (is_linked[cell] != 0 ? links.cells : links.flat).push_back(cell);
  }
  std::sort(links.cells.begin(), links.cells.end());
  std::sort(links.flat.begin(), links.flat.end());
  tbb::parallel_for(Range(0, links.cells.size(), kGrain), [&](const Range& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const std::uint32_t cell = links.cells[i];
      for (std::size_t face = 0; face < 4; ++face) {
        std::uint32_t& neighbor = links.adjacency.neighbors[cell][face];
        if (neighbor == mesh::kNoCell) continue;
        if (is_linked[neighbor] == 0 || !is_beyond(mesh.cells[cell], face, mesh.cells[neighbor])) {
          neighbor = mesh::kNoCell;
        }
      }
    }
  });
  return links;
}

}  // namespace tetraglass::sort
