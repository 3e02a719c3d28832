#include "mesh/mesh_data.h"

#include <algorithm>
#include <array>

#include "mesh/cell_shapes.h"

namespace tetraglass::mesh {
namespace {

// Ordered by type, for the binary search.
constexpr auto kShapes = std::to_array<CellShape>({
    {CellType::vertex, "vertex", 0, 1, 1},
    {CellType::poly_vertex, "poly_vertex", 0, 0, 0},
    {CellType::line, "line", 1, 2, 2},
    {CellType::poly_line, "poly_line", 1, 0, 0},
    {CellType::triangle, "triangle", 2, 3, 3},
    {CellType::triangle_strip, "triangle_strip", 2, 0, 0},
    {CellType::polygon, "polygon", 2, 0, 0},
    {CellType::pixel, "pixel", 2, 4, 4},
    {CellType::quad, "quad", 2, 4, 4},
    {CellType::tetra, "tetra", 3, 4, 4},
    {CellType::voxel, "voxel", 3, 8, 8},
    {CellType::hexahedron, "hexahedron", 3, 8, 8},
    {CellType::wedge, "wedge", 3, 6, 6},
    {CellType::pyramid, "pyramid", 3, 5, 5},
    {CellType::pentagonal_prism, "pentagonal_prism", 3, 10, 10},
    {CellType::hexagonal_prism, "hexagonal_prism", 3, 12, 12},
    {CellType::quadratic_edge, "quadratic_edge", 1, 2, 3},
    {CellType::quadratic_triangle, "quadratic_triangle", 2, 3, 6},
    {CellType::quadratic_quad, "quadratic_quad", 2, 4, 8},
    {CellType::quadratic_tetra, "quadratic_tetra", 3, 4, 10},
    {CellType::quadratic_hexahedron, "quadratic_hexahedron", 3, 8, 20},
    {CellType::quadratic_wedge, "quadratic_wedge", 3, 6, 15},
    {CellType::quadratic_pyramid, "quadratic_pyramid", 3, 5, 13},
    {CellType::biquadratic_quad, "biquadratic_quad", 2, 4, 9},
    {CellType::triquadratic_hexahedron, "triquadratic_hexahedron", 3, 8, 27},
    {CellType::quadratic_linear_quad, "quadratic_linear_quad", 2, 4, 6},
    {CellType::quadratic_linear_wedge, "quadratic_linear_wedge", 3, 6, 12},
    {CellType::biquadratic_quadratic_wedge, "biquadratic_quadratic_wedge", 3, 6, 18},
    {CellType::biquadratic_quadratic_hexahedron, "biquadratic_quadratic_hexahedron", 3, 8, 24},
    {CellType::biquadratic_triangle, "biquadratic_triangle", 2, 3, 7},
    {CellType::triquadratic_pyramid, "triquadratic_pyramid", 3, 5, 19},
    {CellType::polyhedron, "polyhedron", 3, 0, 0},
    {CellType::lagrange_curve, "lagrange_curve", 1, 2, 0},
    {CellType::lagrange_triangle, "lagrange_triangle", 2, 3, 0},
    {CellType::lagrange_quad, "lagrange_quad", 2, 4, 0},
    {CellType::lagrange_tetra, "lagrange_tetra", 3, 4, 0},
    {CellType::lagrange_hexahedron, "lagrange_hexahedron", 3, 8, 0},
    {CellType::lagrange_wedge, "lagrange_wedge", 3, 6, 0},
    {CellType::lagrange_pyramid, "lagrange_pyramid", 3, 5, 0},
    {CellType::bezier_curve, "bezier_curve", 1, 2, 0},
    {CellType::bezier_triangle, "bezier_triangle", 2, 3, 0},
    {CellType::bezier_quad, "bezier_quad", 2, 4, 0},
    {CellType::bezier_tetra, "bezier_tetra", 3, 4, 0},
    {CellType::bezier_hexahedron, "bezier_hexahedron", 3, 8, 0},
    {CellType::bezier_wedge, "bezier_wedge", 3, 6, 0},
    {CellType::bezier_pyramid, "bezier_pyramid", 3, 5, 0},
});

}  // namespace

const CellShape* find_shape(CellType type) {
  const auto* found = std::ranges::lower_bound(kShapes, type, {}, &CellShape::type);
  return found != kShapes.end() && found->type == type ? found : nullptr;
}

std::string to_string(CellType type) {
  const CellShape* shape = find_shape(type);
  return shape != nullptr ? shape->name : "type " + std::to_string(static_cast<int>(type));
}

int dimension(CellType type) {
  const CellShape* shape = find_shape(type);
  return shape != nullptr ? shape->dimension : -1;
}

std::map<CellType, std::size_t> MeshData::census() const {
  std::array<std::size_t, 256> counts{};
  for (const CellType type : types) ++counts[static_cast<std::uint8_t>(type)];
  std::map<CellType, std::size_t> census;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] > 0) census[static_cast<CellType>(i)] = counts[i];
  }
  return census;
}

}  // namespace tetraglass::mesh
