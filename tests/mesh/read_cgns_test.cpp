// Files written by the CGNS library that VTK has inside.
#include "mesh/read_cgns.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>
#include <vtk_cgns.h>
#include VTK_CGNS(cgnslib.h)

#include "base/errors.h"
#include "mesh/decompose.h"
#include "mesh/import.h"
#include "mesh/time_step.h"
#include "support/damaged.h"
#include "support/meshes.h"
#include "support/temporary_folder.h"

namespace tetraglass::mesh {
namespace {

const tests::TemporaryFolder& folder() {
  static const tests::TemporaryFolder kFolder;
  return kFolder;
}

/// A file with one base, being written.
class CgnsFile {
 public:
  explicit CgnsFile(const std::string& name, int cell_dimension = 3) : name_(folder().file(name)) {
    EXPECT_EQ(cg_open(name_.c_str(), CG_MODE_WRITE, &file_), CG_OK) << cg_get_error();
    EXPECT_EQ(cg_base_write(file_, "base", cell_dimension, 3, &base_), CG_OK);
  }
  /// Closes it.
  std::string close() {
    EXPECT_EQ(cg_close(file_), CG_OK) << cg_get_error();
    return name_;
  }
  void add_unstructured(const std::vector<Eigen::Vector3d>& points, int cells) {
    std::array<cgsize_t, 3> sizes = {static_cast<cgsize_t>(points.size()), cells, 0};
    add_zone(sizes.data(), CGNS_ENUMV(Unstructured), points);
  }
  /// i runs fastest.
  void add_structured(int ni, int nj, int nk, const std::vector<Eigen::Vector3d>& points) {
    std::array<cgsize_t, 9> sizes = {ni, nj, nk, ni - 1, nj - 1, nk - 1, 0, 0, 0};
    add_zone(sizes.data(), CGNS_ENUMV(Structured), points);
  }
  /// Nodes count from 1; elements follow those before.
  void add_section(CGNS_ENUMT(ElementType_t) type, int cells, const std::vector<cgsize_t>& nodes) {
    int section = 0;
    EXPECT_EQ(cg_section_write(file_, base_, zone_, next_name().c_str(), type, cells_ + 1,
                               cells_ + cells, 0, nodes.data(), &section),
              CG_OK)
        << cg_get_error();
    cells_ += cells;
  }
  void add_sections_with_offsets(CGNS_ENUMT(ElementType_t) type, int cells,
                                 const std::vector<cgsize_t>& nodes,
                                 const std::vector<cgsize_t>& offsets) {
    int section = 0;
    EXPECT_EQ(cg_poly_section_write(file_, base_, zone_, next_name().c_str(), type, cells_ + 1,
                                    cells_ + cells, 0, nodes.data(), offsets.data(), &section),
              CG_OK)
        << cg_get_error();
    cells_ += cells;
  }
  void add_solution(const std::string& name, CGNS_ENUMT(GridLocation_t) place) {
    EXPECT_EQ(cg_sol_write(file_, base_, zone_, name.c_str(), place, &solution_), CG_OK);
  }
  void add_field(const std::string& name, const std::vector<double>& values) {
    int field = 0;
    EXPECT_EQ(cg_field_write(file_, base_, zone_, solution_, CGNS_ENUMV(RealDouble), name.c_str(),
                             values.data(), &field),
              CG_OK)
        << cg_get_error();
  }
  /// At each time one of the solutions, whose names have 32 letters.
  void add_times(const std::vector<double>& times, const std::string& names) {
    const auto count = static_cast<cgsize_t>(times.size());
    EXPECT_EQ(cg_biter_write(file_, base_, "times", static_cast<int>(count)), CG_OK);
    EXPECT_EQ(cg_goto(file_, base_, "BaseIterativeData_t", 1, "end"), CG_OK);
    EXPECT_EQ(cg_array_write("TimeValues", CGNS_ENUMV(RealDouble), 1, &count, times.data()), CG_OK);
    EXPECT_EQ(cg_ziter_write(file_, base_, zone_, "solutions"), CG_OK);
    EXPECT_EQ(cg_goto(file_, base_, "Zone_t", zone_, "ZoneIterativeData_t", 1, "end"), CG_OK);
    const std::array<cgsize_t, 2> sizes = {32, count};
    EXPECT_EQ(cg_array_write("FlowSolutionPointers", CGNS_ENUMV(Character), 2, sizes.data(),
                             names.data()),
              CG_OK);
    EXPECT_EQ(cg_simulation_type_write(file_, base_, CGNS_ENUMV(TimeAccurate)), CG_OK);
  }

