#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "mesh/mesh_data.h"
#include "mesh/tet_mesh.h"

namespace tetraglass::mesh {

/// How many tetrahedra a filled surface gets unless asked for: enough to see the inside of its
/// field, few enough to be drawn at once.
inline constexpr double kUsualCells = 1e5;

/// How fine and how well shaped new tetrahedra are to be.
struct FillOptions {
  double cells = kUsualCells;    ///< about how many, where no largest volume is given
  double max_volume = 0;         ///< of a tetrahedron; 0: by `cells`
  double radius_edge_ratio = 2;  ///< the largest ratio of circumradius to shortest edge
  double min_dihedral = 0;       ///< the smallest dihedral angle to aim at, degrees (TetGen only)
  bool keep_surface = false;     ///< add no points on the surface (TetGen only)
  std::vector<Eigen::Vector3d> holes;  ///< a place in each region that is to be left empty
};

/// Fills the closed surface that the cells of dimension 2 of `data` make with about as many
/// well-shaped tetrahedra as asked for (more where the surface is finer), by TetGen. Equal points
/// are one; polygons are cut by the diagonals from their smallest point index. A shell within
/// another one is a cavity if its faces turn towards its inside, and part of the solid if they turn
/// away from it; where the faces of a surface do not agree on a direction, shells that lie in an
/// odd number of others are cavities. Where walls part the inside (edges of three triangles), all
/// regions are solid. Where `data.marks` tell of regions all
/// of them are solid but the holes. Regions with a place of `holes` in them are left empty. A solid
/// of several regions gets the cell field `region`, numbered from 1, or as `data.marks` name them.
/// Points are added within (a regular lattice), and on the surface where its triangles are large
/// for that, unless it is to be kept; fields are not carried over (surface_fields.h does). What was
/// done is added to `notes`. Throws InputError for a surface that is open or intersects itself,
/// with a diagnosis, or has no volume, and for a place of a hole outside the solid;
/// UnavailableError in a build without TetGen. Source: Si 2015, "TetGen, a Delaunay-Based Quality
/// Tetrahedral Mesh Generator".
[[nodiscard]] TetMesh fill_surface(const MeshData& data, std::vector<std::string>& notes,
                                   const FillOptions& options = {});

/// Fills the closed surface of the cells of dimension 2 by Delaunay refinement of CGAL's Mesh_3:
/// it is meshed anew, sharp edges (over 60 degrees) kept, within a tenth of a tetrahedron's edge.
/// A largest volume bounds circumspheres; beside sharp edges it may be passed, by a third or so.
/// Shells in an odd number of others are cavities. What was done is added to `notes`. Throws as
/// fill_surface does; also InputError where holes or keeping the surface are asked for. Source:
/// Jamin et al. 2015, "CGALmesh: A Generic Framework for Delaunay Mesh Generation".
[[nodiscard]] TetMesh remesh_surface(const MeshData& data, std::vector<std::string>& notes,
                                     const FillOptions& options = {});

/// The Delaunay tetrahedra of all points, which fill their convex hull, with the point fields. Of
/// equal points the first one counts. What was done is added to `notes`. Throws InputError for
/// fewer than 4 points, points in one plane and coordinates that are not finite; UnavailableError
/// in a build without CGAL.
[[nodiscard]] TetMesh delaunay(const MeshData& data, std::vector<std::string>& notes);

}  // namespace tetraglass::mesh
