#include "mesh/read_exodus.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "mesh/decompose.h"
#include "mesh/netcdf_size.h"
#include "support/data.h"
#include "support/meshes.h"
#include "support/temporary_folder.h"

namespace tetraglass::mesh {
namespace {

std::string data_file(const char* name) {
  return (tests::data_folder() / name).string();
}

const Field& field(const MeshData& mesh, const std::string& name) {
  const auto found = std::ranges::find(mesh.fields, name, &Field::name);
  EXPECT_NE(found, mesh.fields.end()) << name;
  return *found;
}

TEST(ReadExodus, JoinsComponentsToVectors) {
  SKIP_WITHOUT_DATA();
  const MeshData mesh = read_exodus(data_file("mixed/disk_out_ref.ex2"), "");
  EXPECT_EQ(mesh.points.size(), 8499U);
  EXPECT_EQ(mesh.census().at(CellType::hexahedron), 7472U);
  const Field& velocity = field(mesh, "V");
  EXPECT_EQ(velocity.components, 3);
  const Field& temperature = field(mesh, "Temp");
  EXPECT_NEAR(*std::ranges::min_element(temperature.values), 293.15, 1e-4);
  EXPECT_NEAR(*std::ranges::max_element(temperature.values), 913.15, 1e-4);
}

TEST(ReadExodus, MergesBlocksOfAllShapes) {
  SKIP_WITHOUT_DATA();
  const MeshData mesh = read_exodus(data_file("mixed/simple-cube-multi-element-order1.e"), "");
  const auto census = mesh.census();
  EXPECT_EQ(census.at(CellType::hexahedron), 27U);
  EXPECT_EQ(census.at(CellType::tetra), 295U);
  EXPECT_EQ(census.at(CellType::wedge), 250U);
  EXPECT_EQ(census.at(CellType::pyramid), 750U);
  EXPECT_EQ(field(mesh, "block").values.size(), mesh.cell_count());
  const Decomposition split = decompose(mesh);  // four cubes of side 1
  EXPECT_EQ(split.inverted, 0U);
  double volume = 0;
  for (const Cell& cell : split.mesh.cells) volume += tests::volume(split.mesh, cell);
  EXPECT_NEAR(volume, 4, 1e-12);
}

/// The middle of each edge, as VTK numbers them after the corners.
void expect_edges(const MeshData& mesh, std::size_t cell,
                  const std::vector<std::array<int, 2>>& edges, std::size_t corners) {
  const auto at = [&](std::size_t i) { return mesh.points[mesh.cell(cell)[i]]; };
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const Eigen::Vector3d middle =
        (at(static_cast<std::size_t>(edges[e][0])) + at(static_cast<std::size_t>(edges[e][1]))) / 2;
    EXPECT_LT((at(corners + e) - middle).norm(), 1e-12) << "edge " << e;
  }
}

TEST(ReadExodus, PutsNodesInTheOrderOfVtk) {
  SKIP_WITHOUT_DATA();
  const MeshData mesh = read_exodus(data_file("mixed/simple-cube-multi-element-order2.e"), "");
  const auto hexahedron = static_cast<std::size_t>(
      std::ranges::find(mesh.types, CellType::triquadratic_hexahedron) - mesh.types.begin());
  const auto tetrahedron = static_cast<std::size_t>(
      std::ranges::find(mesh.types, CellType::quadratic_tetra) - mesh.types.begin());
  ASSERT_LT(hexahedron, mesh.cell_count());
  ASSERT_LT(tetrahedron, mesh.cell_count());
  expect_edges(mesh, hexahedron,
               {{0, 1},
                {1, 2},
                {2, 3},
                {3, 0},
                {4, 5},
                {5, 6},
                {6, 7},
                {7, 4},
                {0, 4},
                {1, 5},
                {2, 6},
                {3, 7}},
               8);
  // The faces -x +x -y +y -z +z, by opposite corners, and the middle.
  expect_edges(mesh, hexahedron, {{0, 7}, {1, 6}, {0, 5}, {3, 6}, {0, 2}, {4, 6}, {0, 6}}, 20);
  expect_edges(mesh, tetrahedron, {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}, 4);
}

TEST(ReadExodus, TakesTheFirstNodesOfShapesThatAreNotKnown) {
  SKIP_WITHOUT_DATA();
  const MeshData mesh = read_exodus(data_file("torture/read_exodus_TET14.e"), "");
  EXPECT_EQ(mesh.census().at(CellType::quadratic_tetra), 192U);
  for (std::size_t i = 0; i < mesh.cell_count(); ++i) {
    const auto cell = mesh.cell(i);
    const Eigen::Vector3d middle = (mesh.points[cell[2]] + mesh.points[cell[3]]) / 2;
    EXPECT_TRUE(mesh.points[cell[9]].isApprox(middle, 1e-12)) << i;
  }
  double volume = 0;
  const Decomposition split = decompose(mesh);
  for (const Cell& cell : split.mesh.cells) volume += tests::volume(split.mesh, cell);
  EXPECT_NEAR(volume, 64, 1e-10);  // a cube of side 4, drawn by the right corners
}

TEST(ReadExodus, TakesTheTimeStepAndMarksWhatABlockLacks) {
  SKIP_WITHOUT_DATA();
  const std::string file = data_file("torture/edgeFaceElem.exii");
  const MeshData last = read_exodus(file, "");
  const MeshData first = read_exodus(file, "index:0");
  EXPECT_NE(field(last, "RHO").values, field(first, "RHO").values);
  EXPECT_EQ(field(last, "RHO").values, field(read_exodus(file, "index:1"), "RHO").values);
  const Field& strain = field(first, "EPSTRN");
  EXPECT_EQ(std::ranges::count_if(strain.values, [](double x) { return std::isnan(x); }), 1);
  EXPECT_THROW(static_cast<void>(read_exodus(file, "index:2")), base::UsageError);
  EXPECT_THROW(static_cast<void>(read_exodus(file, "soon")), base::UsageError);
}

TEST(ReadExodus, FilesThatAreCutOffAreErrorsAndNothingIsPrinted) {
  SKIP_WITHOUT_DATA();
  const tests::TemporaryFolder folder;
  testing::internal::CaptureStderr();
  for (const char* name : {"torture/box-noglom.ex2", "torture/edgeFaceElem.exii"}) {
    const std::string whole = tests::read_text(data_file(name));
    for (std::size_t size = 1; size < whole.size() - 4; size += 41) {
      tests::write_text(folder.file("a.e"), whole.substr(0, size));
      EXPECT_THROW(static_cast<void>(read_exodus(folder.file("a.e"), "")), base::ReadError) << size;
    }
  }
  tests::write_text(folder.file("a.e"), "this is no netCDF file");
  EXPECT_THROW(static_cast<void>(read_exodus(folder.file("a.e"), "")), base::ReadError);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(NetcdfSize, IsThatOfRealFiles) {
  SKIP_WITHOUT_DATA();
  std::size_t files = 0;
  for (const char* name : {"mixed/disk_out_ref.ex2", "mixed/simple-cube-multi-element-order1.e",
                           "torture/edgeFaceElem.exii", "torture/box-noglom.ex2",
                           "torture/read_exodus_TET10.e", "torture/bad_64bit_elem_integers.e"}) {
    const auto size = netcdf_size(data_file(name));
    ASSERT_TRUE(size) << name;
    // There may be padding at the end.
    EXPECT_LE(*size, std::filesystem::file_size(data_file(name))) << name;
    EXPECT_GT(*size + 8, std::filesystem::file_size(data_file(name))) << name;
    ++files;
  }
  EXPECT_EQ(files, 6U);
  EXPECT_FALSE(netcdf_size(data_file("tets/octahedron.node")));
}

}  // namespace
}  // namespace tetraglass::mesh