 private:
  std::string next_name() { return "s" + std::to_string(++names_); }
  void add_zone(const cgsize_t* sizes, CGNS_ENUMT(ZoneType_t) type,
                const std::vector<Eigen::Vector3d>& points) {
    EXPECT_EQ(cg_zone_write(file_, base_, next_name().c_str(), sizes, type, &zone_), CG_OK);
    cells_ = 0;
    constexpr std::array<const char*, 3> kNames = {"CoordinateX", "CoordinateY", "CoordinateZ"};
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> values;
      for (const Eigen::Vector3d& p : points) values.push_back(p[axis]);
      int coordinate = 0;
      EXPECT_EQ(cg_coord_write(file_, base_, zone_, CGNS_ENUMV(RealDouble),
                               kNames[static_cast<std::size_t>(axis)], values.data(), &coordinate),
                CG_OK);
    }
  }

  std::string name_;
  int file_ = 0;
  int base_ = 0;
  int zone_ = 0;
  int solution_ = 0;
  int names_ = 0;
  cgsize_t cells_ = 0;
};

/// A cube, its right neighbour cut into two wedges, a pyramid on the cube and a tetrahedron below
/// the first wedge.
const std::vector<Eigen::Vector3d> kPoints = {
    {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1},     {1, 1, 1},
    {0, 1, 1}, {2, 0, 0}, {2, 1, 0}, {2, 0, 1}, {2, 1, 1}, {.5, .5, 1.5}, {1, 0, -1}};
const std::vector<cgsize_t> kCube = {1, 2, 3, 4, 5, 6, 7, 8};
const std::vector<cgsize_t> kWedges = {2, 9, 3, 6, 11, 7, 9, 10, 3, 11, 12, 7};
const std::vector<cgsize_t> kPyramid = {5, 6, 7, 8, 13};
const std::vector<cgsize_t> kTetrahedron = {2, 3, 9, 14};
constexpr double kVolume = 1 + 1 + 1.0 / 6 + 1.0 / 6;

const Field& field(const MeshData& mesh, const std::string& name) {
  const auto found =
      std::ranges::find_if(mesh.fields, [&](const Field& f) { return f.name == name; });
  if (found == mesh.fields.end()) throw base::InputError("there is no field " + name);
  return *found;
}

void expect_sound(const MeshData& mesh, double volume) {
  const Decomposition split = decompose(mesh);
  EXPECT_EQ(split.inverted, 0U);
  double sum = 0;
  for (const Cell& cell : split.mesh.cells) sum += tests::volume(split.mesh, cell);
  EXPECT_NEAR(sum, volume, 1e-12 * volume);
}

void add_solutions(CgnsFile& file, const std::vector<double>& of_cells) {
  file.add_solution("at vertices", CGNS_ENUMV(Vertex));
  const std::array<std::string, 3> velocity = {"VelocityX", "VelocityY", "VelocityZ"};
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const Eigen::Vector3d& p : kPoints) values.push_back(10 * p[axis]);
    file.add_field(velocity[static_cast<std::size_t>(axis)], values);
  }
  std::vector<double> temperature;
  for (const Eigen::Vector3d& p : kPoints) temperature.push_back(p.sum());
  file.add_field("Temperature", temperature);
  file.add_solution("in cells", CGNS_ENUMV(CellCenter));
  file.add_field("Pressure", of_cells);
}

