#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/tet_mesh.h"
#include "sort/boundary_relations.h"
#include "sort/cell_links.h"
#include "sort/face_planes.h"
#include "sort/order.h"

namespace tetraglass::sort {

/// The meshed polyhedra visibility order: a topological order of the relations "hides", across
/// faces between cells (Williams 1992, "Visibility-Ordering Meshed Polyhedra") and across gaps of
/// the mesh (boundary_relations.h). Whichever the mesh (holes, parts, doubled cells), the order is
/// exact unless cells hide each other in a ring; such cycles are found, counted and resolved with
/// the least harm (hiding_graph.h). On which side of a face the eye is, is decided exactly, by a
/// filter in float in all but a few of a million cases. Cells without volume come first. Keeps what
/// does not depend on the view (88 bytes per cell) and its buffers.
class MpvoSorter {
 public:
  /// `cells` are indices into mesh.cells of cells with finite coordinates; only these are sorted.
  /// The mesh outlives this. Cost: linear, in parallel.
  MpvoSorter(const mesh::TetMesh& mesh, std::span<const std::uint32_t> cells);

  /// Cost: linear, and n log n in the boundary faces. Where cells do not overlap, `exact` is
  /// `cycles == 0`. Valid until the next call.
  [[nodiscard]] const Order& sort(const View& view);

 private:
  // The faces of a cell where a ray enters from a neighbour, a bit for each, and what else it
  // needs.
  using Faces = std::uint8_t;

  void find_planes();
  void classify_faces(const View& view);
  void collect_boundary(const View& view);
  void index_relations(const std::vector<Relation>& relations);
  void emit(std::uint32_t cell);
  void order_remaining(const View& view);
  template <typename F>
  void for_each_front(std::uint32_t cell, const F& f) const;

  const mesh::TetMesh& mesh_;
  CellLinks links_;
  std::vector<std::array<FacePlane, 4>> planes_;
  std::vector<std::uint32_t> boundary_cells_;
  Eigen::Vector3d middle_;
  double radius_ = 0;

  std::vector<Faces> entries_;
  std::vector<std::uint32_t> behind_;  // cells that each cell hides and that are not yet drawn
  std::vector<std::uint32_t> ready_;
  Order order_;
  std::vector<BoundaryFace> exit_faces_;
  std::vector<BoundaryFace> entry_faces_;
  // The relations across gaps, by the cell that is hidden.
  std::vector<std::uint32_t> relation_cells_;
  std::vector<std::uint32_t> relation_offsets_;
  std::vector<std::uint32_t> relation_fronts_;
};

/// The same, once.
[[nodiscard]] Order sort_mpvo(const mesh::TetMesh& mesh, std::span<const std::uint32_t> cells,
                              const View& view);

}  // namespace tetraglass::sort
