#include "mesh/read_med.h"

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>
#include <med.h>

#include "base/errors.h"
#include "mesh/med_fields.h"
#include "mesh/memory.h"
#include "mesh/read_apart.h"

namespace tetraglass::mesh {
namespace {

constexpr unsigned kSeconds = 600;

/// A geometric type and, of each point of the cell, its place among the nodes (in order, if empty).
struct MedShape {
  med_geometry_type type;
  CellType cell;
  std::vector<std::size_t> order;
};

// MED's solids are mirror images of VTK's but the wedge, which both begin by a triangle seen from
// outside; both number the edges round the bottom, round the top, upwards. Source: MED 4.1,
// "Numérotation des éléments de référence".
const std::vector<MedShape>& shapes() {
  static const std::vector<MedShape> kTable = {
      {MED_POINT1, CellType::vertex, {}},
      {MED_SEG2, CellType::line, {}},
      {MED_SEG3, CellType::quadratic_edge, {}},
      {MED_TRIA3, CellType::triangle, {}},
      {MED_TRIA6, CellType::quadratic_triangle, {}},
      {MED_TRIA7, CellType::biquadratic_triangle, {}},
      {MED_QUAD4, CellType::quad, {}},
      {MED_QUAD8, CellType::quadratic_quad, {}},
      {MED_QUAD9, CellType::biquadratic_quad, {}},
      {MED_TETRA4, CellType::tetra, {0, 2, 1, 3}},
      {MED_TETRA10, CellType::quadratic_tetra, {0, 2, 1, 3, 6, 5, 4, 7, 9, 8}},
      {MED_HEXA8, CellType::hexahedron, {0, 3, 2, 1, 4, 7, 6, 5}},
      {MED_HEXA20, CellType::quadratic_hexahedron, {0, 3, 2,  1,  4,  7,  6,  5,  11, 10,
                                                    9, 8, 15, 14, 13, 12, 16, 19, 18, 17}},
      {MED_HEXA27, CellType::triquadratic_hexahedron, {0,  3,  2,  1,  4,  7,  6,  5,  11,
                                                       10, 9,  8,  15, 14, 13, 12, 16, 19,
                                                       18, 17, 21, 23, 24, 22, 20, 25, 26}},
      {MED_PENTA6, CellType::wedge, {}},
      {MED_PENTA15, CellType::quadratic_wedge, {}},
      {MED_PENTA18, CellType::biquadratic_quadratic_wedge, {}},
      {MED_PYRA5, CellType::pyramid, {0, 3, 2, 1, 4}},
      {MED_PYRA13, CellType::quadratic_pyramid, {0, 3, 2, 1, 4, 8, 7, 6, 5, 9, 12, 11, 10}},
      {MED_OCTA12, CellType::hexagonal_prism, {}},
  };
  return kTable;
}

using Name = std::array<char, MED_NAME_SIZE + 1>;

/// A computing step.
struct MedStep {
  med_int number;
  med_int iteration;
};

class MedFile {
 public:
  explicit MedFile(const std::string& file) : file_(file) {
    med_bool is_hdf = MED_FALSE;
    med_bool is_med = MED_FALSE;
    if (MEDfileCompatibility(file.c_str(), &is_hdf, &is_med) < 0 || is_hdf != MED_TRUE) {
      throw base::ReadError(file, "is not a complete MED file: there is no whole HDF5 in it");
    }
    if (is_med != MED_TRUE) {
      throw base::ReadError(file, "is not a MED file of a version that the library 4.1 reads");
    }
    id_ = MEDfileOpen(file.c_str(), MED_ACC_RDONLY);
    if (id_ < 0) throw base::ReadError(file, "is not a complete MED file");
  }
  ~MedFile() {
    if (id_ >= 0) MEDfileClose(id_);
  }
  MedFile(const MedFile&) = delete;
  MedFile& operator=(const MedFile&) = delete;

  MeshData read(const std::string& time);

 private:
  void check(med_err status, const std::string& what) const {
    if (status < 0) throw base::ReadError(file_, "is damaged: its " + what + " cannot be read");
  }
  [[nodiscard]] std::size_t count(med_entity_type entity, med_geometry_type type,
                                  med_data_type data) const;
  void find_mesh();
  void read_points();
  void read_cells(const MedShape& shape);
  void read_polyhedra();
  void read_families();

