#include "sort/mpvo.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "sort/eye_side.h"
#include "sort/hiding_graph.h"

namespace tetraglass::sort {
namespace {

using Eigen::Vector3d;
using Range = tbb::blocked_range<std::size_t>;

constexpr std::size_t kGrain = 4096;
constexpr std::uint8_t kHasRelations = 0x80;  // beside the four bits of the entries
constexpr std::uint8_t kEntries = 0x0f;
constexpr std::uint32_t kDrawn = std::numeric_limits<std::uint32_t>::max();

std::array<std::uint32_t, 3> face_vertices(const mesh::Cell& cell, std::size_t face) {
  const auto& v = mesh::kFaceVertices[face];
  return {cell[static_cast<std::size_t>(v[0])], cell[static_cast<std::size_t>(v[1])],
          cell[static_cast<std::size_t>(v[2])]};
}

int eye_side(const View& view, const mesh::TetMesh& mesh, std::uint32_t cell, std::size_t face) {
  const auto [a, b, c] = face_vertices(mesh.cells[cell], face);
  return eye_side(view, mesh.points[a], mesh.points[b], mesh.points[c]);
}

}  // namespace

MpvoSorter::MpvoSorter(const mesh::TetMesh& mesh, std::span<const std::uint32_t> cells)
    : mesh_(mesh), links_(link_cells(mesh, cells)), middle_(Vector3d::Zero()) {
  for (const std::uint32_t cell : links_.cells) {
    const auto& neighbors = links_.adjacency.neighbors[cell];
    if (std::find(neighbors.begin(), neighbors.end(), mesh::kNoCell) != neighbors.end()) {
      boundary_cells_.push_back(cell);
    }
  }
  find_planes();
  entries_.resize(mesh.cells.size());
  behind_.resize(mesh.cells.size());
  order_.method = "mpvo";
}

void MpvoSorter::find_planes() {
  mesh::Box box;
  for (const std::uint32_t cell : links_.cells) {
    for (const std::uint32_t v : mesh_.cells[cell]) box.extend(mesh_.points[v]);
  }
  if (!box.isEmpty()) {
    middle_ = box.center();
    radius_ = 0.5 * box.diagonal().norm();
  }
  planes_.resize(mesh_.cells.size());
  tbb::parallel_for(Range(0, links_.cells.size(), kGrain), [&](const Range& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      for (std::size_t face = 0; face < 4; ++face) {
        const auto [ia, ib, ic] = face_vertices(mesh_.cells[links_.cells[i]], face);
        planes_[links_.cells[i]][face] =
            face_plane(mesh_.points[ia], mesh_.points[ib], mesh_.points[ic], middle_);
      }
    }
  });
}

void MpvoSorter::classify_faces(const View& view) {
  const EyeSides sides(view, middle_, radius_);
  tbb::parallel_for(Range(0, links_.cells.size(), kGrain), [&](const Range& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const std::uint32_t cell = links_.cells[i];
      unsigned entries = 0;
      std::uint32_t exits = 0;
      for (std::size_t face = 0; face < 4; ++face) {
        if (links_.adjacency.neighbors[cell][face] == mesh::kNoCell) continue;
        int side = sides.of(planes_[cell][face]);
        if (side == 0) side = eye_side(view, mesh_, cell, face);
        if (side > 0) entries |= 1U << face;
        if (side < 0) ++exits;
      }
      entries_[cell] = static_cast<Faces>(entries);
      behind_[cell] = exits;
    }
  });
}

void MpvoSorter::collect_boundary(const View& view) {
  exit_faces_.clear();
  entry_faces_.clear();
  for (const std::uint32_t cell : boundary_cells_) {
    for (std::size_t face = 0; face < 4; ++face) {
      if (links_.adjacency.neighbors[cell][face] != mesh::kNoCell) continue;
      const int side = eye_side(view, mesh_, cell, face);
      if (side == 0) continue;
      (side > 0 ? entry_faces_ : exit_faces_)
          .push_back({cell, face_vertices(mesh_.cells[cell], face)});
    }
  }
}

