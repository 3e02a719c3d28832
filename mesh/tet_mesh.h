#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "mesh/field.h"

namespace tetraglass::mesh {

/// Four indices into the points. Positively oriented: (b - a) x (c - a) . (d - a) > 0, or 0 for a
/// cell of no volume, which stays in the mesh (so that cell fields keep their order) but is not
/// drawn.
using Cell = std::array<std::uint32_t, 4>;

/// Face i of a cell lies opposite its vertex i; these are its vertices, counter-clockwise from
/// outside.
inline constexpr std::array<std::array<int, 3>, 4> kFaceVertices = {
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// A tetrahedral mesh with named fields. Plain data: derived data (adjacency, gradients, boundary)
/// comes from free functions.
struct TetMesh {
  std::vector<Eigen::Vector3d> points;
  std::vector<Cell> cells;
  std::vector<Field> fields;
};

using Box = Eigen::AlignedBox3d;

/// The smallest axis-aligned box around the points that cells use, or all points of a mesh without
/// cells. Points with a coordinate that is not finite are passed over.
[[nodiscard]] Box bounds(const TetMesh& mesh);

/// One number per point or cell of the mesh, by `spec`, which is tried in this order:
/// - the exact name of a field, whatever characters it has;
/// - NAME:x|y|z|magnitude or NAME:INDEX (from 0), a component of a field or its Euclidean length.
///
/// NAME alone means the magnitude of a field of several components. Of a point and a cell field of
/// the same name the point field is taken; NAME@point and NAME@cell (before the colon) choose. An
/// empty `spec` takes the first scalar field, else the magnitude of the first one, else `z`. Where
/// no field of the mesh has that name, the generated point fields `x`, `y`, `z` and `radius`
/// (distance from the centre of the bounds) can be asked for. Throws InputError with the nearest
/// names where there is no such field or component, and where a field has another number of values
/// than the mesh has points or cells.
[[nodiscard]] ScalarField select_scalar(const TetMesh& mesh, const std::string& spec);

/// Which cells can be drawn, and how many cannot.
struct Drawable {
  std::vector<std::uint32_t> cells;  ///< in the order of the mesh
  std::size_t degenerate = 0;        ///< zero volume, decided exactly
  std::size_t nan = 0;               ///< with a coordinate or a value that is not finite
};

/// Sorts out the cells without volume (exact orientation predicate) and those touching NaN or
/// infinity: a coordinate or, of a point field, a value at one of their four vertices; of a cell
/// field, their own. A cell of both kinds counts as nan. In parallel. `field` belongs to `mesh` (as
/// select_scalar makes it).
[[nodiscard]] Drawable find_drawable(const TetMesh& mesh, const ScalarField& field);

}  // namespace tetraglass::mesh
