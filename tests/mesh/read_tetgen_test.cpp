#include "mesh/read_tetgen.h"

#include <array>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "support/temporary_folder.h"

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

}  // namespace
}  // namespace tetraglass::mesh
