#include "mesh/read_tetgen.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "mesh/import.h"
#include "support/meshes.h"
#include "support/temporary_folder.h"
#include "support/total_volume.h"

namespace tetraglass::mesh {
namespace {

TEST(ReadTetgen, ReadsPointsAndTetrahedraFromEitherName) {
  const tests::TemporaryFolder folder;
  tests::write_text(
      folder.file("a.node"),
      "# by hand\n4 3 2 1\n1 0 0 0 5 50 0\n2 1 0 0 6 60 0\n3 0 1 0 7 70 1\n4 0 0 1 8 80 1\n");
  tests::write_text(folder.file("a.ele"), "1 4 1\n1 1 2 3 4 17\n");
  for (const char* name : {"a.node", "a.ele"}) {
    const MeshData mesh = read_tetgen(folder.file(name));
    ASSERT_EQ(mesh.cell_count(), 1U);
    EXPECT_EQ(mesh.cell(0)[3], 3U);
    ASSERT_EQ(mesh.fields.size(), 3U);
    EXPECT_EQ(mesh.fields[1].name, "attribute 1");
    EXPECT_EQ(mesh.fields[1].values, (std::vector<double>{50, 60, 70, 80}));
    EXPECT_EQ(mesh.fields[2].name, "region");
    EXPECT_EQ(mesh.fields[2].values, (std::vector<double>{17}));
  }
}

TEST(ReadTetgen, PutsEdgePointsInTheOrderOfVtk) {
  const tests::TemporaryFolder folder;
  // TetGen's order: edges 2-3, 3-0, 0-1, 1-2, 1-3, 0-2.
  tests::write_text(folder.file("a.node"),
                    "10 3\n0 0 0 0\n1 2 0 0\n2 0 2 0\n3 0 0 2\n4 0 1 1\n5 0 0 1\n6 1 0 0\n7 1 1 0\n"
                    "8 1 0 1\n9 0 1 0\n");
  tests::write_text(folder.file("a.ele"), "1 10\n0 0 1 2 3 4 5 6 7 8 9\n");
  const MeshData mesh = read_tetgen(folder.file("a.ele"));
  ASSERT_EQ(mesh.types[0], CellType::quadratic_tetra);
  constexpr std::array<std::array<std::size_t, 2>, 6> kEdges = {
      {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};
  const auto at = [&](std::size_t i) { return mesh.points[mesh.cell(0)[i]]; };
  for (std::size_t e = 0; e < 6; ++e) {
    EXPECT_EQ(at(4 + e), (at(kEdges[e][0]) + at(kEdges[e][1])) / 2) << e;
  }
}

TEST(ReadTetgen, RefusesDamagedFiles) {
  const tests::TemporaryFolder folder;
  const auto fails = [&](const std::string& nodes, const std::string& elements) {
    tests::write_text(folder.file("a.node"), nodes);
    tests::write_text(folder.file("a.ele"), elements);
    EXPECT_THROW(static_cast<void>(read_tetgen(folder.file("a.node"))), base::ReadError)
        << nodes << elements;
  };
  const std::string nodes = "4 3\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n";
  fails("4 3\n0 0 0 0\n1 1 0 0\n2 0 1 0\n", "1 4\n0 0 1 2 3\n");
  fails("99999999999 3\n", "1 4\n0 0 1 2 3\n");
  fails("4 2\n0 0 0\n1 1 0\n2 0 1\n3 0 0\n", "1 4\n0 0 1 2 3\n");
  fails("4 3\n0 0 0 0\n2 1 0 0\n1 0 1 0\n3 0 0 1\n", "1 4\n0 0 1 2 3\n");
  fails(nodes, "1 4\n0 0 1 2 4\n");
  fails(nodes, "1 4\n0 0 1 2 -1\n");
  fails(nodes, "2 4\n0 0 1 2 3\n");
  fails(nodes, "1 5\n0 0 1 2 3 0\n");
  fails(nodes, "88888888888 4\n0 0 1 2 3\n");
}

TEST(ReadTetgen, TellsThatThePointsAreMissing) {
  const tests::TemporaryFolder folder;
  tests::write_text(folder.file("a.ele"), "1 4\n0 0 1 2 3\n");
  EXPECT_THROW(static_cast<void>(read_tetgen(folder.file("a.ele"))), base::ReadError);
}

#if defined(TETRAGLASS_WITH_CGAL) && defined(TETRAGLASS_WITH_TETGEN)

const std::string kOuterBox =
    "1 0 0 0\n2 3 0 0\n3 3 3 0\n4 0 3 0\n5 0 0 1\n6 3 0 1\n7 3 3 1\n8 0 3 1\n";
const std::string kInnerBox =
    "9 1 1 0\n10 2 1 0\n11 2 2 0\n12 1 2 0\n13 1 1 1\n14 2 1 1\n15 2 2 1\n16 1 2 1\n";
const std::string kOuterWalls = "1\n4 1 2 6 5\n1\n4 2 3 7 6\n1\n4 3 4 8 7\n1\n4 4 1 5 8\n";
const std::string kInnerWalls =
    "1\n4 9 10 14 13\n1\n4 10 11 15 14\n1\n4 11 12 16 15\n1\n4 12 9 13 16\n";

double volume_of(const std::string& content, std::vector<double>* regions = nullptr) {
  const tests::TemporaryFolder folder;
  tests::write_text(folder.file("a.poly"), content);
  ImportOptions options;
  options.fill.cells = 200;
  const Import import = import_mesh(folder.file("a.poly"), options);
  for (const Field& field : import.mesh.fields) {
    if (field.name != "region" || regions == nullptr) continue;
    *regions = field.values;
    std::ranges::sort(*regions);
    regions->erase(std::unique(regions->begin(), regions->end()), regions->end());
  }
  return tests::total_volume(import.mesh);
}

TEST(ReadTetgen, FacetsWithHolesMakeATunnel) {
  const std::string content = "16 3\n" + kOuterBox + kInnerBox +
                              "10 0\n"
                              "2 1\n4 1 2 3 4\n4 9 10 11 12\n1 1.5 1.5 0\n"
                              "2 1\n4 5 6 7 8\n4 13 14\n15 16\n1 1.5 1.5 1\n" +
                              kOuterWalls + kInnerWalls;
  EXPECT_NEAR(volume_of(content + "0\n"), 8, 1e-9);
  std::vector<double> regions;
  EXPECT_NEAR(volume_of(content + "0\n1\n1 0.5 0.5 0.5 42 -1\n", &regions), 8, 1e-9);
  EXPECT_EQ(regions, std::vector<double>{42});
}

TEST(ReadTetgen, PolygonsWithinFacetsPartRegions) {
  // The column in the middle is walled off: solid with a name of its own, or a hole.
  const std::string content = "16 3\n" + kOuterBox + kInnerBox +
                              "10 0\n2 0\n4 1 2 3 4\n4 9 10 11 12\n"
                              "2 0\n4 5 6 7 8\n4 13 14 15 16\n" +
                              kOuterWalls + kInnerWalls;
  std::vector<double> regions;
  EXPECT_NEAR(volume_of(content + "0\n", &regions), 9, 1e-9);
  EXPECT_EQ(regions, (std::vector<double>{1, 2}));
  EXPECT_NEAR(volume_of(content + "1\n1 1.5 1.5 0.5\n"), 8, 1e-9);
  EXPECT_NEAR(volume_of(content + "0\n2\n1 1.5 1.5 0.5 7 0\n2 0.5 0.5 0.5 -3 0\n", &regions), 9,
              1e-9);
  EXPECT_EQ(regions, (std::vector<double>{-3, 7}));
}

TEST(ReadTetgen, ShellsWithinAreSolidUnlessTheyAreHoles) {
  std::string inner = kInnerBox;  // lifted off the outer faces
  for (std::size_t at = 0; (at = inner.find(" 0\n", at)) != std::string::npos;) {
    inner.replace(at, 3, " .3\n");
  }
  for (std::size_t at = 0; (at = inner.find(" 1\n", at)) != std::string::npos;) {
    inner.replace(at, 3, " .7\n");
  }
  const std::string content = "16 3\n" + kOuterBox + inner +
                              "12\n1\n4 1 2 3 4\n1\n4 5 6 7 8\n1\n4 9 10 11 12\n1\n4 13 14 15 "
                              "16\n" +
                              kOuterWalls + kInnerWalls;
  EXPECT_NEAR(volume_of(content), 9, 1e-9);
  EXPECT_NEAR(volume_of(content + "1\n1 1.5 1.5 0.5\n"), 8.6, 1e-9);
}

#endif

#ifdef TETRAGLASS_WITH_CGAL

TEST(ReadTetgen, FacetsThatCrossThemselvesAreRefused) {
  const tests::TemporaryFolder folder;
  const auto fails = [&](const std::string& facet) {
    tests::write_text(folder.file("a.poly"),
                      "8 3\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 2 0 "
                      "0\n6 3 0 0\n7 nan 0 0\n8 .5 0 0\n1 0\n" +
                          facet);
    EXPECT_THROW(static_cast<void>(read_tetgen(folder.file("a.poly"))), base::ReadError) << facet;
  };
  fails("1\n4 1 3 2 4\n");              // a bow
  fails("2\n4 1 2 3 4\n2 2 4\n2 1 3");  // ends early
  fails("3\n4 1 2 3 4\n2 2 4\n2 1 3\n");
  fails("1\n4 1 2 5 6\n");  // on a line
  fails("1\n4 1 2 7 4\n");
  fails("1 1\n4 1 2 3 4\n1 .5 .5 0\n");  // all of it is a hole
}

#endif

}  // namespace
}  // namespace tetraglass::mesh
