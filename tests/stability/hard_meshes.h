#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "mesh/tet_mesh.h"
#include "tests/stability/convex.h"
#include "tests/support/meshes.h"

/// Meshes of convex bodies whose cells are hard to draw, with a linear field "s".
namespace tetraglass::tests {

struct HardMesh {
  mesh::TetMesh mesh;
  Convex body;
};

inline const Eigen::Vector3d kRise(0.3, -0.2, 0.5);

inline double linear_field(const Eigen::Vector3d& p) {
  return kRise.dot(p) + 0.1;
}

inline void turn_positive(mesh::TetMesh& mesh) {
  for (mesh::Cell& cell : mesh.cells) {
    if (volume(mesh, cell) < 0) std::swap(cell[0], cell[1]);
  }
}

/// The box cut by planes at these coordinates along each axis (ascending, at least two).
inline HardMesh graded_box(const std::array<std::vector<double>, 3>& planes) {
  const auto cells = [&](std::size_t axis) { return static_cast<int>(planes[axis].size()) - 1; };
  HardMesh result;
  result.mesh = box({0, 0, 0}, Eigen::Vector3d(cells(0), cells(1), cells(2)), cells(0), cells(1),
                    cells(2), [](const auto&) { return 0.0; });
  Eigen::AlignedBox3d extent;
  for (Eigen::Vector3d& p : result.mesh.points) {
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] =
          planes[static_cast<std::size_t>(axis)][static_cast<std::size_t>(std::lround(p[axis]))];
    }
    extent.extend(p);
  }
  result.mesh.fields.clear();
  add_point_field(result.mesh, "s", linear_field);
  result.body = convex_box(extent, kRise, 0.1);
  return result;
}

/// The body and its cells taken to A p + t, the values at the vertices as they were.
inline HardMesh transformed(const HardMesh& hard, const Eigen::Matrix3d& a,
                            const Eigen::Vector3d& t) {
  HardMesh result = hard;
  for (Eigen::Vector3d& p : result.mesh.points) p = a * p + t;
  const Eigen::Matrix3d normals = a.inverse().transpose();
  for (Convex::Side& side : result.body.sides) {
    side.normal = normals * side.normal;
    side.offset += side.normal.dot(t);
  }
  result.body.gradient = normals * result.body.gradient;
  result.body.at_origin -= result.body.gradient.dot(t);
  return result;
}

inline HardMesh plain_box(int n = 3) {
  std::vector<double> planes;
  for (int i = 0; i <= n; ++i) planes.push_back(-1 + 2.0 * i / n);
  return graded_box({planes, planes, planes});
}

/// An octahedron of two caps around a sliver: four points near one plane, two of them `height`
/// above it and two below, so that its dihedral angles are about 2 height and 180 degrees.
inline HardMesh sliver_octahedron(double height) {
  HardMesh result;
  mesh::TetMesh& mesh = result.mesh;
  mesh.points = {{1, 0, height},   {0, 1, -height}, {-1, 0, height},
                 {0, -1, -height}, {0.1, 0.05, 1},  {-0.05, 0.1, -1}};
  // The sliver's upper faces meet in the edge 0-2, its lower ones in 1-3.
  mesh.cells = {{0, 1, 2, 3}, {0, 1, 2, 4}, {0, 2, 3, 4}, {0, 1, 3, 5}, {1, 2, 3, 5}};
  turn_positive(mesh);
  add_point_field(mesh, "s", linear_field);
  result.body.gradient = kRise;
  result.body.at_origin = 0.1;
  for (std::uint32_t i = 0; i < 4; ++i) {
    for (const std::uint32_t tip : {4U, 5U}) {
      const Eigen::Vector3d& a = mesh.points[i];
      Eigen::Vector3d normal = (mesh.points[(i + 1) % 4] - a).cross(mesh.points[tip] - a);
      if (normal.dot(a) < 0) normal = -normal;
      result.body.sides.push_back({normal, normal.dot(a)});
    }
  }
  return result;
}

/// The box of `plain_box(2)` with its inner vertex at a distance of `height` from a face of its
/// cells, from an edge, or from another vertex: flat cells, needles and cells with one tiny face.
enum class Near { face, edge, vertex };
inline HardMesh squeezed_box(Near what, double height) {
  HardMesh result = plain_box(2);
  const std::size_t inner = 13;
  const Eigen::Vector3d target = what == Near::face   ? Eigen::Vector3d(-0.3, -0.6, -1)
                                 : what == Near::edge ? Eigen::Vector3d(-1, -1, -0.4)
                                                      : Eigen::Vector3d(-1, -1, -1);
  // Towards the vertex (-1, -1, -1), in which six of the cells around the inner one meet.
  result.mesh.points[inner] = target - height * target;
  result.mesh.fields.clear();
  add_point_field(result.mesh, "s", linear_field);
  return result;
}

}  // namespace tetraglass::tests
