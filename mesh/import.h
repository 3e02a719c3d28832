#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mesh/mesh_data.h"
#include "mesh/mesh_volume.h"
#include "mesh/repair_surface.h"
#include "mesh/tet_mesh.h"
#include "mesh/tetrahedralize.h"

namespace tetraglass::mesh {

/// What makes tetrahedra of a surface, and of points.
enum class Tetrahedralizer : std::uint8_t {
  automatic,  ///< TetGen for surfaces, Delaunay for points
  tetgen,
  cgal,     ///< Mesh_3: surfaces are meshed anew
  delaunay  ///< of the points of any file; its cells are left out
};

/// How to turn a file into tetrahedra. The defaults suit a first look.
struct ImportOptions {
  std::string time;  ///< "" or "last", a time value, or "index:N"; for files with time steps
  bool refine_quadratic = false;  ///< cut quadratic cells along all their points (`linearize`)
  std::string raw;  ///< the layout of a file of bare values, as `read_raw` wants it; "" for others
  std::optional<double> weld;  ///< points within this distance of each other become one
  Tetrahedralizer tetrahedralizer = Tetrahedralizer::automatic;
  FillOptions fill;                      ///< of surfaces and of regions in images
  std::optional<VolumeRegions> regions;  ///< mesh these of an image, instead of splitting it all
  bool grid_only = false;  ///< of solids: points and fields alone, of a grid (rectilinear_grid.h)
  bool repair = false;     ///< mend surfaces before they are filled (repair_surface.h)
  double largest_hole = kUsualLargestHole;  ///< that a repair closes
};

/// What the file held and what was done to it.
struct ImportReport {
  std::map<CellType, std::size_t> input_cells;  ///< as in the file
  std::size_t input_points = 0;
  std::size_t skipped = 0;   ///< cells of dimension < 3 in a file that has cells of dimension 3
  std::size_t inverted = 0;  ///< tetrahedra that were negatively oriented, now turned
  std::vector<std::string>
      notes;  ///< one line each: assumptions, parts left out, tetrahedralizer used
  double read_ms = 0;
  double decompose_ms = 0;  ///< splitting into tetrahedra, or tetrahedralizing
};

struct Import {
  TetMesh mesh;
  ImportReport report;
};

/// Reads `file` (its format is told by its extension), and makes tetrahedra of it: cells of
/// dimension 3 are split; a closed surface is filled (TetGen or CGAL); points alone get their
/// Delaunay tetrahedra (CGAL); regions of an image are meshed where asked for (CGAL). A mesh made
/// from a surface carries its point fields (surface_fields.h) and the point field `distance` (to
/// its boundary), one made from points their fields, or else `distance`. Throws ReadError (missing,
/// truncated, unknown extension, no cells), InputError (open or self-intersecting surface, options
/// that do not suit what the file holds), UnavailableError (a library that this build lacks).
[[nodiscard]] Import import_mesh(const std::string& file, const ImportOptions& options = {});

/// The extensions that `import_mesh` reads, with the dot, lower case.
[[nodiscard]] std::vector<std::string> readable_extensions();

}  // namespace tetraglass::mesh
