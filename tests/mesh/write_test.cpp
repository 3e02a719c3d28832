#include "mesh/write.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "mesh/import.h"
#include "support/meshes.h"
#include "support/temporary_folder.h"

namespace tetraglass::mesh {
namespace {

TetMesh sample() {
  TetMesh mesh = tests::box({0, 0, 0}, {1, 2, 3}, 2, 3, 4, [](const auto& p) { return p.x() / 3; });
  Field vector{"vector of 3", Location::cell, 3, {}};
  for (std::size_t i = 0; i < 3 * mesh.cells.size(); ++i) {
    vector.values.push_back(1.0 / static_cast<double>(i + 1));
  }
  mesh.fields.push_back(vector);
  return mesh;
}

TEST(WriteVtu, IsReadBackBitForBit) {
  const tests::TemporaryFolder folder;
  const TetMesh mesh = sample();
  write_vtu(mesh, folder.file("a.vtu"));
  const TetMesh back = import_mesh(folder.file("a.vtu")).mesh;
  EXPECT_EQ(back.points, mesh.points);
  EXPECT_EQ(back.cells, mesh.cells);
  ASSERT_EQ(back.fields.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back.fields[i].name, mesh.fields[i].name);
    EXPECT_EQ(back.fields[i].components, mesh.fields[i].components);
    EXPECT_EQ(back.fields[i].location, mesh.fields[i].location);
    EXPECT_EQ(back.fields[i].values, mesh.fields[i].values);
  }
}

TEST(WriteVtu, LeavesNothingBehindWhereItFails) {
  const tests::TemporaryFolder folder;
  EXPECT_THROW(write_vtu(sample(), folder.file("a.vtk")), base::WriteError);
  EXPECT_THROW(write_vtu(sample(), folder.file("none/a.vtu")), base::WriteError);
  EXPECT_TRUE(folder.is_empty());
}

TEST(WriteVtu, ReplacesAFileWhole) {
  const tests::TemporaryFolder folder;
  write_vtu(sample(), folder.file("a.vtu"));
  write_vtu(tests::unit_tetrahedron(), folder.file("a.vtu"));
  EXPECT_EQ(import_mesh(folder.file("a.vtu")).mesh.cells.size(), 1U);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.file(""))) {
    files += entry.is_regular_file() ? 1 : 0;
  }
  EXPECT_EQ(files, 1U);
}

}  // namespace
}  // namespace tetraglass::mesh
