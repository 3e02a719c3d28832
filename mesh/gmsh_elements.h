#pragma once

#include <cstddef>
#include <vector>

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

/// An element type of Gmsh as a cell. Where there is no cell of as many points, `type` is the
/// linear one, of the corners, which come first in all of Gmsh's elements.
struct GmshElement {
  int number;  ///< Gmsh's
  int nodes;
  CellType type;
  std::vector<std::size_t>
      order;  ///< of each point of the cell, its place among the nodes; as is, if empty
};

/// The element type with that number; null if it is unknown.
/// Source: Gmsh reference manual, sections "MSH file format" and "Node ordering".
[[nodiscard]] const GmshElement* find_gmsh_element(int number);

/// Whether the cell has fewer points than the element, so that its shape is lost.
[[nodiscard]] bool is_reduced(const GmshElement& element);

/// Adds an element to the cells, given the points that its nodes are.
void add_gmsh_element(MeshData& mesh, const GmshElement& element, const std::uint32_t* points);

}  // namespace tetraglass::mesh
