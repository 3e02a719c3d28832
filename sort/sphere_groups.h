#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/tet_mesh.h"
#include "sort/cell_links.h"
#include "sort/face_planes.h"
#include "sort/order.h"

namespace tetraglass::sort {

/// Cells that meet at faces and have one sphere, as those of a voxel: the power of the eye says
/// nothing of their order among themselves. Most groups of most meshes are of one cell.
class SphereGroups {
 public:
  /// `ties` says of each of links.cells, by a bit for each of its faces, across which ones the
  /// neighbour has the same sphere; it is enough that one of the two cells says so. The mesh and
  /// the links outlive this. Planes are relative to `middle`.
  SphereGroups(const mesh::TetMesh& mesh, const CellLinks& links,
               std::span<const std::uint8_t> ties, const Eigen::Vector3d& middle);

  [[nodiscard]] std::size_t size() const { return offsets_.size() - 1; }
  [[nodiscard]] std::size_t size(std::size_t group) const {
    return offsets_[group + 1] - offsets_[group];
  }
  /// Whether any group has more than one cell.
  [[nodiscard]] bool has_ties() const { return cells_.size() > size(); }
  /// Ascending.
  [[nodiscard]] std::span<const std::uint32_t> cells(std::size_t group) const {
    return std::span(cells_).subspan(offsets_[group], size(group));
  }

  /// Writes the cells of a group in exact order, farthest first: by the faces between them. False
  /// if they hide each other in a ring, as no cells do that do not overlap. `sides` are of the view
  /// and the middle.
  bool write_order(std::size_t group, const View& view, const EyeSides& sides,
                   std::uint32_t* target) const;

 private:
  // A face between two cells of a group, given by their places in it; seen from outside of `cell`.
  struct InnerFace {
    FacePlane plane;
    std::uint32_t cell;
    std::uint32_t neighbor;
    std::uint32_t face;
  };

  void collect_inner_faces(const CellLinks& links, std::span<const std::uint32_t> group_of,
                           const Eigen::Vector3d& middle);
  [[nodiscard]] int side(std::size_t group, const InnerFace& face, const View& view,
                         const EyeSides& sides) const;
  bool write_large_group(std::size_t group, const View& view, const EyeSides& sides,
                         std::uint32_t* target) const;

  const mesh::TetMesh& mesh_;
  std::vector<std::uint32_t> offsets_{0};
  std::vector<std::uint32_t> cells_;
  std::vector<std::uint32_t> face_offsets_;
  std::vector<InnerFace> faces_;
};

}  // namespace tetraglass::sort