void expect_solutions(const MeshData& mesh) {
  ASSERT_EQ(mesh.points.size(), kPoints.size());
  for (std::size_t i = 0; i < kPoints.size(); ++i) {
    EXPECT_EQ(mesh.points[i], kPoints[i]);
    EXPECT_EQ(field(mesh, "Temperature").values.at(i), kPoints[i].sum());
    EXPECT_EQ(field(mesh, "Velocity").values.at(3 * i + 1), 10 * kPoints[i].y());
  }
  EXPECT_EQ(field(mesh, "Velocity").components, 3);
  EXPECT_EQ(field(mesh, "Pressure").location, Location::cell);
}

TEST(ReadCgns, SectionsOfAllShapes) {
  CgnsFile file("sections.cgns");
  file.add_unstructured(kPoints, 5);
  file.add_section(CGNS_ENUMV(HEXA_8), 1, kCube);
  file.add_section(CGNS_ENUMV(PENTA_6), 2, kWedges);
  file.add_section(CGNS_ENUMV(PYRA_5), 1, kPyramid);
  file.add_section(CGNS_ENUMV(TETRA_4), 1, kTetrahedron);
  file.add_section(CGNS_ENUMV(QUAD_4), 1, {1, 4, 3, 2});  // a boundary patch
  add_solutions(file, {1, 2, 3, 4, 5});
  const MeshData mesh = read_cgns(file.close(), "");
  expect_sound(mesh, kVolume);
  expect_solutions(mesh);
  EXPECT_EQ(mesh.census(), (std::map<CellType, std::size_t>{{CellType::tetra, 1},
                                                            {CellType::hexahedron, 1},
                                                            {CellType::wedge, 2},
                                                            {CellType::pyramid, 1}}));
  EXPECT_EQ(field(mesh, "Pressure").values, (std::vector<double>{1, 2, 3, 4, 5}));
}

TEST(ReadCgns, MixedSection) {
  CgnsFile file("mixed.cgns");
  file.add_unstructured(kPoints, 3);
  std::vector<cgsize_t> nodes = {CGNS_ENUMV(HEXA_8)};
  std::vector<cgsize_t> offsets = {0};
  nodes.insert(nodes.end(), kCube.begin(), kCube.end());
  offsets.push_back(static_cast<cgsize_t>(nodes.size()));
  nodes.push_back(CGNS_ENUMV(PYRA_5));
  nodes.insert(nodes.end(), kPyramid.begin(), kPyramid.end());
  offsets.push_back(static_cast<cgsize_t>(nodes.size()));
  nodes.push_back(CGNS_ENUMV(PENTA_6));
  nodes.insert(nodes.end(), kWedges.begin(), kWedges.begin() + 6);
  offsets.push_back(static_cast<cgsize_t>(nodes.size()));
  file.add_sections_with_offsets(CGNS_ENUMV(MIXED), 3, nodes, offsets);
  add_solutions(file, {1, 2, 3});
  const MeshData mesh = read_cgns(file.close(), "");
  expect_sound(mesh, 1 + 1.0 / 6 + 0.5);
  expect_solutions(mesh);
  EXPECT_EQ(field(mesh, "Pressure").values, (std::vector<double>{1, 2, 3}));
}

TEST(ReadCgns, PolyhedraOfFaces) {
  CgnsFile file("polyhedra.cgns");
  file.add_unstructured(kPoints, 1);
  // The faces of the cube, and the cube of them.
  file.add_sections_with_offsets(CGNS_ENUMV(NGON_n), 6, {1, 4, 3, 2, 5, 6, 7, 8, 1, 2, 6, 5,
                                                         2, 3, 7, 6, 3, 4, 8, 7, 4, 1, 5, 8},
                                 {0, 4, 8, 12, 16, 20, 24});
  file.add_sections_with_offsets(CGNS_ENUMV(NFACE_n), 1, {1, 2, 3, 4, 5, 6}, {0, 6});
  const MeshData mesh = read_cgns(file.close(), "");
  EXPECT_EQ(mesh.types, std::vector<CellType>{CellType::polyhedron});
  expect_sound(mesh, 1);
}

