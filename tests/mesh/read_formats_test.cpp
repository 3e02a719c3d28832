// The smaller formats of meshes: each as a pyramid beside a tetrahedron, or what the format can
// say.
#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/errors.h"
#include "mesh/append.h"
#include "mesh/decompose.h"
#include "mesh/import.h"
#include "mesh/read_abaqus.h"
#include "mesh/read_apart.h"
#include "mesh/read_collection.h"
#include "mesh/read_ensight.h"
#include "mesh/read_gambit.h"
#include "mesh/read_gmsh.h"
#include "mesh/read_medit.h"
#include "mesh/read_netgen.h"
#include "mesh/read_points.h"
#include "mesh/read_pos.h"
#include "mesh/read_tetgen.h"
#include "mesh/read_ucd.h"
#include "mesh/write.h"
#include "support/meshes.h"
#include "support/temporary_folder.h"
#include "support/total_volume.h"

namespace tetraglass::mesh {
namespace {

const tests::TemporaryFolder& folder() {
  static const tests::TemporaryFolder kFolder;
  return kFolder;
}

std::string write(const std::string& name, const std::string& content) {
  tests::write_text(folder().file(name), content);
  return folder().file(name);
}

double volume_of(const MeshData& data) {
  const Decomposition split = decompose(data);
  EXPECT_EQ(split.inverted, 0U) << "cells are the right way round";
  return tests::total_volume(split.mesh);
}

/// Every file that is cut off anywhere before its last line is refused in one line.
template <typename Read>
void expect_cuts_refused(const std::string& name, const std::string& content, std::size_t end,
                         const Read& read) {
  for (std::size_t size = 1; size < end; ++size) {
    try {
      static_cast<void>(read(write("cut_" + name, content.substr(0, size))));
      ADD_FAILURE() << name << " cut off at " << size << " was read";
    } catch (const base::Error& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
}

const std::string kMedit =
    "MeshVersionFormatted 2\nDimension 3\n# points\nVertices 8\n0 0 0 0\n1 0 0 0\n1 1 0 0\n0 1 0 "
    "0\n0 0 1 0\n1 0 1 0\n1 1 1 0\n0 1 1 0\nRidges 1\n1\nHexahedra 1\n1 2 3 4 5 6 7 8 "
    "5\nPrisms\n1\n"
    "1 2 3 5 6 7 9\nTetrahedra 1\n1 2 3 5 7\nPyramids 1 1 2 3 4 5 6\nTriangles 1\n1 2 3 1\nEnd\n";

TEST(ReadMedit, CellsOfAllKindsWithTheirReferences) {
  const MeshData mesh = read_medit(write("a.mesh", kMedit));
  ASSERT_EQ(mesh.cell_count(), 5U);
  EXPECT_NEAR(volume_of(mesh), 1 + 0.5 + 1.0 / 6 + 1.0 / 3, 1e-14);
  ASSERT_EQ(mesh.fields.size(), 1U);
  EXPECT_EQ(mesh.fields[0].values, (std::vector<double>{5, 9, 7, 6, 1}));
}

TEST(ReadMedit, SolutionsBesideTheMesh) {
  write("b.mesh", kMedit);
  std::string solution = "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n8\n2 1 2\n";
  for (int i = 0; i < 8; ++i) solution += fmt::format("{} {} 0 {}\n", i, 10 * i, -i);
  solution += "SolAtTetrahedra 1\n1 1\n3.5\nEnd\n";
  const std::string file = write("b.sol", solution);
  const MeshData mesh = read_medit(file);
  ASSERT_EQ(mesh.fields.size(), 4U);
  EXPECT_EQ(mesh.fields[0].name, "solution 0");
  EXPECT_EQ(mesh.fields[0].values[3], 3);
  EXPECT_EQ(mesh.fields[1].components, 3);
  EXPECT_EQ(mesh.fields[1].values[3 * 3], 30);
  EXPECT_EQ(mesh.fields[2].values[2], 3.5);
  EXPECT_TRUE(std::isnan(mesh.fields[2].values[0]));
  EXPECT_EQ(mesh.fields[3].name, "reference");
  write("b.sol", "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n7\n1 1\n1 2 3 4 5 6 7\nEnd");
  EXPECT_THROW(static_cast<void>(read_medit(file)), base::ReadError);
  EXPECT_THROW(static_cast<void>(read_medit(write("alone.sol", solution))), base::ReadError);
}

/// Builds a binary file of one tetrahedron.
class MeditBytes {
 public:
  MeditBytes(int version, bool swapped) : version_(version), swapped_(swapped) {
    put(std::int32_t{1});
    put(std::int32_t{version});
    open(3);
    version >= 4 ? put(std::int32_t{3}) : put(std::int32_t{3});
    close();
    open(4);
    count(4);
    for (int i = 0; i < 4; ++i) {
      for (int axis = 1; axis < 4; ++axis) real(i == axis ? 1 : 0);
      count(0);
    }
    close();
    open(999);  // of no meaning
    count(1);
    count(77);
    close();
    open(8);
    count(1);
    for (int i = 1; i <= 4; ++i) count(i);
    count(0);
    close();
    put(std::int32_t{54});
    version >= 3 ? put(std::int64_t{0}) : put(std::int32_t{0});
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  template <typename T>
  void put(T value, std::size_t at = std::string::npos) {
    auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if (swapped_) std::ranges::reverse(raw);
    if (at == std::string::npos) {
      bytes_.append(raw.data(), raw.size());
    } else {
      bytes_.replace(at, raw.size(), raw.data(), raw.size());
    }
  }
  void count(int value) {
    version_ >= 4 ? put(static_cast<std::int64_t>(value)) : put(std::int32_t{value});
  }
  void real(double value) { version_ == 1 ? put(static_cast<float>(value)) : put(value); }
  void open(int keyword) {
    put(std::int32_t{keyword});
    end_ = bytes_.size();
    version_ >= 3 ? put(std::int64_t{0}) : put(std::int32_t{0});
  }
  void close() {
    version_ >= 3 ? put(static_cast<std::int64_t>(bytes_.size()), end_)
                  : put(static_cast<std::int32_t>(bytes_.size()), end_);
  }

  int version_;
  bool swapped_;
  std::string bytes_;
  std::size_t end_ = 0;
};

TEST(ReadMedit, BinaryOfAllVersionsAndByteOrders) {
  for (int version = 1; version <= 3; ++version) {
    for (const bool swapped : {false, true}) {
      const MeshData mesh = read_medit(write("a.meshb", MeditBytes(version, swapped).bytes()));
      ASSERT_EQ(mesh.cell_count(), 1U) << version;
      EXPECT_NEAR(volume_of(mesh), 1.0 / 6, 1e-15);
    }
  }
  const std::string whole = MeditBytes(2, true).bytes();
  expect_cuts_refused("a.meshb", whole, whole.size() - 8, [](const std::string& file) {
    MeshData mesh = read_medit(file);
    return decompose(mesh);  // between two sections a cut is not seen, but cells are missing then
  });
}

TEST(ReadMedit, WhatLiesIsRefused) {
  const auto refused = [](const std::string& content) {
    EXPECT_THROW(static_cast<void>(read_medit(write("c.mesh", content))), base::ReadError)
        << content;
  };
  const std::string head = "MeshVersionFormatted 2\nDimension 3\n";
  refused("nonsense");
  refused("MFEM mesh v1.0\n");
  refused("MeshVersionFormatted 2\nDimension 4\n");
  refused(head + "Vertices 1000000000\n0 0 0 0\n");
  refused(head + "Vertices 1\n0 0\n");
  refused(head + "Vertices 1\n0 0 x 0\n");
  refused(head + "Vertices 1\n0 0 0 0\nTetrahedra 1\n1 1 1 2 0\n");
  refused(head + "Vertices 1\n0 0 0 0\nTetrahedra 1\n1 1 1 0 0\n");
  refused(head + "Vertices 1\n0 0 0 0\nTetrahedra -1\n");
}

TEST(ReadNetgen, CellsOfAllKinds) {
  const std::string head =
      "mesh3d\ndimension\n3\ngeomtype\n0\nsurfaceelements\n1\n1 1 1 0 3 1 2 3\n";
  // Netgen's order: mirror images of VTK's.
  const std::string cells =
      "volumeelements\n4\n1 4 1 4 2 5\n2 5 1 4 3 2 5\n2 6 1 4 2 5 8 6\n1 8 1 4 3 2 5 8 7 6\n";
  const std::string points =
      "points\n8\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\nendmesh\n";
  const MeshData mesh = read_netgen(write("a.vol", head + cells + points));
  EXPECT_NEAR(volume_of(mesh), 1.0 / 6 + 1.0 / 3 + 0.5 + 1, 1e-14);
  ASSERT_EQ(mesh.fields.size(), 1U);
  EXPECT_EQ(mesh.fields[0].values, (std::vector<double>{0, 1, 2, 2, 1}));
  const auto refused = [&](const std::string& content) {
    EXPECT_THROW(static_cast<void>(read_netgen(write("b.vol", content))), base::ReadError);
  };
  refused("nonsense");
  refused(head + cells);  // without points
  refused(head + "volumeelements\n1000000000\n");
  refused(head + "volumeelements\n1\n1 7 1 2 3 4 5 6 7\n" + points);
  refused(head + "volumeelements\n1\n1 4 1 2 3 0\n" + points);
  refused(head + "volumeelements\n1\n1 4 1 2 3\n" + points);
}

TEST(ReadNetgen, QuadraticTetrahedraKeepTheirEdges) {
  // The points on the edges 12 13 14 23 24 34 follow the corners.
  std::string points = "points\n10\n";
  const std::array<Eigen::Vector3d, 4> corners = {{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}}};
  const auto add = [&](const Eigen::Vector3d& p) {
    points += fmt::format("{} {} {}\n", p.x(), p.y(), p.z());
  };
  for (const auto& p : corners) add(p);
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) add((corners[i] + corners[j]) / 2);
  }
  const MeshData mesh = read_netgen(write(
      "q.vol", "mesh3d\nvolumeelements\n1\n1 10 1 2 3 4 5 6 7 8 9 10\n" + points + "endmesh\n"));
  ASSERT_EQ(mesh.types.at(0), CellType::quadratic_tetra);
  EXPECT_NEAR(volume_of(mesh), 1.0 / 6, 1e-15);
  constexpr std::array<std::array<std::size_t, 2>, 6> kEdges = {
      {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
  const auto at = [&](std::size_t k) { return mesh.points[mesh.cell(0)[k]]; };
  for (std::size_t e = 0; e < 6; ++e) {
    EXPECT_EQ(at(4 + e), (at(kEdges[e][0]) + at(kEdges[e][1])) / 2) << e;
  }
}

TEST(ReadGambit, CellsInRowsAndGroups) {
  const std::string head =
      "        CONTROL INFO 2.3.16\n** GAMBIT NEUTRAL FILE\nt\nPROGRAM: Gambit VERSION: 2.3.16\n\n"
      "     NUMNP     NELEM     NGRPS    NBSETS     NDFCD     NDFVL\n";
  const std::string points =
      "ENDOFSECTION\n   NODAL COORDINATES 2.3.16\n11 0 0 0\n12 1 0 0\n13 0 1 0\n14 1 1 0\n15 0 0 "
      "1\n16 1 0 1\n17 0 1 1\n18 1 1 1\nENDOFSECTION\n";
  const std::string cells =
      "      ELEMENTS/CELLS 2.3.16\n1 4 8 11 12 13 14 15 16 17\n 18\n2 5 6 11 12 13 15 16 17\n3 6 "
      "4 "
      "11 12 13 15\n4 7 5 11 12 13 14 15\nENDOFSECTION\n";
  const std::string groups =
      "       ELEMENT GROUP 2.3.16\nGROUP: 7 ELEMENTS: 3 MATERIAL: 2 NFLAGS: 1\nfluid\n0\n1 2\n3\n"
      "ENDOFSECTION\n       ELEMENT GROUP 2.3.16\nGROUP: 8 ELEMENTS: 1 MATERIAL: 2 NFLAGS: "
      "1\nsolid\n"
      "0\n4\nENDOFSECTION\n";
  const MeshData mesh =
      read_gambit(write("a.neu", head + "8 4 2 0 3 3\n" + points + cells + groups));
  EXPECT_NEAR(volume_of(mesh), 1 + 0.5 + 1.0 / 6 + 1.0 / 3, 1e-14);
  ASSERT_EQ(mesh.fields.size(), 1U);
  EXPECT_EQ(mesh.fields[0].values, (std::vector<double>{7, 7, 7, 8}));
  const auto refused = [&](const std::string& content) {
    EXPECT_THROW(static_cast<void>(read_gambit(write("b.neu", content))), base::ReadError);
  };
  refused("nonsense");
  refused(head + "8 5 2 0 3 3\n" + points + cells);
  refused(head + "9 4 2 0 3 3\n" + points + cells);
  refused(head + "8 4 2 0 3 3\n" + points);
  refused(head + "8000000000 4 2 0 3 3\n" + points);
  refused(head + "8 4 2 0 2 2\n" + points + cells);
  refused(head + "8 4 2 0 3 3\n" + points + cells +
          "ELEMENT GROUP\nGROUP: 7 ELEMENTS: 1 NFLAGS: 0\nf\n9\n");
}

const std::string kUcd =
    "# AVS UCD File\n5 2 1 2 0\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n1 1 pyr 5 1 2 3 4\n2 "
    "2 "
    "tet 1 2 4 5\n1 1\nT, K\n1 10\n2 20\n3 30\n4 40\n5 50\n2 1 1\np, Pa\nq, -\n1 1 2\n2 3 4\n";

TEST(ReadUcd, TextWithFields) {
  const std::string file = write("a.inp", kUcd);
  EXPECT_TRUE(is_ucd(file));
  const MeshData mesh = read_ucd(file);
  EXPECT_NEAR(volume_of(mesh), 1.0 / 3 + 1.0 / 6, 1e-15);
  ASSERT_EQ(mesh.fields.size(), 4U);
  EXPECT_EQ(mesh.fields[0].name, "Material Id");
  EXPECT_EQ(mesh.fields[1].name, "T");
  EXPECT_EQ(mesh.fields[1].values, (std::vector<double>{10, 20, 30, 40, 50}));
  EXPECT_EQ(mesh.fields[3].name, "q");
  EXPECT_EQ(mesh.fields[3].values, (std::vector<double>{2, 4}));
  expect_cuts_refused("a.inp", kUcd, kUcd.size() - 3, read_ucd);
}

TEST(ReadUcd, BinaryOfEitherByteOrder) {
  for (const bool swapped : {false, true}) {
    std::string bytes(1, '\x07');
    const auto put = [&](auto value) {
      auto raw = std::bit_cast<std::array<char, sizeof value>>(value);
      if (swapped) std::ranges::reverse(raw);
      bytes.append(raw.data(), raw.size());
    };
    for (const int n : {5, 1, 2, 0, 0, 5}) put(n);
    for (const int n : {1, 1, 5, 5}) put(n);
    for (const int n : {5, 1, 2, 3, 4}) put(n);
    for (const float x :
         {0.F, 1.F, 1.F, 0.F, 0.F, 0.F, 0.F, 1.F, 1.F, 0.F, 0.F, 0.F, 0.F, 0.F, 1.F})
      put(x);
    std::string names = "S.T.";
    names.resize(2048, '\0');
    bytes += names;
    for (const int n : {2, 1, 1}) put(n);
    for (const float x : {0.F, 0.F, 0.F, 0.F}) put(x);
    for (int i = 0; i < 10; ++i) put(static_cast<float>(i));
    for (const int n : {0, 0}) put(n);
    const MeshData mesh = read_ucd(write("b.inp", bytes));
    EXPECT_NEAR(volume_of(mesh), 1.0 / 3, 1e-15);
    ASSERT_EQ(mesh.fields.size(), 2U);
    EXPECT_EQ(mesh.fields[0].name, "S");
    EXPECT_EQ(mesh.fields[1].values, (std::vector<double>{5, 6, 7, 8, 9}));
    for (std::size_t size = 1; size < bytes.size(); size += 13) {
      EXPECT_THROW(static_cast<void>(read_ucd(write("c.inp", bytes.substr(0, size)))),
                   base::ReadError);
    }
  }
}

TEST(ReadAbaqus, ElementsOfAllKinds) {
  const std::string head =
      "** a remark\n*Heading\n some words\n*NODE, NSET=all\n10, 0\n20, 1.\n30, 1., 1.\n40, 0., "
      "1.\n50, 0., 0., "
      "1.\n60, 1., 0., 1.\n70, 1., 1., 1.\n80, 0., 1., 1.\n";
  const std::string cells =
      "*ELEMENT, TYPE=C3D8R, ELSET=a\n1, 10, 20, 30, 40,\n 50, 60, 70, 80\n*element, type = "
      "c3d4\n2, "
      "10, 20, 30, 50\n*ELEMENT, TYPE=C3D6\n3, 10, 20, 30, 50, 60, 70\n*ELEMENT,TYPE=XYZ9\n4, 10, "
      "20\n*ELEMENT, TYPE=S4R\n5, 10, 20, 30, 40\n";
  const std::string file = write("d.inp", head + cells + "*STEP\n*STATIC\n1., 2.\n*END STEP\n");
  EXPECT_FALSE(is_ucd(file));
  const MeshData mesh = read_abaqus(file);
  ASSERT_EQ(mesh.cell_count(), 4U);
  EXPECT_NEAR(volume_of(mesh), 1 + 1.0 / 6 + 0.5, 1e-14);
  ASSERT_EQ(mesh.notes.size(), 1U);
  EXPECT_NE(mesh.notes[0].find("XYZ9"), std::string::npos);
  const auto refused = [](const std::string& content) {
    EXPECT_THROW(static_cast<void>(read_abaqus(write("e.inp", content))), base::ReadError);
  };
  refused("nonsense");
  refused(head + "*ELEMENT, TYPE=C3D4\n1, 10, 20, 30\n");
  refused(head + "*ELEMENT, TYPE=C3D4\n1, 10, 20, 30, 99\n");
  refused(head + "*ELEMENT, TYPE=C3D4\n1, 10, 20, 30, x\n");
  refused(head + "*ELEMENT\n1, 10, 20, 30, 40\n");
  refused(head + "*INCLUDE, INPUT=x\n");
  refused("*PART\n*NODE\n1, 0\n*PART\n*NODE\n1, 0\n");
}

TEST(ReadPos, CornersOfTheSamePlaceAndValueAreOne) {
  const std::string text =
      "// a remark\nView \"T\" {\nTIME{0.5, 2};\n/* one */ SS(0,0,0,1,0,0,0,1,0,0,0,1){1,2,3,4, "
      "10,20,30,40};\nSS(1,1,1,0,1,0,1,0,0,0,0,1){5,3,2,4,50,30,21,40};\nT3(0,0,0,0){\"x\"};\n};\n";
  const std::string file = write("a.pos", text.substr(0, text.find("T3")) + "};\n");
  const MeshData first = read_pos(file, "index:0");
  EXPECT_EQ(first.points.size(), 5U);
  EXPECT_EQ(first.fields.at(0).values[1], 2);
  const MeshData last = read_pos(file, "last");
  EXPECT_EQ(last.points.size(), 6U) << "the values at one corner differ: no link there";
  EXPECT_EQ(last.fields[0].values[1], 20);
  EXPECT_EQ(last.fields[0].name, "T");
  EXPECT_NEAR(volume_of(first), 1.0 / 6 + 1.0 / 3, 1e-15);
  EXPECT_THROW(static_cast<void>(read_pos(write("b.pos", text), "")), base::ReadError);
  expect_cuts_refused("a.pos", tests::read_text(file), tests::read_text(file).size() - 2,
                      [](const std::string& cut) { return read_pos(cut, ""); });
}

TEST(ReadPos, DoesNotRunGmshsLanguage) {
  const std::string witness = folder().file("witness");
  EXPECT_THROW(static_cast<void>(read_pos(
                   write("c.pos", "SystemCall \"touch " + witness + "\";\nView \"\" {};\n"), "")),
               base::ReadError);
  EXPECT_FALSE(std::filesystem::exists(witness));
}

TEST(ReadPoints, OfLinesWithNamesAndValues) {
  const std::string file =
      write("a.xyz", "# a cloud\nx y z T\n0 0 0 1\n1 0 0 2\n0,1,0,3\n\n0 0 1 4\n");
  EXPECT_TRUE(is_point_list(file));
  const MeshData mesh = read_points(file);
  EXPECT_EQ(mesh.points.size(), 4U);
  ASSERT_EQ(mesh.fields.size(), 1U);
  EXPECT_EQ(mesh.fields[0].name, "T");
  EXPECT_EQ(mesh.fields[0].values, (std::vector<double>{1, 2, 3, 4}));
  EXPECT_FALSE(is_point_list(write("b.xyz", "1 2 3\n1 2\n")));
  EXPECT_FALSE(is_point_list(write("b.xyz", "1 2\n1 2\n")));
  EXPECT_FALSE(is_point_list(write("b.xyz", std::string("\0\0\0\1", 4))));
  EXPECT_THROW(static_cast<void>(read_points(write("b.pts", "1 2 3\n1 2 3 4\n"))), base::ReadError);
  EXPECT_THROW(static_cast<void>(read_points(write("b.pts", "1 2 3\nx y z\n"))), base::ReadError);
}

TEST(ReadPoints, GridsOfPlot3dAreNone) {
  std::string grid = "2 2 2\n";
  for (int i = 0; i < 8; ++i) grid += "0.5 1.5 2.5\n";
  EXPECT_FALSE(is_point_list(write("c.xyz", grid)));
  EXPECT_TRUE(is_point_list(write("c.xyz", grid + "0.5 1.5 2.5\n")));
}

TEST(ReadTetgen, Boundaries) {
  const std::string points = "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
  const std::string facets = "1 0\n3 1 3 2\n1 0\n3 1 2 4\n1 0\n3 2 3 4\n2 0\n3 1\n4 3\n2 1 4\n";
  const MeshData poly = read_tetgen(write("p.poly", points + "4 0\n" + facets + "0\n0\n"));
  EXPECT_EQ(poly.census().at(CellType::triangle), 4U);
  EXPECT_TRUE(poly.notes.empty()) << "the segment is an edge of its facet";
  write("s.node", points);
  const MeshData smesh = read_tetgen(
      write("s.smesh", "0 3 0 0\n4 0\n3 1 3 2\n3 1 2 4\n3 2 3 4\n3 1 4 3\n1\n1 .1 .1 .1\n0\n"));
  EXPECT_EQ(smesh.cell_count(), 4U);
  ASSERT_TRUE(smesh.marks.has_value());
  EXPECT_EQ(smesh.marks->holes, std::vector<Eigen::Vector3d>{Eigen::Vector3d(.1, .1, .1)});
  const MeshData face =
      read_tetgen(write("s.face", "4 1\n1 1 3 2 -1\n2 1 2 4 -1\n3 2 3 4 -1\n4 1 4 3 -1\n"));
  EXPECT_EQ(face.connectivity, smesh.connectivity);
  const auto refused = [&](const std::string& name, const std::string& content) {
    EXPECT_THROW(static_cast<void>(read_tetgen(write(name, content))), base::ReadError) << content;
  };
  refused("r.poly", points + "1 0\n1 1\n3 1 3 2\n");
  refused("r.poly", points + "1 0\n2 0\n3 1 3 2\n3 1 2 4\n");
  refused("r.poly", points + "1 0\n1 0\n3 1 3 9\n");
  refused("r.poly", points + "2 0\n1 0\n3 1 3 2\n");
  refused("r.face", "1 1\n1 1 3 2 -1\n");  // without r.node
}

TetMesh tetrahedron_at(double x, double value) {
  TetMesh mesh = tests::unit_tetrahedron([&](const auto&) { return value; });
  for (Eigen::Vector3d& p : mesh.points) p.x() += x;
  return mesh;
}

TEST(ReadCollection, StepsAndParts) {
  for (int i = 0; i < 4; ++i) {
    TetMesh mesh = tetrahedron_at(i % 2, i);
    if (i == 1) mesh.fields[0].name = "t";
    write_vtu(mesh, folder().file(fmt::format("part{}.vtu", i)));
  }
  const auto entry = [](double time, int part) {
    return fmt::format("<DataSet timestep=\"{}\" part=\"{}\" file=\"part{}.vtu\"/>\n", time,
                       part % 2, part);
  };
  const std::string head = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\">\n<Collection>\n";
  const std::string tail = "</Collection>\n</VTKFile>\n";
  const std::string file =
      write("a.pvd", head + entry(0.5, 0) + entry(0.5, 1) + entry(2, 2) + entry(2, 3) + tail);
  const MeshData last = read_collection(file, "last");
  ASSERT_EQ(last.cell_count(), 2U);
  EXPECT_EQ(last.cell(1)[0], 4U);
  EXPECT_EQ(last.points[4].x(), 1);
  EXPECT_EQ(last.fields.at(0).values, (std::vector<double>{2, 2, 2, 2, 3, 3, 3, 3}));
  EXPECT_EQ(last.fields.at(1).values, (std::vector<double>{0, 1}));
  const MeshData first = read_collection(file, "index:0");
  ASSERT_EQ(first.fields.size(), 3U);
  EXPECT_TRUE(std::isnan(first.fields[0].values[4]));
  EXPECT_EQ(first.fields[1].values[4], 1);
  EXPECT_EQ(read_collection(file, "1.9").fields[0].values[0], 2) << "the nearest step";
  EXPECT_THROW(static_cast<void>(read_collection(file, "index:2")), base::UsageError);
  const auto refused = [](const std::string& content) {
    EXPECT_THROW(static_cast<void>(read_collection(write("b.pvd", content), "")), base::ReadError);
  };
  refused("nonsense");
  refused(head + tail);
  refused(head + entry(0, 7) + tail);
  refused(head + entry(0, 0));
  refused(head + "<DataSet timestep=\"now\" file=\"part0.vtu\"/>" + tail);
  refused(head + "<DataSet timestep=\"0\" file=\"b.pvd\"/>" + tail);
  const std::string blocks =
      write("c.vtm",
            "<?xml version=\"1.0\"?>\n<VTKFile "
            "type=\"vtkMultiBlockDataSet\"><vtkMultiBlockDataSet><Block "
            "index=\"0\"><DataSet index=\"0\" file=\"part0.vtu\"/></Block><DataSet index=\"1\" "
            "file=\"part2.vtu\"/></vtkMultiBlockDataSet></VTKFile>\n");
  EXPECT_EQ(read_collection(blocks, "").cell_count(), 2U);
}

TEST(AppendMeshes, MovesTheIndicesOfPolyhedraToo) {
  MeshData tetrahedron;
  tetrahedron.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  tetrahedron.add_cell(CellType::polyhedron, std::vector<std::uint32_t>{4, 3, 0, 2, 1, 3, 0, 1, 3,
                                                                        3, 1, 2, 3, 3, 0, 3, 2});
  MeshData other = tetrahedron;
  for (auto& p : other.points) p.x() += 5;
  EXPECT_NEAR(volume_of(append_meshes({tetrahedron, other})), 1.0 / 3, 1e-14);
}

TEST(ReadEnsight, GoldWithTimeSteps) {
  const std::string geometry =
      "text\nfile\nnode id off\nelement id off\npart\n         1\nblock\ncoordinates\n         5\n"
      " 0.0\n 1.0\n 1.0\n 0.0\n 0.0\n 0.0\n 0.0\n 1.0\n 1.0\n 0.0\n 0.0\n 0.0\n 0.0\n 0.0\n 1.0\n"
      "pyramid5\n         1\n         1         2         3         4         5\n";
  write("e.geo", geometry);
  const auto scalar = [](double value) {
    std::string text = "T\npart\n         1\ncoordinates\n";
    for (int i = 0; i < 5; ++i) text += fmt::format("{:12.5e}\n", value + i);
    return text;
  };
  write("e0.scl", scalar(100));
  write("e1.scl", scalar(200));
  const std::string text =
      "FORMAT\ntype: ensight gold\nGEOMETRY\nmodel: e.geo\nVARIABLE\nscalar per node: 1 T "
      "e*.scl\nTIME\ntime set: 1\nnumber of steps: 2\nfilename start number: 0\nfilename "
      "increment: 1\ntime values: 0.5 1.5\n";
  const std::string file = write("e.case", text);
  const MeshData last = read_ensight(file, "");
  ASSERT_EQ(last.cell_count(), 1U);
  EXPECT_NEAR(volume_of(last), 1.0 / 3, 1e-7);
  ASSERT_EQ(last.fields.size(), 1U);
  EXPECT_EQ(last.fields[0].values[2], 202);
  EXPECT_EQ(read_ensight(file, "0.5").fields[0].values[2], 102);
  EXPECT_THROW(static_cast<void>(read_ensight(file, "index:9")), base::UsageError);
  EXPECT_THROW(static_cast<void>(read_ensight(write("f.case", "nonsense\n"), "")), base::Error);
  write("e.geo", geometry.substr(0, geometry.size() / 2));
  EXPECT_THROW(static_cast<void>(read_ensight(file, "")), base::Error);
}

TEST(ReadApart, CarriesMeshesAndErrorsAcross) {
  MeshData mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.add_cell(CellType::tetra, std::array<std::uint32_t, 4>{0, 1, 2, 3});
  mesh.fields.push_back({"f", Location::cell, 1, {std::numeric_limits<double>::quiet_NaN()}});
  mesh.notes.push_back("a note");
  const MeshData same = read_apart(
      "f", [&] { return mesh; }, 10);
  EXPECT_EQ(same.points, mesh.points);
  EXPECT_EQ(same.types, mesh.types);
  EXPECT_EQ(same.connectivity, mesh.connectivity);
  EXPECT_EQ(same.fields[0].name, "f");
  EXPECT_TRUE(std::isnan(same.fields[0].values[0]));
  EXPECT_EQ(same.notes, mesh.notes);
  const std::string bytes = to_bytes(mesh);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(static_cast<void>(from_bytes(bytes.substr(0, size))), base::InputError);
  }
  const auto message = [](const std::function<MeshData()>& read) -> std::string {
    try {
      static_cast<void>(read_apart("f", read, 1));
    } catch (const base::ReadError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message([]() -> MeshData { throw base::ReadError("f", "is bad"); }), "f: is bad");
  EXPECT_NE(message([]() -> MeshData { std::abort(); }).find("Aborted"), std::string::npos);
  EXPECT_NE(message([]() -> MeshData {
              while (true) {
                std::atomic_signal_fence(std::memory_order_seq_cst);
              }
            }).find("took more than 1 s"),
            std::string::npos);
}

#ifdef TETRAGLASS_WITH_GMSH

TEST(ReadGmsh, NastranAndIdeas) {
  const MeshData nastran = read_gmsh(
      write("a.bdf",
            "BEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\n"
            "CTETRA,1,1,1,2,3,4\nENDDATA\n"),
      "");
  EXPECT_NEAR(volume_of(nastran), 1.0 / 6, 1e-15);
  const std::string unv =
      "    -1\n  2411\n         1         1         1        11\n   0.0D+00   0.0D+00   0.0D+00\n"
      "         2         1         1        11\n   1.0D+00   0.0D+00   0.0D+00\n"
      "         3         1         1        11\n   0.0D+00   1.0D+00   0.0D+00\n"
      "         4         1         1        11\n   0.0D+00   0.0D+00   1.0D+00\n    -1\n    -1\n"
      "  2412\n         1       111         1         1         7         4\n"
      "         1         2         3         4\n    -1\n";
  EXPECT_NEAR(volume_of(read_gmsh(write("a.unv", unv), "")), 1.0 / 6, 1e-15);
  EXPECT_THROW(static_cast<void>(read_gmsh(write("A.Unv", unv), "")), base::ReadError);
}

TEST(ReadGmsh, DoesNotRunGmshsLanguage) {
  const std::string witness = folder().file("witness");
  for (const char* extension : {".bdf", ".nas", ".unv", ".Bdf"}) {
    try {
      static_cast<void>(read_gmsh(
          write(std::string("s") + extension, "SystemCall \"touch " + witness + "\";\n"), ""));
    } catch (const base::Error&) {
    }
    EXPECT_FALSE(std::filesystem::exists(witness)) << extension;
  }
}

#endif

}  // namespace
}  // namespace tetraglass::mesh
