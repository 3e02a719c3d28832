#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>

#include "mesh/mesh_data.h"

/// Linear cells along the points of cells of higher order, which are the points of a lattice:
/// `at(i, j, k)` is the point at a place of it. Each cell goes to `add(type, points)`.
namespace tetraglass::mesh {

/// Small tetrahedra at the points of the lattice, with octahedra and tetrahedra upside down between
/// them: order^3 in all. The triangles on the sides do not depend on how octahedra are cut.
template <typename At, typename Add>
void cut_tetra(int order, const At& at, const Add& add) {
  for (int k = 0; k < order; ++k) {
    for (int j = 0; j + k < order; ++j) {
      for (int i = 0; i + j + k < order; ++i) {
        const std::uint32_t x = at(i + 1, j, k);
        const std::uint32_t y = at(i, j + 1, k);
        const std::uint32_t z = at(i, j, k + 1);
        add(CellType::tetra, {at(i, j, k), x, y, z});
        if (i + j + k > order - 2) continue;
        const std::uint32_t xy = at(i + 1, j + 1, k);
        const std::uint32_t yz = at(i, j + 1, k + 1);
        const std::uint32_t xz = at(i + 1, j, k + 1);
        add(CellType::tetra, {x, yz, y, z});  // the octahedron, around its diagonal x yz
        add(CellType::tetra, {x, yz, xy, y});
        add(CellType::tetra, {x, yz, xz, xy});
        add(CellType::tetra, {x, yz, z, xz});
        if (i + j + k > order - 3) continue;
        add(CellType::tetra, {xy, yz, xz, at(i + 1, j + 1, k + 1)});
      }
    }
  }
}

/// orders[0] orders[1] orders[2] hexahedra.
template <typename At, typename Add>
void cut_box(const std::array<int, 3>& orders, const At& at, const Add& add) {
  for (int k = 0; k < orders[2]; ++k) {
    for (int j = 0; j < orders[1]; ++j) {
      for (int i = 0; i < orders[0]; ++i) {
        add(CellType::hexahedron,
            {at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k), at(i, j, k + 1),
             at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1)});
      }
    }
  }
}

/// orders[0]^2 orders[2] wedges.
template <typename At, typename Add>
void cut_wedge(const std::array<int, 3>& orders, const At& at, const Add& add) {
  for (int k = 0; k < orders[2]; ++k) {
    for (int j = 0; j < orders[0]; ++j) {
      for (int i = 0; i + j < orders[0]; ++i) {
        add(CellType::wedge, {at(i, j, k), at(i + 1, j, k), at(i, j + 1, k), at(i, j, k + 1),
                              at(i + 1, j, k + 1), at(i, j + 1, k + 1)});
        if (i + j > orders[0] - 2) continue;
        add(CellType::wedge, {at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k),
                              at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1)});
      }
    }
  }
}

/// 6 pyramids and 4 tetrahedra of a quadratic pyramid: its corners, the middles of its edges as
/// VTK numbers them, and the middle of its base.
template <typename Add>
void cut_pyramid(std::span<const std::uint32_t> p, std::uint32_t base, const Add& add) {
  add(CellType::pyramid, {p[0], p[5], base, p[8], p[9]});
  add(CellType::pyramid, {p[5], p[1], p[6], base, p[10]});
  add(CellType::pyramid, {base, p[6], p[2], p[7], p[11]});
  add(CellType::pyramid, {p[8], base, p[7], p[3], p[12]});
  add(CellType::pyramid, {p[9], p[10], p[11], p[12], p[4]});
  add(CellType::pyramid, {p[12], p[11], p[10], p[9], base});
  for (std::size_t i = 0; i < 4; ++i) {  // below the sides
    add(CellType::tetra, {p[5 + i], base, p[9 + i], p[9 + (i + 1) % 4]});
  }
}

}  // namespace tetraglass::mesh
