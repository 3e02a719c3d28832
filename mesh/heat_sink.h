#pragma once

#include <cstddef>

#include "mesh/mesh_data.h"
#include "mesh/tet_mesh.h"

namespace tetraglass::mesh {

/// The surface of a heat sink, as quadrilaterals that meet corner to corner, facing outwards: a
/// base plate of 60 x 60 x 6 mm, and on it nine fins of 2 x 60 x 24 mm. Below, the square of a chip
/// of 20 x 20 mm is made of faces of its own. In metres, z up.
[[nodiscard]] MeshData heat_sink_surface();

/// The heat sink filled with about `cells` tetrahedra (0: about the 121,668 of weiler2002's heat
/// sink) by TetGen, with the point field "temperature" in degrees Celsius: aluminium of 200 W/(m
/// K), 80 W from the chip, air of 25 degrees carrying off 40 W/(m^2 K) everywhere else
/// (`steady_temperature`). Throws UsageError for over 100 million cells,
/// UnavailableError in a build without TetGen.
[[nodiscard]] TetMesh make_heat_sink(std::size_t cells = 0);

/// The power that the chip brings in, W.
inline constexpr double kChipPower = 80;

}  // namespace tetraglass::mesh