TEST(ReadCgns, QuadraticElementsKeepTheirEdges) {
  struct Shape {
    CGNS_ENUMT(ElementType_t) type;
    CellType cell;
    std::vector<std::size_t> corners;  ///< in kPoints
    std::vector<std::vector<std::size_t>>
        middles;  ///< corners whose mean each further node is, in the order of the standard
    double volume;
  };
  // CGNS: Standard Interface Data Structures, section 3.3, "Unstructured Grid Element Numbering".
  const std::vector<Shape> shapes = {
      {CGNS_ENUMV(TETRA_10),
       CellType::quadratic_tetra,
       {1, 2, 8, 13},
       {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}},
       1.0 / 6},
      {CGNS_ENUMV(PYRA_13),
       CellType::quadratic_pyramid,
       {4, 5, 6, 7, 12},
       {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}},
       1.0 / 6},
      {CGNS_ENUMV(PENTA_15),
       CellType::quadratic_wedge,
       {1, 8, 2, 5, 10, 6},
       {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 4}, {2, 5}, {3, 4}, {4, 5}, {5, 3}},
       0.5},
      {CGNS_ENUMV(PENTA_18),
       CellType::biquadratic_quadratic_wedge,
       {1, 8, 2, 5, 10, 6},
       {{0, 1},
        {1, 2},
        {2, 0},
        {0, 3},
        {1, 4},
        {2, 5},
        {3, 4},
        {4, 5},
        {5, 3},
        {0, 1, 3, 4},
        {1, 2, 4, 5},
        {0, 2, 3, 5}},
       0.5},
      {CGNS_ENUMV(HEXA_20),
       CellType::quadratic_hexahedron,
       {0, 1, 2, 3, 4, 5, 6, 7},
       {{0, 1},
        {1, 2},
        {2, 3},
        {3, 0},
        {0, 4},
        {1, 5},
        {2, 6},
        {3, 7},
        {4, 5},
        {5, 6},
        {6, 7},
        {7, 4}},
       1},
      {CGNS_ENUMV(HEXA_27),
       CellType::triquadratic_hexahedron,
       {0, 1, 2, 3, 4, 5, 6, 7},
       {{0, 1},
        {1, 2},
        {2, 3},
        {3, 0},
        {0, 4},
        {1, 5},
        {2, 6},
        {3, 7},
        {4, 5},
        {5, 6},
        {6, 7},
        {7, 4},
        {0, 1, 2, 3},
        {0, 1, 4, 5},
        {1, 2, 5, 6},
        {2, 3, 6, 7},
        {0, 3, 4, 7},
        {4, 5, 6, 7},
        {0, 1, 2, 3, 4, 5, 6, 7}},
       1},
  };
  for (const Shape& shape : shapes) {
    SCOPED_TRACE(to_string(shape.cell));
    std::vector<Eigen::Vector3d> points;
    for (const std::size_t corner : shape.corners) points.push_back(kPoints[corner]);
    for (const auto& middle : shape.middles) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (const std::size_t corner : middle) sum += points[corner];
      points.emplace_back(sum / static_cast<double>(middle.size()));
    }
    std::vector<cgsize_t> nodes(points.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = static_cast<cgsize_t>(i + 1);
    CgnsFile file("quadratic.cgns");
    file.add_unstructured(points, 1);
    file.add_section(shape.type, 1, nodes);
    const std::string name = file.close();
    const MeshData mesh = read_cgns(name, "");
    ASSERT_EQ(mesh.types, std::vector<CellType>{shape.cell});
    ImportOptions refined;
    refined.refine_quadratic = true;
    for (const ImportOptions& options : {ImportOptions(), refined}) {
      const Import import = import_mesh(name, options);
      double sum = 0;
      for (const Cell& cell : import.mesh.cells) sum += tests::volume(import.mesh, cell);
      EXPECT_NEAR(sum, shape.volume, 1e-14);
      EXPECT_EQ(import.report.inverted, 0U);
    }
  }
}

