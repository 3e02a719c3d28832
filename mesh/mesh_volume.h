#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh/tetrahedralize.h"

namespace tetraglass::mesh {

/// What part of an image is meshed.
struct VolumeRegions {
  bool labels = false;  ///< each whole number but 0 is a region; else all from `level` up is one
  std::optional<double> level;
  std::string field;  ///< "" for the first scalar
};

/// Well-shaped tetrahedra of the regions in an image (a regular grid, regular_grid.h), by Delaunay
/// refinement of CGAL's Mesh_3. The grey value is linear between the grid's points; a label has the
/// place where its weight in that interpolation is largest. Every connected piece of a region (of
/// voxels with common faces) is started from its own boundary, so that none is forgotten; those too
/// small for a tetrahedron are counted in `notes`. Cells have the field `region` where labels are
/// meshed: the label. Point fields of the image are interpolated at the new points. Throws
/// InputError where `data` is no image, its values are not finite or not labels (whole, 0 to 65535)
/// and where nothing is in the regions; UnavailableError in a build without CGAL. Source: Jamin et
/// al. 2015, "CGALmesh: A Generic Framework for Delaunay Mesh Generation".
[[nodiscard]] TetMesh mesh_volume(const MeshData& data, const VolumeRegions& regions,
                                  std::vector<std::string>& notes, const FillOptions& options = {});

}  // namespace tetraglass::mesh
