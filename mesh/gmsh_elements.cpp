#include "mesh/gmsh_elements.h"

#include <algorithm>
#include <array>

#include "mesh/cell_shapes.h"

namespace tetraglass::mesh {
namespace {

// Gmsh numbers the edges of a solid by their corners, VTK round the bottom, round the top, upwards.
// Its prism has the first triangle seen from inside, VTK's wedge from outside: top and bottom are
// exchanged.
const std::vector<GmshElement>& elements() {
  static const std::vector<GmshElement> kTable = {
      {1, 2, CellType::line, {}},
      {2, 3, CellType::triangle, {}},
      {3, 4, CellType::quad, {}},
      {4, 4, CellType::tetra, {}},
      {5, 8, CellType::hexahedron, {}},
      {6, 6, CellType::wedge, {3, 4, 5, 0, 1, 2}},
      {7, 5, CellType::pyramid, {}},
      {8, 3, CellType::quadratic_edge, {}},
      {9, 6, CellType::quadratic_triangle, {}},
      {10, 9, CellType::biquadratic_quad, {}},
      {11, 10, CellType::quadratic_tetra, {0, 1, 2, 3, 4, 5, 6, 7, 9, 8}},
      {12, 27, CellType::triquadratic_hexahedron, {0,  1,  2,  3,  4,  5,  6,  7,  8,
                                                   11, 13, 9,  16, 18, 19, 17, 10, 12,
                                                   14, 15, 22, 23, 21, 24, 20, 25, 26}},
      {13,
       18,
       CellType::biquadratic_quadratic_wedge,
       {3, 4, 5, 0, 1, 2, 12, 14, 13, 6, 9, 7, 8, 10, 11, 15, 17, 16}},
      {14, 14, CellType::quadratic_pyramid, {0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12}},
      {15, 1, CellType::vertex, {}},
      {16, 8, CellType::quadratic_quad, {}},
      {17, 20, CellType::quadratic_hexahedron, {0,  1, 2,  3,  4,  5,  6,  7,  8,  11,
                                                13, 9, 16, 18, 19, 17, 10, 12, 14, 15}},
      {18, 15, CellType::quadratic_wedge, {3, 4, 5, 0, 1, 2, 12, 14, 13, 6, 9, 7, 8, 10, 11}},
      {19, 13, CellType::quadratic_pyramid, {0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12}},
      {20, 9, CellType::triangle, {}},
      {21, 10, CellType::triangle, {}},
      {22, 12, CellType::triangle, {}},
      {23, 15, CellType::triangle, {}},
      {24, 15, CellType::triangle, {}},
      {25, 21, CellType::triangle, {}},
      {26, 4, CellType::line, {}},
      {27, 5, CellType::line, {}},
      {28, 6, CellType::line, {}},
      {29, 20, CellType::tetra, {}},
      {30, 35, CellType::tetra, {}},
      {31, 56, CellType::tetra, {}},
      {36, 16, CellType::quad, {}},
      {37, 25, CellType::quad, {}},
      {38, 36, CellType::quad, {}},
      {90, 40, CellType::wedge, {3, 4, 5, 0, 1, 2}},
      {91, 75, CellType::wedge, {3, 4, 5, 0, 1, 2}},
      {92, 64, CellType::hexahedron, {}},
      {93, 125, CellType::hexahedron, {}},
      {118, 30, CellType::pyramid, {}},
      {119, 55, CellType::pyramid, {}},
  };
  return kTable;
}

}  // namespace

const GmshElement* find_gmsh_element(int number) {
  const auto found = std::ranges::lower_bound(elements(), number, {}, &GmshElement::number);
  return found != elements().end() && found->number == number ? &*found : nullptr;
}

bool is_reduced(const GmshElement& element) {
  const CellShape& shape = *find_shape(element.type);
  return shape.points == shape.corners && element.nodes > shape.points;
}

void add_gmsh_element(MeshData& mesh, const GmshElement& element, const std::uint32_t* points) {
  std::array<std::uint32_t, 27> cell{};
  const auto size = static_cast<std::size_t>(find_shape(element.type)->points);
  for (std::size_t k = 0; k < size; ++k) {
    cell[k] = points[element.order.empty() ? k : element.order[k]];
  }
  mesh.add_cell(element.type, std::span(cell).first(size));
}

}  // namespace tetraglass::mesh