TEST(ReadCgns, StructuredZonesBecomeHexahedra) {
  CgnsFile file("structured.cgns");
  for (int zone = 0; zone < 2; ++zone) {
    std::vector<Eigen::Vector3d> points;
    std::vector<double> values;
    for (int k = 0; k < 2; ++k) {
      for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 4; ++i) {
          points.emplace_back(i + 10 * zone, j, 2 * k);
          values.push_back(points.back().sum());
        }
      }
    }
    file.add_structured(4, 3, 2, points);
    file.add_solution("at vertices", CGNS_ENUMV(Vertex));
    file.add_field("Density", values);
    file.add_solution("in cells", CGNS_ENUMV(CellCenter));
    file.add_field("Mach", {0, 1, 2, 3, 4, 5});
  }
  const MeshData mesh = read_cgns(file.close(), "");
  ASSERT_EQ(mesh.census(), (std::map<CellType, std::size_t>{{CellType::hexahedron, 12}}));
  expect_sound(mesh, 24);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    EXPECT_EQ(field(mesh, "Density").values.at(i), mesh.points[i].sum());
  }
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(field(mesh, "Mach").values.at(i), static_cast<double>(i % 6));
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const std::uint32_t p : mesh.cell(i)) middle += mesh.points[p] / 8;
    EXPECT_EQ(middle.x(), 0.5 + static_cast<double>(i % 3) + (i < 6 ? 0 : 10)) << i;
  }
  EXPECT_EQ(field(mesh, "part").values.back(), 1);
}

TEST(ReadCgns, TimeSteps) {
  CgnsFile file("steps.cgns");
  file.add_unstructured(kPoints, 1);
  file.add_section(CGNS_ENUMV(TETRA_4), 1, kTetrahedron);
  std::string names;
  for (int step = 0; step < 3; ++step) {
    std::string name = "solution" + std::to_string(step);
    file.add_solution(name, CGNS_ENUMV(Vertex));
    file.add_field("Temperature", std::vector<double>(kPoints.size(), 100.0 + step));
    name.resize(32, ' ');
    names += name;
  }
  file.add_times({0, 0.5, 2}, names);
  const std::string name = file.close();
  const auto temperature = [&](const std::string& time) {
    return field(read_cgns(name, time), "Temperature").values.at(0);
  };
  EXPECT_EQ(temperature(""), 102);
  EXPECT_EQ(temperature("0.5"), 101);
  EXPECT_EQ(temperature("index:0"), 100);
  try {
    static_cast<void>(temperature("index:3"));
    FAIL() << "there is no such step";
  } catch (const NoTimeStepError& error) {  // from the process that reads
    EXPECT_EQ(error.steps(), 3U);
    EXPECT_EQ(std::string(error.what()),
              "there is no time step 'index:3'; there are index:0 to index:2");
  }
}

TEST(ReadCgns, SurfacesAreFilled) {
#ifndef TETRAGLASS_WITH_TETGEN
  GTEST_SKIP() << "without TetGen no surface is filled";
#endif
  CgnsFile file("surface.cgns", 2);
  file.add_unstructured({kPoints.begin(), kPoints.begin() + 8}, 6);
  file.add_section(CGNS_ENUMV(QUAD_4), 6,
                   {1, 4, 3, 2, 5, 6, 7, 8, 1, 2, 6, 5, 2, 3, 7, 6, 3, 4, 8, 7, 4, 1, 5, 8});
  const Import import = import_mesh(file.close());
  double sum = 0;
  for (const Cell& cell : import.mesh.cells) sum += tests::volume(import.mesh, cell);
  EXPECT_NEAR(sum, 1, 1e-10);
}

TEST(ReadCgns, WhatLiesIsRefusedInOneLine) {
  CgnsFile file("whole.cgns");
  file.add_unstructured(kPoints, 1);
  file.add_section(CGNS_ENUMV(TETRA_4), 1, kTetrahedron);
  const std::string whole = tests::read_text(file.close());
  const std::string name = folder().file("damaged.cgns");
  tests::expect_damage_refused(name, whole);
  CgnsFile beyond("beyond.cgns");
  beyond.add_unstructured(kPoints, 1);
  beyond.add_section(CGNS_ENUMV(TETRA_4), 1, {1, 2, 3, 15});
  tests::expect_refused(name, tests::read_text(beyond.close()));
}

}  // namespace
}  // namespace tetraglass::mesh
