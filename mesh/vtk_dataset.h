#pragma once

#include "mesh/mesh_data.h"

class vtkCompositeDataSet;
class vtkDataSet;

namespace tetraglass::mesh {

/// A VTK data set of any kind as plain cells: a structured grid gives hexahedra, an image and a
/// rectilinear grid voxels (without those that are blanked). Cells that are marked as ghosts
/// (copies of another piece's, or hidden) are left out. Numeric arrays of the points and cells
/// become fields, ids last; what is left out is noted. Throws InputError where the data set
/// contradicts itself or would not fit into memory.
[[nodiscard]] MeshData mesh_data(vtkDataSet& data);

/// The blocks with cells, joined (see `append_meshes`); nothing at all where there are none.
[[nodiscard]] MeshData mesh_data(vtkCompositeDataSet& blocks);

}  // namespace tetraglass::mesh
