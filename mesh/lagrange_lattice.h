#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

/// The points of a Lagrange tetrahedron, hexahedron or wedge by their places (i, j, k) in its
/// lattice. Valid as long as the mesh.
class LagrangeLattice {
 public:
  /// Orders of hexahedra and wedges are equal ones, or as the cell field HigherOrderDegrees says.
  /// Throws InputError where the cell has a number of points that its type cannot have.
  LagrangeLattice(const MeshData& data, std::size_t cell);

  /// Along i, j and k; of a tetrahedron all the same.
  [[nodiscard]] const std::array<int, 3>& orders() const { return orders_; }

  /// The point at a place. Wedges have their first triangle seen from outside here, as linear
  /// wedges do.
  std::uint32_t operator()(int i, int j, int k) const;

 private:
  CellType type_;
  std::span<const std::uint32_t> points_;
  std::array<int, 3> orders_;
};

}  // namespace tetraglass::mesh
