// Files written by the MED library.
#include "mesh/read_med.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>
#include <med.h>

#include "base/errors.h"
#include "mesh/decompose.h"
#include "mesh/import.h"
#include "support/damaged.h"
#include "support/meshes.h"
#include "support/temporary_folder.h"

namespace tetraglass::mesh {
namespace {

const tests::TemporaryFolder& folder() {
  static const tests::TemporaryFolder kFolder;
  return kFolder;
}

constexpr const char* kMesh = "mesh";
constexpr const char* kAxes = "x               y               z               ";

/// A file with one mesh, being written.
class MedWriter {
 public:
  MedWriter(const std::string& name, const std::vector<Eigen::Vector3d>& points, int dimension = 3)
      : name_(folder().file(name)), id_(MEDfileOpen(name_.c_str(), MED_ACC_CREAT)) {
    EXPECT_GE(id_, 0);
    EXPECT_EQ(MEDmeshCr(id_, kMesh, 3, dimension, MED_UNSTRUCTURED_MESH, "", "", MED_SORT_DTIT,
                        MED_CARTESIAN, kAxes, kAxes),
              0);
    std::vector<double> values;
    for (const Eigen::Vector3d& p : points) values.insert(values.end(), {p.x(), p.y(), p.z()});
    EXPECT_EQ(MEDmeshNodeCoordinateWr(id_, kMesh, MED_NO_DT, MED_NO_IT, 0, MED_FULL_INTERLACE,
                                      static_cast<med_int>(points.size()), values.data()),
              0);
    EXPECT_EQ(MEDfamilyCr(id_, kMesh, "none", 0, 0, ""), 0);
  }
  std::string close() {
    EXPECT_EQ(MEDfileClose(id_), 0);
    return name_;
  }
  /// Nodes count from 1.
  void add_cells(med_geometry_type type, const std::vector<med_int>& nodes) {
    EXPECT_EQ(MEDmeshElementConnectivityWr(id_, kMesh, MED_NO_DT, MED_NO_IT, 0, MED_CELL, type,
                                           MED_NODAL, MED_FULL_INTERLACE,
                                           static_cast<med_int>(nodes.size()) / (type % 100),
                                           nodes.data()),
              0);
  }
  void add_polyhedra(const std::vector<med_int>& faces, const std::vector<med_int>& nodes,
                     const std::vector<med_int>& points) {
    EXPECT_EQ(MEDmeshPolyhedronWr(id_, kMesh, MED_NO_DT, MED_NO_IT, 0, MED_CELL, MED_NODAL,
                                  static_cast<med_int>(faces.size()), faces.data(),
                                  static_cast<med_int>(nodes.size()), nodes.data(), points.data()),
              0);
  }
  void add_families(med_geometry_type type, const std::vector<med_int>& numbers) {
    EXPECT_EQ(MEDmeshEntityFamilyNumberWr(id_, kMesh, MED_NO_DT, MED_NO_IT, MED_CELL, type,
                                          static_cast<med_int>(numbers.size()), numbers.data()),
              0);
  }
  void create_field(const std::string& name, med_field_type type, int components) {
    const std::string names(kAxes, static_cast<std::size_t>(components) * MED_SNAME_SIZE);
    EXPECT_EQ(
        MEDfieldCr(id_, name.c_str(), type, components, names.c_str(), names.c_str(), "s", kMesh),
        0);
  }
  template <typename T>
  void add_values(const std::string& name, int step, double time, med_entity_type entity,
                  med_geometry_type type, int count, const std::vector<T>& values,
                  const std::vector<med_int>& profile = {}) {
    const char* profile_name = MED_NO_PROFILE;
    if (!profile.empty()) {
      profile_name = "profile";
      EXPECT_EQ(
          MEDprofileWr(id_, profile_name, static_cast<med_int>(profile.size()), profile.data()), 0);
    }
    EXPECT_EQ(MEDfieldValueWithProfileWr(id_, name.c_str(), step, MED_NO_IT, time, entity, type,
                                         MED_COMPACT_STMODE, profile_name, MED_NO_LOCALIZATION,
                                         MED_FULL_INTERLACE, MED_ALL_CONSTITUENT, count,
                                         reinterpret_cast<const unsigned char*>(values.data())),
              0);
  }