void MpvoSorter::index_relations(const std::vector<Relation>& relations) {
  relation_cells_.clear();
  relation_offsets_.assign(1, 0);
  relation_fronts_.clear();
  for (const Relation& relation : relations) {
    if (relation_cells_.empty() || relation_cells_.back() != relation.back) {
      relation_cells_.push_back(relation.back);
      relation_offsets_.push_back(relation_offsets_.back());
      entries_[relation.back] |= kHasRelations;
    }
    relation_fronts_.push_back(relation.front);
    ++relation_offsets_.back();
    ++behind_[relation.front];
  }
}

// Calls f(front) for each cell that hides a part of `cell`, once for each relation.
template <typename F>
void MpvoSorter::for_each_front(std::uint32_t cell, const F& f) const {
  const Faces faces = entries_[cell];
  const auto& neighbors = links_.adjacency.neighbors[cell];
  for (unsigned entries = faces & kEntries; entries != 0; entries &= entries - 1) {
    f(neighbors[static_cast<std::size_t>(std::countr_zero(entries))]);
  }
  if ((faces & kHasRelations) == 0) return;
  const auto place = std::lower_bound(relation_cells_.begin(), relation_cells_.end(), cell);
  const auto k = static_cast<std::size_t>(place - relation_cells_.begin());
  for (std::uint32_t i = relation_offsets_[k]; i < relation_offsets_[k + 1]; ++i) {
    f(relation_fronts_[i]);
  }
}

void MpvoSorter::emit(std::uint32_t cell) {
  order_.cells.push_back(cell);
  behind_[cell] = kDrawn;
  for_each_front(cell, [&](std::uint32_t front) {
    if (--behind_[front] == 0) ready_.push_back(front);
  });
}

// Cells that hide each other in a ring, and those that hide them.
void MpvoSorter::order_remaining(const View& view) {
  std::vector<std::uint32_t> left;
  std::vector<double> depths;
  for (const std::uint32_t cell : links_.cells) {
    if (behind_[cell] == kDrawn) continue;
    Vector3d centroid = Vector3d::Zero();
    for (const std::uint32_t v : mesh_.cells[cell]) centroid += 0.25 * (mesh_.points[v] - middle_);
    left.push_back(cell);
    depths.push_back(view.parallel ? view.direction.dot(centroid)
                                   : (centroid - (view.eye - middle_)).norm());
  }
  HidingGraph graph;
  const auto number = [&](std::uint32_t cell) {
    return static_cast<std::uint32_t>(std::lower_bound(left.begin(), left.end(), cell) -
                                      left.begin());
  };
  for (const std::uint32_t cell : left) {
    for_each_front(cell, [&](std::uint32_t front) { graph.fronts.push_back(number(front)); });
    graph.offsets.push_back(static_cast<std::uint32_t>(graph.fronts.size()));
  }
  const ResolvedOrder resolved = resolve(graph, depths);
  for (const std::uint32_t i : resolved.cells) order_.cells.push_back(left[i]);
  for (const std::uint32_t i : resolved.cyclic_cells) order_.cyclic_cells.push_back(left[i]);
  order_.cycles = resolved.cycles;
}

const Order& MpvoSorter::sort(const View& view) {
  order_.cycles = 0;
  order_.cyclic_cells.clear();
  order_.cells.reserve(links_.cells.size() + links_.flat.size());
  order_.cells = links_.flat;
  classify_faces(view);
  collect_boundary(view);
  index_relations(boundary_relations(mesh_, exit_faces_, entry_faces_, view));
  ready_.clear();
  for (const std::uint32_t cell : links_.cells) {
    if (behind_[cell] != 0) continue;
    // Depth first: what a cell hides it hides soon, and both are in the cache.
    emit(cell);
    while (!ready_.empty()) {
      const std::uint32_t next = ready_.back();
      ready_.pop_back();
      emit(next);
    }
  }
  if (order_.cells.size() < links_.cells.size() + links_.flat.size()) order_remaining(view);
  order_.exact = order_.cycles == 0;
  return order_;
}

Order sort_mpvo(const mesh::TetMesh& mesh, std::span<const std::uint32_t> cells, const View& view) {
  return MpvoSorter(mesh, cells).sort(view);
}

}  // namespace tetraglass::sort
