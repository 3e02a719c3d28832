#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mesh/tet_mesh.h"

namespace tetraglass::mesh {

/// The names that `make_sample` knows.
[[nodiscard]] std::vector<std::string> sample_names();

/// A test mesh with a known point field, which is named as the sample.
///
/// Regular grids over [-1, 1]^3 of n^3 points, each voxel split into 5 tetrahedra (alternating, so
/// that neighbours share diagonals). Weiler's data sets ("Hardware-Based View-Independent Cell
/// Projection", 2002) have n = 32: 148,955 cells, the default. Else n is that whose cell count 5 (n
/// - 1)^3 comes nearest to `cells`.
/// - `orbital`: the density of the 4f_z(x2-y2) orbital, eight lobes:
///   (z (x^2 - y^2))^2 exp(-16 r), scaled so that its maximum over space is 1;
/// - `sphere`: the distance from the origin;
/// - `linear`: 0.5 + (x + 2 y + 3 z) / 12, from 0 to 1.
///
/// Meshes that are hard to draw. Their field is that of `linear`, whose integrals along rays are
/// known:
/// - `needles`: a grid over [-1, 1]^3 graded towards the planes through the origin, down to a
/// spacing of
///   2^-26: flat and needle-like cells with dihedral angles down to some 1e-6 degrees;
/// - `shells`: three nested spherical shells around a ball, four parts that do not touch;
/// - `cavity`: one part with a closed cavity, a tunnel through it and a corner cut out;
/// - `cycle`: a ring of sheared prisms, three face-connected cells each, every one of which partly
/// hides
///   the next one all the way round when seen along z; and inside the ring three loose cells that
///   hide each other in a cycle. By default 27 cells; 18 at least.
///
/// And a result as engineers have them, in metres and degrees Celsius (heat_sink.h):
/// - `heat-sink`: a finned block of aluminium on a hot chip, its field the temperature; by default
///   about the 122 thousand cells of Weiler's data set. Throws UnavailableError in a build without
///   TetGen.
///
/// `cells` > 0 asks for about that many cells, 0 for the default. Cost: linear, the grids in
/// parallel. Throws UsageError for an unknown name, with the nearest ones, and for more points than
/// 32-bit indices can number.
[[nodiscard]] TetMesh make_sample(const std::string& name, std::size_t cells = 0);

}  // namespace tetraglass::mesh