 private:
  std::string name_;
  med_idt id_;
};

/// A cube, its right neighbour cut into two wedges, a pyramid on the cube and a tetrahedron below
/// the first wedge. In MED all of them begin by a face that is seen from outside.
const std::vector<Eigen::Vector3d> kPoints = {
    {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1},     {1, 1, 1},
    {0, 1, 1}, {2, 0, 0}, {2, 1, 0}, {2, 0, 1}, {2, 1, 1}, {.5, .5, 1.5}, {1, 0, -1}};
const std::vector<med_int> kCube = {1, 4, 3, 2, 5, 8, 7, 6};
const std::vector<med_int> kWedges = {2, 3, 9, 6, 7, 11, 9, 3, 10, 11, 7, 12};
const std::vector<med_int> kPyramid = {5, 8, 7, 6, 13};
const std::vector<med_int> kTetrahedron = {2, 9, 3, 14};
constexpr double kVolume = 1 + 1 + 1.0 / 6 + 1.0 / 6;

const Field& field(const MeshData& mesh, const std::string& name,
                   Location location = Location::point) {
  const auto found = std::ranges::find_if(mesh.fields, [&](const Field& f) {
    return f.name == name && (f.location == location || f.name == "family");
  });
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

TEST(ReadMed, CellsOfAllShapesWithTheirFamilies) {
  MedWriter file("shapes.med", kPoints);
  file.add_cells(MED_HEXA8, kCube);
  file.add_cells(MED_PENTA6, kWedges);
  file.add_cells(MED_PYRA5, kPyramid);
  file.add_cells(MED_TETRA4, kTetrahedron);
  file.add_cells(MED_QUAD4, {1, 4, 3, 2});
  file.add_families(MED_PENTA6, {-3, -4});
  file.add_families(MED_TETRA4, {-5});
  const MeshData mesh = read_med(file.close(), "");
  ASSERT_EQ(mesh.points.size(), kPoints.size());
  for (std::size_t i = 0; i < kPoints.size(); ++i) EXPECT_EQ(mesh.points[i], kPoints[i]);
  expect_sound(mesh, kVolume);
  EXPECT_EQ(mesh.types,
            (std::vector<CellType>{CellType::quad, CellType::tetra, CellType::hexahedron,
                                   CellType::wedge, CellType::wedge, CellType::pyramid}));
  EXPECT_EQ(field(mesh, "family").values, (std::vector<double>{0, -5, 0, -3, -4, 0}));
}

TEST(ReadMed, Polyhedra) {
  MedWriter file("polyhedra.med", kPoints);
  file.add_cells(MED_TETRA4, kTetrahedron);
  file.add_polyhedra({1, 7}, {1, 5, 9, 13, 17, 21, 25},
                     {1, 4, 3, 2, 5, 6, 7, 8, 1, 2, 6, 5, 2, 3, 7, 6, 3, 4, 8, 7, 4, 1, 5, 8});
  const MeshData mesh = read_med(file.close(), "");
  EXPECT_EQ(mesh.types, (std::vector<CellType>{CellType::tetra, CellType::polyhedron}));
  expect_sound(mesh, 1 + 1.0 / 6);
}

TEST(ReadMed, QuadraticElementsKeepTheirEdges) {
  using Middles = std::vector<std::vector<std::size_t>>;
  struct Shape {
    med_geometry_type type;
    std::vector<med_int> corners;
    Middles middles;  ///< corners whose mean each further node is
    double volume;
  };
  const Middles wedge = {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}};
  const Middles brick = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                         {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  const auto with = [](Middles middles, const Middles& more) {
    middles.insert(middles.end(), more.begin(), more.end());
    return middles;
  };
  const std::vector<med_int> first_wedge(kWedges.begin(), kWedges.begin() + 6);
  const std::vector<Shape> all = {
      {MED_TETRA10, kTetrahedron, {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}, 1.0 / 6},
      {MED_PYRA13,
       kPyramid,
       {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}},
       1.0 / 6},
      {MED_PENTA15, first_wedge, wedge, 0.5},
      {MED_PENTA18, first_wedge, with(wedge, {{0, 1, 3, 4}, {1, 2, 4, 5}, {2, 0, 3, 5}}), 0.5},
      {MED_HEXA20, kCube, brick, 1},
      {MED_HEXA27, kCube,
       with(brick, {{0, 1, 2, 3},
                    {0, 1, 4, 5},
                    {1, 2, 5, 6},
                    {2, 3, 6, 7},
                    {0, 3, 4, 7},
                    {4, 5, 6, 7},
                    {0, 1, 2, 3, 4, 5, 6, 7}}),
       1}};
  for (const Shape& shape : all) {
    SCOPED_TRACE(shape.type);
    std::vector<Eigen::Vector3d> points;
    for (const med_int node : shape.corners) {
      points.push_back(kPoints[static_cast<std::size_t>(node - 1)]);
    }
    for (const auto& middle : shape.middles) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (const std::size_t corner : middle) sum += points[corner];
      points.emplace_back(sum / static_cast<double>(middle.size()));
    }
    std::vector<med_int> nodes;
    for (std::size_t i = 0; i < points.size(); ++i) nodes.push_back(static_cast<med_int>(i + 1));
    MedWriter file("quadratic.med", points);
    file.add_cells(shape.type, nodes);
    const std::string name = file.close();
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

TEST(ReadMed, FieldsOfATimeAndOfAllTimes) {
  MedWriter file("fields.rmed", kPoints);
  file.add_cells(MED_TETRA4, kTetrahedron);
  file.add_cells(MED_PENTA6, kWedges);
  file.create_field("TEMP", MED_FLOAT64, 1);
  file.create_field("DEPL", MED_FLOAT64, 3);
  file.create_field("MATER", MED_INT, 1);
  const auto points = static_cast<int>(kPoints.size());
  for (int step = 0; step < 3; ++step) {
    file.add_values("TEMP", step, 0.5 * step, MED_NODE, MED_NONE, points,
                    std::vector<double>(kPoints.size(), 100.0 + step));
  }
  std::vector<double> displacement;
  for (int i = 0; i < 3 * points; ++i) displacement.push_back(i);
  file.add_values("DEPL", 2, 1, MED_NODE, MED_NONE, points, displacement);
  // Of the two wedges the second one alone has a value; the tetrahedron has.
  file.add_values("MATER", MED_NO_DT, 0, MED_CELL, MED_TETRA4, 1, std::vector<med_int>{7});
  file.add_values("MATER", MED_NO_DT, 0, MED_CELL, MED_PENTA6, 1, std::vector<med_int>{9}, {2});
  const std::string name = file.close();
  const MeshData last = read_med(name, "");
  EXPECT_EQ(field(last, "TEMP").values, std::vector<double>(kPoints.size(), 102));
  EXPECT_EQ(field(last, "DEPL").components, 3);
  EXPECT_EQ(field(last, "DEPL").values, displacement);
  const std::vector<double>& material = field(last, "MATER", Location::cell).values;
  ASSERT_EQ(material.size(), 3U);
  EXPECT_EQ(material[0], 7);
  EXPECT_TRUE(std::isnan(material[1]));
  EXPECT_EQ(material[2], 9);
  const MeshData middle = read_med(name, "0.6");
  EXPECT_EQ(field(middle, "TEMP").values.at(0), 101);
  EXPECT_THROW(static_cast<void>(field(middle, "DEPL")), base::InputError);
  EXPECT_TRUE(
      std::ranges::find(middle.notes, "'DEPL' has no values at that time and is left out") !=
      middle.notes.end());
  EXPECT_EQ(field(read_med(name, "index:0"), "TEMP").values.at(0), 100);
  EXPECT_THROW(static_cast<void>(read_med(name, "index:3")), base::UsageError);
}

TEST(ReadMed, WhatLiesIsRefusedInOneLine) {
  MedWriter file("whole.med", kPoints);
  file.add_cells(MED_TETRA4, kTetrahedron);
  const std::string whole = tests::read_text(file.close());
  const std::string name = folder().file("damaged.med");
  tests::expect_damage_refused(name, whole);
  MedWriter beyond("beyond.med", kPoints);
  beyond.add_cells(MED_TETRA4, {1, 2, 3, 15});
  tests::expect_refused(name, tests::read_text(beyond.close()));
}

}  // namespace
}  // namespace tetraglass::mesh
