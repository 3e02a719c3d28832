#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/tet_mesh.h"
#include "sort/hiding_graph.h"
#include "sort/order.h"

namespace tetraglass::sort {

/// A face with a cell on one side only, its vertices counter-clockwise from outside.
struct BoundaryFace {
  std::uint32_t cell = 0;
  std::array<std::uint32_t, 3> vertices{};
};

/// The relations between cells that see each other through a gap of the mesh: some ray leaves
/// `front` through one of `exits` and comes to `back` through one of `entries` later (not
/// necessarily next). In object space and exact: that the images of two faces overlap (with their
/// interiors) and which face is the nearer one there is decided by exact predicates, from the
/// shared supporting planes (separating planes through the eye; the faces' planes; a crossing of
/// two edges). Faces that lie on each other, as of parts in contact, count as a gap of no width.
/// The eye lies in no plane of the faces; it may be among them. Where faces intersect each other,
/// the relation is that of some point.
///
/// In perspective the faces are sorted into the six sides of a cube around the eye. On each side a
/// hierarchy of boxes, in the plane and in depth, finds the pairs. In parallel; cost: n log n and
/// the pairs that overlap with `back` behind `front`.
///
/// What Williams' meshed polyhedra visibility order lacks on meshes that are not convex (Silva,
/// Mitchell, Williams 1998, "An Exact Interactive Time Visibility Ordering Algorithm for Polyhedral
/// Cell Complexes", find them by a sweep).
[[nodiscard]] std::vector<Relation> boundary_relations(const mesh::TetMesh& mesh,
                                                       const std::vector<BoundaryFace>& exits,
                                                       const std::vector<BoundaryFace>& entries,
                                                       const View& view);

}  // namespace tetraglass::sort
