#pragma once

#include <string>

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

/// Reads a PLOT3D grid file (one or many structured grids, in text or binary) and the solution file
/// beside it, if there is one: NAMEq.EXT for NAMExyz.EXT, NAME.q for NAME.xyz (.x, .g, ...). Byte
/// order, Fortran record marks, precision, iblank and the number of grids are told from the size of
/// the file. Cells with a point whose iblank is 0 are left out.
///
/// Fields at the points: `density`, `momentum` (3), `stagnation_energy` as in the file, `velocity`
/// (3) where the density is never 0, and `pressure`: of an ideal gas with a ratio of specific heats
/// of 1.4, as PLOT3D defines it, where that is positive everywhere; else the fifth channel itself,
/// if the density is constant (incompressible solvers write it so). Source: Walatka et al. 1990,
/// "PLOT3D User's Manual", NASA TM 101067. Throws ReadError.
[[nodiscard]] MeshData read_plot3d(const std::string& file);

}  // namespace tetraglass::mesh
