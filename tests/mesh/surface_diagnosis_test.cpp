#include "mesh/surface_diagnosis.h"

#include <array>
#include <string>

#include <gtest/gtest.h>

#include "support/meshes.h"

namespace tetraglass::mesh {
namespace {

TriangleSurface collected(const MeshData& data) {
  std::vector<std::string> notes;
  return collect_triangles(data, notes);
}

TEST(SurfaceDiagnosis, FindsNothingOnACube) {
  MeshData data;
  tests::add_cube(data, {0, 0, 0}, 1);
  const SurfaceDiagnosis found = diagnose(collected(data));
  EXPECT_EQ(found.parts, 1U);
  EXPECT_EQ(found.edges, 18U);
  EXPECT_EQ(found.open_edges, 0U);
  EXPECT_EQ(found.crowded_edges, 0U);
  EXPECT_EQ(found.disagreeing_edges, 0U);
  EXPECT_EQ(found.faults.flat, 0U);
  EXPECT_EQ(found.faults.crossings, 0U);
}

TEST(SurfaceDiagnosis, SaysWhereTheSurfaceIsOpenAndHowManyPartsItHas) {
  MeshData data;
  tests::add_cube(data, {0, 0, 0}, 1);
  tests::add_cube(data, {5, 0, 0}, 1);
  data.points[15] = {6, 1, 2};
  data.types.pop_back();  // the square of the points 9, 11, 15, 13
  data.offsets.pop_back();
  data.connectivity.resize(data.offsets.back());
  const TriangleSurface surface = collected(data);
  const SurfaceDiagnosis found = diagnose(surface);
  EXPECT_EQ(found.parts, 2U);
  EXPECT_EQ(found.open_edges, 4U);
  const std::string text = describe(surface, found);
  EXPECT_NE(text.find("4 of its 35 edges"), std::string::npos) << text;
  EXPECT_NE(text.find("9 (6, 0, 0) - 11 (6, 1, 0)"), std::string::npos) << text;
  EXPECT_NE(text.find("22 triangles in 2 parts"), std::string::npos) << text;
}

TEST(SurfaceDiagnosis, PointsAndCellsAreNumberedAsInTheData) {
  MeshData data;
  data.points = {{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}};
  data.add_cell(CellType::line, std::array<std::uint32_t, 2>{0, 1});
  data.add_cell(CellType::triangle, std::array<std::uint32_t, 3>{1, 2, 3});
  data.add_cell(CellType::triangle, std::array<std::uint32_t, 3>{3, 4, 5});
  const TriangleSurface surface = collected(data);
  EXPECT_EQ(surface.sources, (std::vector<std::uint32_t>{1, 2, 3, 5}));
  EXPECT_EQ(surface.cells, (std::vector<std::uint32_t>{1, 2}));
}

TEST(SurfaceDiagnosis, CountsEdgesOfMoreThanTwoTrianglesAndOfOppositeDirections) {
  MeshData data;
  data.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, -1}};
  data.add_cell(CellType::triangle, std::array<std::uint32_t, 3>{0, 1, 2});
  data.add_cell(CellType::triangle, std::array<std::uint32_t, 3>{0, 1, 3});
  EXPECT_EQ(diagnose(collected(data)).disagreeing_edges, 1U);
  EXPECT_EQ(diagnose(collected(data)).crowded_edges, 0U);
  data.add_cell(CellType::triangle, std::array<std::uint32_t, 3>{0, 1, 4});
  const SurfaceDiagnosis found = diagnose(collected(data));
  EXPECT_EQ(found.crowded_edges, 1U);
  EXPECT_EQ(found.open_edges, 6U);
  EXPECT_EQ(found.parts, 1U);
}

TEST(SurfaceDiagnosis, NamesTrianglesThatIntersectOrHaveNoArea) {
  MeshData data;
  tests::add_cube(data, {0, 0, 0}, 2);
  const auto first = static_cast<std::uint32_t>(data.points.size());
  data.points.insert(data.points.end(), {{.5, .6, -1}, {.5, .6, 1}, {.5, .7, 1}, {.5, .8, 1}});
  data.add_cell(CellType::triangle, std::array{first, first + 1, first + 2});
  data.add_cell(CellType::triangle, std::array{first + 1, first + 2, first + 3});
  const TriangleSurface surface = collected(data);
  const SurfaceDiagnosis found = diagnose(surface);
  EXPECT_EQ(found.faults.crossings, 1U);
  ASSERT_EQ(found.faults.first_crossings.size(), 1U);
  const auto [one, other] = found.faults.first_crossings[0];
  EXPECT_EQ(surface.cells[one], 0U);  // the square z = 0
  EXPECT_EQ(surface.cells[other], 6U);
  EXPECT_EQ(found.faults.flat, 1U);
  const std::string text = describe(surface, found);
  EXPECT_NE(text.find("1 pairs of triangles, the cells 0 with 6"), std::string::npos) << text;
  EXPECT_NE(text.find("1 triangles have no area, cell 7 at point 9"), std::string::npos) << text;
}

}  // namespace
}  // namespace tetraglass::mesh
