#include "mesh/import.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <new>
#include <optional>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/errors.h"
#include "base/stopwatch.h"
#include "base/suggest.h"
#include "mesh/decompose.h"
#include "mesh/distance.h"
#include "mesh/file_name.h"
#include "mesh/linearize.h"
#include "mesh/read_abaqus.h"
#include "mesh/read_cgns.h"
#include "mesh/read_collection.h"
#include "mesh/read_ensight.h"
#include "mesh/read_exodus.h"
#include "mesh/read_gambit.h"
#include "mesh/read_gmsh.h"
#include "mesh/read_med.h"
#include "mesh/read_medit.h"
#include "mesh/read_msh.h"
#include "mesh/read_netgen.h"
#include "mesh/read_plot3d.h"
#include "mesh/read_points.h"
#include "mesh/read_pos.h"
#include "mesh/read_surface.h"
#include "mesh/read_tetgen.h"
#include "mesh/read_ucd.h"
#include "mesh/read_volume.h"
#include "mesh/read_vtk.h"
#include "mesh/rectilinear_grid.h"
#include "mesh/surface_fields.h"
#include "mesh/tetrahedralize.h"
#include "mesh/weld.h"

namespace tetraglass::mesh {
namespace {

struct Format {
  std::vector<std::string> extensions;
  std::function<MeshData(const std::string&, const ImportOptions&)> read;
  bool may_be_points = false;  ///< points without cells are a point cloud, not a damaged file
};

using Reader = MeshData (*)(const std::string&);

/// A reader of files without time steps.
auto timeless(Reader read) {
  return [read](const std::string& file, const ImportOptions&) { return read(file); };
}

const std::vector<Format>& formats() {
  static const std::vector<Format> kFormats = {
      {{".vtu", ".pvtu"}, timeless(read_vtk)},
      {{".vtk", ".vtp", ".pvtp"}, timeless(read_vtk), true},
      {{".vti", ".vts", ".vtr", ".pvti", ".pvts", ".pvtr"}, timeless(read_vtk)},
      {{".e", ".ex2", ".exo", ".exii"},
       [](const std::string& file, const ImportOptions& options) {
         return read_exodus(file, options.time);
       }},
      {{".bin", ".x", ".g", ".grd", ".p3d"}, timeless(read_plot3d)},
      {{".xyz"},
       [](const std::string& file, const ImportOptions&) {
         return is_point_list(file) ? read_points(file) : read_plot3d(file);
       },
       true},
      {{".pts", ".csv"}, timeless(read_points), true},
      {{".mesh", ".meshb", ".sol", ".solb"}, timeless(read_medit), true},
      {{".vol"}, timeless(read_netgen)},
      {{".neu"}, timeless(read_gambit)},
      {{".inp"},
       [](const std::string& file, const ImportOptions&) {
         return is_ucd(file) ? read_ucd(file) : read_abaqus(file);
       }},
      {{".bdf", ".nas", ".unv"},
       [](const std::string& file, const ImportOptions& options) {
         return read_gmsh(file, options.time);
       }},
      {{".pvd", ".vtm"},
       [](const std::string& file, const ImportOptions& options) {
         return read_collection(file, options.time);
       }},
      {{".cgns", ".cgn"},
       [](const std::string& file, const ImportOptions& options) {
         return read_cgns(file, options.time);
       }},
      {{".med", ".rmed", ".mmed"},
       [](const std::string& file, const ImportOptions& options) {
         return read_med(file, options.time);
       }},
      {{".case", ".encas"},
       [](const std::string& file, const ImportOptions& options) {
         return read_ensight(file, options.time);
       }},
      {{".pos"},
       [](const std::string& file, const ImportOptions& options) {
         return read_pos(file, options.time);
       },
       true},
      {{".off", ".obj", ".stl", ".ply"}, timeless(read_surface), true},
      {{".nrrd", ".nhdr", ".mhd", ".mha", ".inr", ".slc"}, timeless(read_volume)},
      {{".node", ".ele", ".poly", ".smesh", ".face"}, timeless(read_tetgen), true},
      {{".msh"},
       [](const std::string& file, const ImportOptions& options) {
         return read_msh(file, options.time);
       }},
  };
  return kFormats;
}

const Format& find_format(const std::string& file) {
  const std::string extension = extension_of(file);
  const auto found = std::ranges::find_if(formats(), [&](const Format& format) {
    return std::ranges::find(format.extensions, extension) != format.extensions.end();
  });
  if (found != formats().end()) return *found;
  if (extension == ".q") {
    throw base::ReadError(file, "is a PLOT3D solution; give the grid file beside it instead");
  }
  if (extension == ".raw") {
    throw base::ReadError(file,
                          "holds bare values; tell their layout by --raw WIDTHxHEIGHTxDEPTH:TYPE, "
                          "such as 64x64x64:uint8");
  }
  throw base::ReadError(file, base::unknown_extension(extension, readable_extensions()));
}

/// That of bare values, which no extension tells.
const Format& raw_format() {
  static const Format kFormat = {{}, [](const std::string& file, const ImportOptions& options) {
                                   return read_raw(file, options.raw);
                                 }};
  return kFormat;
}

void check_readable(const std::string& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) {
    throw base::ReadError(file, file == "-" ? "standard input is not read: write it to a file"
                                            : "there is no such file");
  }
  if (std::filesystem::is_directory(status)) throw base::ReadError(file, "is a folder");
  if (std::filesystem::is_regular_file(status) && std::filesystem::file_size(file, error) == 0) {
    throw base::ReadError(file, "is empty (0 bytes)");
  }
}

enum class Kind { solids, surface, points };

Kind kind_of(const ImportReport& report, bool may_be_points) {
  int highest = -1;
  for (const auto& [type, count] : report.input_cells) highest = std::max(highest, dimension(type));
  if (highest == 3) return Kind::solids;
  if (highest == 2) return Kind::surface;
  if (report.input_points == 0) throw base::InputError("holds no points and no cells");
  if (highest == 0 || (report.input_cells.empty() && may_be_points)) return Kind::points;
  throw base::InputError(fmt::format(
      "holds {} points, but {}", report.input_points,
      report.input_cells.empty() ? "no cells" : "no cells that tetrahedra could be made of"));
}

/// Says which cells have been reduced to their corners.
std::string tell_reduced(const std::map<CellType, std::size_t>& cells) {
  std::size_t sum = 0;
  std::vector<std::string> types;
  for (const auto& [type, count] : cells) {
    sum += count;
    types.push_back(fmt::format("{} {}", count, to_string(type)));
  }
  return fmt::format("{} cells of higher order are drawn by their corners: {}", sum,
                     fmt::join(types, ", "));
}

TetMesh split_solids(MeshData data, const ImportOptions& options, ImportReport& report) {
  const std::size_t unused_before = options.refine_quadratic ? unused_points(data) : 0;
  const Linearization linear = linearize(std::move(data), options.refine_quadratic);
  if (linear.cut > 0) {
    report.notes.push_back(fmt::format(
        "{} cells of higher order are cut into {} linear ones along their points{}", linear.cut,
        linear.pieces,
        linear.added == 0 ? ""
                          : fmt::format(" and {} added in the middle of sides", linear.added)));
  }
  Decomposition split = decompose(linear.mesh);
  report.skipped = split.skipped;
  report.inverted = split.inverted;
  const auto note = [&](std::size_t count, const char* what) {
    if (count > 0) report.notes.push_back(fmt::format("{} {}", count, what));
  };
  note(split.unknown, "cells of an unknown type are left out");
  note(split.collapsed, "parts of collapsed cells are left out");
  if (!split.nonlinear.empty()) report.notes.push_back(tell_reduced(split.nonlinear));
  if (options.refine_quadratic) {
    note(unused_points(linear.mesh) - unused_before,
         "points within triangles and pyramids, which no piece uses, are left out");
  }
  return std::move(split.mesh);
}

/// Fields of the tetrahedra made for a surface or an image: those carried over first, then the
/// distance, then the regions.
void order_fields(TetMesh& mesh) {
  mesh.fields.push_back({"distance", Location::point, 1, boundary_distance(mesh)});
  std::ranges::stable_sort(mesh.fields, {}, [](const Field& field) {
    return field.location == Location::cell && field.name == "region";
  });
}

double largest_volume(const TetMesh& mesh) {
  double largest = 0;
  for (const Cell& c : mesh.cells) {
    const Eigen::Vector3d& a = mesh.points[c[0]];
    const double volume =
        (mesh.points[c[1]] - a).cross(mesh.points[c[2]] - a).dot(mesh.points[c[3]] - a) / 6;
    largest = std::max(largest, volume);
  }
  return largest;
}

/// Mesh_3 bounds circumspheres, so a largest volume may be passed: then it is said by how much.
void tell_largest(const TetMesh& mesh, const FillOptions& options,
                  std::vector<std::string>& notes) {
  if (!(options.max_volume > 0)) return;
  const double largest = largest_volume(mesh);
  notes.push_back(
      fmt::format("the largest tetrahedron has a volume of {:.4g}{}", largest,
                  largest > options.max_volume
                      ? fmt::format(", more than the {:.4g} asked for", options.max_volume)
                      : ""));
}

/// A surface that cannot be filled is told with what a repair has done to it before.
TetMesh fill(const MeshData& data, const ImportOptions& options, std::vector<std::string>& notes) {
  MeshData repaired;
  if (options.repair) {
    repaired = repair_surface(data, options.largest_hole, notes);
    repaired.marks = data.marks;
  }
  const MeshData& surface = options.repair ? repaired : data;
  try {
    TetMesh mesh = options.tetrahedralizer == Tetrahedralizer::cgal
                       ? remesh_surface(surface, notes, options.fill)
                       : fill_surface(surface, notes, options.fill);
    carry_surface_fields(surface, mesh, notes);
    order_fields(mesh);
    tell_largest(mesh, options.fill, notes);
    return mesh;
  } catch (const base::InputError& error) {
    if (!options.repair) throw base::InputError(std::string(error.what()) + "; try --repair");
    throw base::InputError(
        fmt::format("{}; this was after {}", error.what(), fmt::join(notes, "; ")));
  }
}

TetMesh fill_points(const MeshData& data, std::vector<std::string>& notes) {
  TetMesh mesh = delaunay(data, notes);
  const bool has_fields = std::ranges::any_of(
      mesh.fields, [](const Field& field) { return field.location == Location::point; });
  if (!has_fields) {
    mesh.fields.push_back({"distance", Location::point, 1, boundary_distance(mesh)});
  }
  return mesh;
}

void weld_points(MeshData& data, double distance, std::vector<std::string>& notes) {
  const Welding welding = weld(data, distance);
  notes.push_back(
      fmt::format("{} points within {:g} of others: made one", welding.merged, distance));
  if (welding.collapsed > 0) {
    notes.push_back(
        fmt::format("{} cells that collapsed with them are left out", welding.collapsed));
  }
}

/// Of a grid whose field is drawn between its points no tetrahedron is needed.
TetMesh points_of_grid(MeshData data) {
  (void)rectilinear_grid(data);  // throws where it is none
  TetMesh mesh;
  mesh.points = std::move(data.points);
  mesh.fields = std::move(data.fields);
  order_fields(mesh);
  return mesh;
}

TetMesh make_tetrahedra(MeshData data, bool may_be_points, const ImportOptions& options,
                        ImportReport& report) {
  std::vector<std::string>& notes = report.notes;
  if (options.weld) weld_points(data, *options.weld, notes);
  if (options.regions) {
    TetMesh mesh = mesh_volume(data, *options.regions, notes, options.fill);
    order_fields(mesh);
    tell_largest(mesh, options.fill, notes);
    return mesh;
  }
  const Kind kind = kind_of(report, may_be_points);
  if (options.tetrahedralizer == Tetrahedralizer::delaunay) {
    if (kind != Kind::points) notes.push_back("its cells are left out, its points count");
    return fill_points(data, notes);
  }
  const bool chosen = options.tetrahedralizer != Tetrahedralizer::automatic;
  switch (kind) {
    case Kind::solids:
      if (chosen || options.repair) {
        throw base::InputError(
            "has cells of dimension 3, which are split: --tetrahedralize tetgen|cgal and --repair "
            "are for surfaces");
      }
      break;
    case Kind::surface:
      return fill(data, options, notes);
    case Kind::points:
      if (chosen) {
        throw base::InputError("has points alone: --tetrahedralize tetgen|cgal is for surfaces");
      }
      return fill_points(data, notes);
  }
  // Tetrahedra may be those of a grid's voxels: that takes a look at all of them.
  const bool has_voxels = report.input_cells.count(CellType::tetra) == 0;
  if (options.grid_only && has_voxels) return points_of_grid(std::move(data));
  if (const std::size_t unused = unused_points(data); unused > 0) {
    notes.push_back(fmt::format("{} points that no cell uses are left out", unused));
  }
  return split_solids(std::move(data), options, report);
}

}  // namespace

