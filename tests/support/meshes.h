#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>

#include "mesh/mesh_data.h"
#include "mesh/tet_mesh.h"

/// Small meshes with known fields, shared by the tests of several rooms.
namespace tetraglass::tests {

using FieldFunction = std::function<double(const Eigen::Vector3d&)>;

inline void add_point_field(mesh::TetMesh& mesh, const std::string& name, const FieldFunction& f) {
  mesh::Field field{name, mesh::Location::point, 1, {}};
  for (const Eigen::Vector3d& p : mesh.points) field.values.push_back(f(p));
  mesh.fields.push_back(std::move(field));
}

/// The positively oriented tetrahedron (0,0,0), (1,0,0), (0,1,0), (0,0,1) with the field "s".
inline mesh::TetMesh unit_tetrahedron(const FieldFunction& f = [](const auto&) { return 0.0; }) {
  mesh::TetMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.cells = {{0, 1, 2, 3}};
  add_point_field(mesh, "s", f);
  return mesh;
}

/// The box [low, high] cut into nx x ny x nz bricks of 6 tetrahedra each (all around the main
/// diagonal of the brick), with the point field "s".
inline mesh::TetMesh box(const Eigen::Vector3d& low, const Eigen::Vector3d& high, int nx, int ny,
                         int nz, const FieldFunction& f) {
  mesh::TetMesh mesh;
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) {
        const Eigen::Array3d t(double(i) / nx, double(j) / ny, double(k) / nz);
        mesh.points.emplace_back(low.array() + t * (high - low).array());
      }
    }
  }
  const auto at = [&](int i, int j, int k) {
    return static_cast<std::uint32_t>((k * (ny + 1) + j) * (nx + 1) + i);
  };
  constexpr std::array<std::array<int, 3>, 6> kPaths = {
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        for (std::size_t path = 0; path < kPaths.size(); ++path) {
          std::array<int, 3> step = {i, j, k};
          mesh::Cell cell{};
          cell[0] = at(i, j, k);
          for (std::size_t corner = 0; corner < 3; ++corner) {
            ++step[static_cast<std::size_t>(kPaths[path][corner])];
            cell[corner + 1] = at(step[0], step[1], step[2]);
          }
          if (path >= 3)
            std::swap(cell[1], cell[2]);  // the odd permutations run the other way round
          mesh.cells.push_back(cell);
        }
      }
    }
  }
  add_point_field(mesh, "s", f);
  return mesh;
}

inline double volume(const mesh::TetMesh& mesh, const mesh::Cell& c) {
  const Eigen::Vector3d& a = mesh.points[c[0]];
  return (mesh.points[c[1]] - a).cross(mesh.points[c[2]] - a).dot(mesh.points[c[3]] - a) / 6;
}

/// Adds the six squares of a cube, turned outwards or inwards.
inline void add_cube(mesh::MeshData& data, const Eigen::Vector3d& low, double side,
                     bool outwards = true) {
  const auto first = static_cast<std::uint32_t>(data.points.size());
  for (int i = 0; i < 8; ++i) {
    data.points.emplace_back(low + side * Eigen::Vector3d(i % 2, i / 2 % 2, i / 4));
  }
  for (std::array<std::uint32_t, 4> face : {std::array<std::uint32_t, 4>{0, 2, 3, 1},
                                            {4, 5, 7, 6},
                                            {0, 1, 5, 4},
                                            {2, 6, 7, 3},
                                            {0, 4, 6, 2},
                                            {1, 3, 7, 5}}) {
    if (!outwards) std::swap(face[1], face[3]);
    for (std::uint32_t& i : face) i += first;
    data.add_cell(mesh::CellType::quad, face);
  }
}

}  // namespace tetraglass::tests
