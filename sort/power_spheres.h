#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "mesh/tet_mesh.h"
#include "sort/cell_links.h"
#include "sort/order.h"

namespace tetraglass::sort {

/// The sphere around a cell that is orthogonal to the spheres of its vertices (without weights: the
/// circumsphere), and how far off it can be. The power of a point e with respect to it, less |e|^2,
/// is constant - 2 e . center. Relative to the middle given.
struct PowerSphere {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double constant = 0;        ///< |center|^2 - radius^2
  double center_error = 0;    ///< of each coordinate, at most
  double constant_error = 0;  ///< at most
};

/// The sphere of a cell with volume; `weights` holds one per point, or is empty. By interval
/// arithmetic, and in exact numbers where the interval would be wide.
[[nodiscard]] PowerSphere power_sphere(const mesh::TetMesh& mesh, std::uint32_t cell,
                                       std::span<const double> weights,
                                       const Eigen::Vector3d& middle);

/// Groups cells by the power of the eye with respect to their spheres, compared in exact numbers:
/// the farthest (of the largest power) first, cells of equal power in one group. In parallel views
/// the power grows with direction . center.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> group_by_power(
    const mesh::TetMesh& mesh, std::span<const std::uint32_t> cells,
    std::span<const double> weights, const View& view);

/// Whether cells are part of a regular triangulation (without weights: of a Delaunay one) of their
/// vertices: so that one cell hides another one only if the eye has a smaller power with respect to
/// its sphere, or an equal one and the cells have one sphere and are linked by faces.
struct Regularity {
  std::string fault;  ///< why they are not; empty if they are
  /// Of each of links.cells, by a bit for each face to a neighbour of a higher number: whether the
  /// neighbour has the same sphere.
  std::vector<std::uint8_t> ties;
};

/// Decided exactly: no sphere is in conflict with the vertex across a face, nor is it with, nor
/// does it touch, any vertex beyond a boundary face (where there are none such the spheres are free
/// of conflicts altogether: on a straight way from a cell to a vertex its power falls from cell to
/// cell). `spheres` are those of links.cells. In parallel.
[[nodiscard]] Regularity check_regularity(const mesh::TetMesh& mesh, const CellLinks& links,
                                          std::span<const double> weights,
                                          const std::vector<PowerSphere>& spheres,
                                          const Eigen::Vector3d& middle);

}  // namespace tetraglass::sort
