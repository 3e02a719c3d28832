#include "sort/sphere_groups.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

#include "sort/eye_side.h"
#include "sort/hiding_graph.h"

namespace tetraglass::sort {
namespace {

// Sets of cells, joined where they have one sphere. The lowest member stands for each.
class Sets {
 public:
  explicit Sets(std::size_t n) : parents_(n) { std::iota(parents_.begin(), parents_.end(), 0U); }

  std::uint32_t find(std::uint32_t i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parents_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parents_;
};

}  // namespace

SphereGroups::SphereGroups(const mesh::TetMesh& mesh, const CellLinks& links,
                           std::span<const std::uint8_t> ties, const Eigen::Vector3d& middle)
    : mesh_(mesh) {
  const std::size_t n = links.cells.size();
  std::vector<std::uint32_t> place_of(mesh.cells.size());
  for (std::uint32_t i = 0; i < n; ++i) place_of[links.cells[i]] = i;
  Sets sets(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    for (unsigned bits = ties[i]; bits != 0; bits &= bits - 1) {
      const auto face = static_cast<std::size_t>(std::countr_zero(bits));
      sets.join(i, place_of[links.adjacency.neighbors[links.cells[i]][face]]);
    }
  }
  std::vector<std::uint32_t> group_of(n);
  std::vector<std::uint32_t> sizes;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t first = sets.find(i);
    if (first == i) sizes.push_back(0);
    group_of[i] = first == i ? static_cast<std::uint32_t>(sizes.size() - 1) : group_of[first];
    ++sizes[group_of[i]];
  }
  for (const std::uint32_t size : sizes) offsets_.push_back(offsets_.back() + size);
  cells_.resize(n);
  std::vector<std::uint32_t> places(offsets_.begin(), offsets_.end() - 1);
  for (std::uint32_t i = 0; i < n; ++i) cells_[places[group_of[i]]++] = links.cells[i];
  if (!has_ties()) return;
  std::vector<std::uint32_t> group_of_cell(mesh.cells.size(), mesh::kNoCell);
  for (std::uint32_t i = 0; i < n; ++i) group_of_cell[links.cells[i]] = group_of[i];
  collect_inner_faces(links, group_of_cell, middle);
}

void SphereGroups::collect_inner_faces(const CellLinks& links,
                                       std::span<const std::uint32_t> group_of,
                                       const Eigen::Vector3d& middle) {
  face_offsets_.assign(1, 0);
  for (std::size_t group = 0; group < size(); ++group) {
    const auto mine = cells(group);
    for (std::uint32_t i = 0; i < mine.size() && mine.size() > 1; ++i) {
      const mesh::Cell& c = mesh_.cells[mine[i]];
      for (std::uint32_t face = 0; face < 4; ++face) {
        const std::uint32_t neighbor = links.adjacency.neighbors[mine[i]][face];
        if (neighbor == mesh::kNoCell || neighbor < mine[i] || group_of[neighbor] != group) {
          continue;
        }
        const auto vertex = [&](std::size_t k) -> const Eigen::Vector3d& {
          return mesh_.points[c[static_cast<std::size_t>(mesh::kFaceVertices[face][k])]];
        };
        const auto place = std::lower_bound(mine.begin(), mine.end(), neighbor) - mine.begin();
        faces_.push_back({face_plane(vertex(0), vertex(1), vertex(2), middle), i,
                          static_cast<std::uint32_t>(place), face});
      }
    }
    face_offsets_.push_back(static_cast<std::uint32_t>(faces_.size()));
  }
}

int SphereGroups::side(std::size_t group, const InnerFace& face, const View& view,
                       const EyeSides& sides) const {
  if (const int certain = sides.of(face.plane); certain != 0) return certain;
  const mesh::Cell& c = mesh_.cells[cells_[offsets_[group] + face.cell]];
  const auto vertex = [&](std::size_t k) -> const Eigen::Vector3d& {
    return mesh_.points[c[static_cast<std::size_t>(mesh::kFaceVertices[face.face][k])]];
  };
  return eye_side(view, vertex(0), vertex(1), vertex(2));
}

bool SphereGroups::write_order(std::size_t group, const View& view, const EyeSides& sides,
                               std::uint32_t* target) const {
  constexpr std::size_t kMost = 32;  // one bit for each cell
  const std::span<const std::uint32_t> mine = cells(group);
  if (mine.size() == 1) {
    *target = mine.front();
    return true;
  }
  if (mine.size() > kMost) return write_large_group(group, view, sides, target);
  std::array<std::uint32_t, kMost> behind{};
  for (std::uint32_t i = face_offsets_[group]; i < face_offsets_[group + 1]; ++i) {
    const InnerFace& face = faces_[i];
    const int eye = side(group, face, view, sides);
    if (eye > 0) behind[face.neighbor] |= 1U << face.cell;
    if (eye < 0) behind[face.cell] |= 1U << face.neighbor;
  }
  std::uint32_t* place = target;
  std::uint32_t left = mine.size() == kMost ? ~0U : (1U << mine.size()) - 1;
  while (left != 0) {
    const std::uint32_t before = left;
    for (std::uint32_t bits = left; bits != 0; bits &= bits - 1) {
      const int cell = std::countr_zero(bits);
      if ((behind[static_cast<std::size_t>(cell)] & left) != 0) continue;
      *place++ = mine[static_cast<std::size_t>(cell)];
      left &= ~(1U << cell);
    }
    if (left == before) return write_large_group(group, view, sides, target);
  }
  return true;
}

bool SphereGroups::write_large_group(std::size_t group, const View& view, const EyeSides& sides,
                                     std::uint32_t* target) const {
  const std::span<const std::uint32_t> mine = cells(group);
  std::vector<Relation> relations;
  for (std::uint32_t i = face_offsets_[group]; i < face_offsets_[group + 1]; ++i) {
    const InnerFace& face = faces_[i];
    const int eye = side(group, face, view, sides);
    if (eye > 0) relations.push_back({face.neighbor, face.cell});
    if (eye < 0) relations.push_back({face.cell, face.neighbor});
  }
  const ResolvedOrder order =
      resolve(make_graph(mine.size(), relations), std::vector<double>(mine.size(), 0.0));
  for (const std::uint32_t i : order.cells) *target++ = mine[i];
  return order.cycles == 0;
}

}  // namespace tetraglass::sort
