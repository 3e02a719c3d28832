#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "mesh/field.h"

namespace tetraglass::mesh {

/// Cell shapes, numbered as in the VTK file formats; the order of a cell's points is VTK's too.
enum class CellType : std::uint8_t {
  vertex = 1,
  poly_vertex = 2,
  line = 3,
  poly_line = 4,
  triangle = 5,
  triangle_strip = 6,
  polygon = 7,
  pixel = 8,
  quad = 9,
  tetra = 10,
  voxel = 11,
  hexahedron = 12,
  wedge = 13,
  pyramid = 14,
  pentagonal_prism = 15,
  hexagonal_prism = 16,
  quadratic_edge = 21,
  quadratic_triangle = 22,
  quadratic_quad = 23,
  quadratic_tetra = 24,
  quadratic_hexahedron = 25,
  quadratic_wedge = 26,
  quadratic_pyramid = 27,
  biquadratic_quad = 28,
  triquadratic_hexahedron = 29,
  quadratic_linear_quad = 30,
  quadratic_linear_wedge = 31,
  biquadratic_quadratic_wedge = 32,
  biquadratic_quadratic_hexahedron = 33,
  biquadratic_triangle = 34,
  triquadratic_pyramid = 37,
  polyhedron = 42,
  lagrange_curve = 68,
  lagrange_triangle = 69,
  lagrange_quad = 70,
  lagrange_tetra = 71,
  lagrange_hexahedron = 72,
  lagrange_wedge = 73,
  lagrange_pyramid = 74,
  bezier_curve = 75,
  bezier_triangle = 76,
  bezier_quad = 77,
  bezier_tetra = 78,
  bezier_hexahedron = 79,
  bezier_wedge = 80,
  bezier_pyramid = 81,
};

/// The name of a cell type as `info` prints it ("tetra", "hexahedron", ...; "type 99" if unknown).
[[nodiscard]] std::string to_string(CellType type);

/// 0 to 3: the dimension of a cell type; -1 if unknown.
[[nodiscard]] int dimension(CellType type);

/// What a boundary says of the regions within it, by a place in each.
struct RegionMarks {
  struct Region {
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    double attribute = 0;
  };
  std::vector<Eigen::Vector3d> holes;  ///< regions that are to be left empty
  std::vector<Region> regions;
};

/// A mesh as a file has it: cells of any type, before decomposition into tetrahedra.
struct MeshData {
  std::vector<Eigen::Vector3d> points;
  std::vector<CellType> types;
  std::vector<std::uint64_t> offsets{
      0};  ///< cell i owns connectivity[offsets[i] .. offsets[i + 1])
  std::vector<std::uint32_t>
      connectivity;  ///< point indices; of a polyhedron: (faces, (n, n points) per face)
  std::vector<Field> fields;
  std::optional<RegionMarks> marks;  ///< of a boundary: all that it encloses is solid but the holes
  std::vector<std::string> notes;    ///< what a reader had to leave out or assume, a line each

  [[nodiscard]] std::size_t cell_count() const { return types.size(); }
  [[nodiscard]] std::span<const std::uint32_t> cell(std::size_t i) const {
    return {connectivity.data() + offsets[i], connectivity.data() + offsets[i + 1]};
  }
  void add_cell(CellType type, std::span<const std::uint32_t> points_of_cell) {
    types.push_back(type);
    connectivity.insert(connectivity.end(), points_of_cell.begin(), points_of_cell.end());
    offsets.push_back(connectivity.size());
  }
  /// How many cells there are of each type.
  [[nodiscard]] std::map<CellType, std::size_t> census() const;
};

}  // namespace tetraglass::mesh