  std::string file_;
  med_idt id_ = -1;
  Name mesh_name_{};
  MedStep mesh_step_{MED_NO_DT, MED_NO_IT};
  int axes_ = 3;
  MeshData mesh_;
  std::vector<MedRun> runs_;
};

/// Of the mesh that is read; a file cannot hold more than it has bytes.
std::size_t MedFile::count(med_entity_type entity, med_geometry_type type,
                           med_data_type data) const {
  med_bool changed = MED_FALSE;
  med_bool transformed = MED_FALSE;
  const med_int number =
      MEDmeshnEntity(id_, mesh_name_.data(), mesh_step_.number, mesh_step_.iteration, entity, type,
                     data, entity == MED_NODE ? MED_NO_CMODE : MED_NODAL, &changed, &transformed);
  return static_cast<std::size_t>(std::max<med_int>(number, 0));
}

MeshData MedFile::read(const std::string& time) {
  find_mesh();
  read_points();
  for (const MedShape& shape : shapes()) read_cells(shape);
  read_polyhedra();
  if (const std::size_t polygons = count(MED_CELL, MED_POLYGON, MED_INDEX_NODE); polygons > 1) {
    mesh_.notes.push_back(fmt::format("{} polygons are left out", polygons - 1));
  }
  read_med_fields(id_, file_, mesh_name_.data(), runs_, time, mesh_);
  read_families();
  return std::move(mesh_);
}

void MedFile::find_mesh() {
  const med_int meshes = MEDnMesh(id_);
  if (meshes < 1) throw base::ReadError(file_, "holds no mesh");
  int best = -1;
  std::size_t others = 0;
  for (int i = 1; i <= meshes; ++i) {
    const med_int axes = MEDmeshnAxis(id_, i);
    if (axes < 1 || axes > 3) throw base::ReadError(file_, "is damaged: a mesh has no axes");
    Name name{};
    med_int space = 0;
    med_int dimension = 0;
    med_int steps = 0;
    med_mesh_type type = MED_UNSTRUCTURED_MESH;
    med_sorting_type sorting = MED_SORT_DTIT;
    med_axis_type axis_type = MED_CARTESIAN;
    std::array<char, MED_COMMENT_SIZE + 1> description{};
    std::array<char, MED_SNAME_SIZE + 1> unit{};
    std::array<char, 3 * MED_SNAME_SIZE + 1> axis_names{};
    std::array<char, 3 * MED_SNAME_SIZE + 1> axis_units{};
    check(
        MEDmeshInfo(id_, i, name.data(), &space, &dimension, &type, description.data(), unit.data(),
                    &sorting, &steps, &axis_type, axis_names.data(), axis_units.data()),
        "meshes");
    if (type != MED_UNSTRUCTURED_MESH || axis_type != MED_CARTESIAN) {
      mesh_.notes.push_back(
          fmt::format("the mesh '{}' is left out: it is structured or not in Cartesian coordinates",
                      med_text(name.data(), MED_NAME_SIZE)));
      continue;
    }
    ++others;
    if (dimension <= best) continue;
    best = dimension;
    mesh_name_ = name;
    axes_ = axes;
    if (steps > 0) {
      med_float at = 0;
      check(MEDmeshComputationStepInfo(id_, name.data(), 1, &mesh_step_.number,
                                       &mesh_step_.iteration, &at),
            "meshes");
    }
  }
  if (best < 0) throw base::ReadError(file_, "holds no unstructured mesh: " + mesh_.notes.front());
  if (others > 1) {
    mesh_.notes.push_back(fmt::format("of {} meshes '{}' is read", others,
                                      med_text(mesh_name_.data(), MED_NAME_SIZE)));
  }
}

void MedFile::read_points() {
  const std::size_t points = count(MED_NODE, MED_NONE, MED_COORDINATE);
  check_mesh_fits(points, 0);
  if (points == 0) throw base::ReadError(file_, "holds no nodes");
  const auto axes = static_cast<std::size_t>(axes_);
  std::vector<double> values(points * axes);
  check(MEDmeshNodeCoordinateRd(id_, mesh_name_.data(), mesh_step_.number, mesh_step_.iteration,
                                MED_FULL_INTERLACE, values.data()),
        "nodes");
  mesh_.points.resize(points, Eigen::Vector3d::Zero());
  for (std::size_t i = 0; i < points; ++i) {
    for (std::size_t axis = 0; axis < axes; ++axis) {
      mesh_.points[i][static_cast<Eigen::Index>(axis)] = values[i * axes + axis];
    }
  }
}

/// Nodes count from 1.
std::uint32_t point_of(med_int node, std::size_t points, const std::string& file) {
  if (node < 1 || static_cast<std::size_t>(node) > points) {
    throw base::ReadError(
        file, fmt::format("a cell names node {}, but there are nodes 1 to {}", node, points));
  }
  return static_cast<std::uint32_t>(node - 1);
}

void MedFile::read_cells(const MedShape& shape) {
  const std::size_t cells = count(MED_CELL, shape.type, MED_CONNECTIVITY);
  if (cells == 0) return;
  check_mesh_fits(mesh_.points.size(), mesh_.cell_count() + cells);
  const auto size = static_cast<std::size_t>(shape.type % 100);
  std::vector<med_int> nodes(cells * size);
  check(MEDmeshElementConnectivityRd(id_, mesh_name_.data(), mesh_step_.number,
                                     mesh_step_.iteration, MED_CELL, shape.type, MED_NODAL,
                                     MED_FULL_INTERLACE, nodes.data()),
        "cells");
  runs_.push_back({shape.type, mesh_.cell_count(), cells});
  std::vector<std::uint32_t> cell(size);
  for (std::size_t i = 0; i < cells; ++i) {
    for (std::size_t k = 0; k < size; ++k) {
      const std::size_t at = shape.order.empty() ? k : shape.order[k];
      cell[k] = point_of(nodes[i * size + at], mesh_.points.size(), file_);
    }
    mesh_.add_cell(shape.cell, cell);
  }
}

void MedFile::read_polyhedra() {
  const std::size_t ends = count(MED_CELL, MED_POLYHEDRON, MED_INDEX_FACE);
  if (ends < 2) return;
  std::vector<med_int> faces(ends);
  std::vector<med_int> nodes(count(MED_CELL, MED_POLYHEDRON, MED_INDEX_NODE));
  std::vector<med_int> points(count(MED_CELL, MED_POLYHEDRON, MED_CONNECTIVITY));
  check_mesh_fits(mesh_.points.size(), mesh_.cell_count() + ends);
  check(MEDmeshPolyhedronRd(id_, mesh_name_.data(), mesh_step_.number, mesh_step_.iteration,
                            MED_CELL, MED_NODAL, faces.data(), nodes.data(), points.data()),
        "polyhedra");
  runs_.push_back({MED_POLYHEDRON, mesh_.cell_count(), ends - 1});
  const auto valid = [](const std::vector<med_int>& starts, std::size_t size) {
    return std::ranges::is_sorted(starts) && !starts.empty() && starts.front() >= 1 &&
           static_cast<std::size_t>(starts.back()) <= size + 1;
  };
  if (!valid(faces, nodes.size() - 1) || !valid(nodes, points.size())) {
    throw base::ReadError(file_, "is damaged: the faces of its polyhedra do not fit");
  }
  std::vector<std::uint32_t> cell;
  for (std::size_t i = 0; i + 1 < ends; ++i) {
    cell = {static_cast<std::uint32_t>(faces[i + 1] - faces[i])};
    for (auto face = static_cast<std::size_t>(faces[i] - 1);
         face + 1 < static_cast<std::size_t>(faces[i + 1]); ++face) {
      cell.push_back(static_cast<std::uint32_t>(nodes[face + 1] - nodes[face]));
      for (med_int k = nodes[face]; k < nodes[face + 1]; ++k) {
        cell.push_back(
            point_of(points[static_cast<std::size_t>(k - 1)], mesh_.points.size(), file_));
      }
    }
    mesh_.add_cell(CellType::polyhedron, cell);
  }
}

void MedFile::read_families() {
  Field field{"family", Location::cell, 1, std::vector<double>(mesh_.cell_count(), 0)};
  bool any = false;
  for (const MedRun& run : runs_) {
    if (count(MED_CELL, run.type, MED_FAMILY_NUMBER) != run.count) continue;
    std::vector<med_int> numbers(run.count);
    check(MEDmeshEntityFamilyNumberRd(id_, mesh_name_.data(), mesh_step_.number,
                                      mesh_step_.iteration, MED_CELL, run.type, numbers.data()),
          "families");
    std::ranges::copy(numbers, field.values.begin() + static_cast<std::ptrdiff_t>(run.first));
    any = any || std::ranges::any_of(numbers, [](med_int number) { return number != 0; });
  }
  if (any) mesh_.fields.push_back(std::move(field));
}

}  // namespace

MeshData read_med(const std::string& file, const std::string& time) {
  return read_apart(
      file, [&] { return MedFile(file).read(time); }, kSeconds);
}

}  // namespace tetraglass::mesh