Import import_mesh(const std::string& file, const ImportOptions& options) {
  check_readable(file);
  const Format& format = options.raw.empty() ? find_format(file) : raw_format();
  try {
    Import import;
    base::Stopwatch clock;
    MeshData data = format.read(file, options);
    import.report.input_cells = data.census();
    import.report.input_points = data.points.size();
    import.report.notes = std::move(data.notes);
    import.report.read_ms = clock.milliseconds();
    clock.restart();
    import.mesh = make_tetrahedra(std::move(data), format.may_be_points, options, import.report);
    import.report.decompose_ms = clock.milliseconds();
    return import;
  } catch (const base::InputError& error) {
    throw base::InputError(file + ": " + error.what());
  } catch (const base::UnavailableError& error) {
    throw base::UnavailableError(file + ": " + error.what());
  } catch (const base::Error&) {
    throw;
  } catch (const base::UsageError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw base::ReadError(file, "takes more memory than there is");
  } catch (const std::exception& error) {
    throw base::ReadError(file, error.what());
  }
}

std::vector<std::string> readable_extensions() {
  std::vector<std::string> extensions;
  for (const Format& format : formats()) {
    extensions.insert(extensions.end(), format.extensions.begin(), format.extensions.end());
  }
  std::ranges::sort(extensions);
  return extensions;
}

}  // namespace tetraglass::mesh
