#include "mesh/weld.h"

#include <array>
#include <limits>

#include <gtest/gtest.h>

#include "mesh/decompose.h"
#include "support/meshes.h"

namespace tetraglass::mesh {
namespace {

using Tetra = std::array<std::uint32_t, 4>;

/// Two tetrahedra on either side of the triangle 1 2 3, which have its points for themselves, the
/// second one's `shift` away.
MeshData two_tetrahedra(double shift) {
  MeshData data;
  data.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (std::size_t i = 1; i < 4; ++i) {
    data.points.emplace_back(data.points[i] + Eigen::Vector3d(shift, 0, 0));
  }
  data.points.emplace_back(1, 1, 1);
  data.add_cell(CellType::tetra, Tetra{0, 1, 2, 3});
  data.add_cell(CellType::tetra, Tetra{4, 5, 6, 7});
  data.fields = {{"p", Location::point, 1, {0, 1, 2, 3, 4, 5, 6, 7}},
                 {"c", Location::cell, 2, {10, 11, 20, 21}}};
  return data;
}

TEST(Weld, JoinsEqualPointsOnly) {
  MeshData data = two_tetrahedra(0);
  const Welding welding = weld(data, 0);
  EXPECT_EQ(welding.merged, 3U);
  EXPECT_EQ(welding.collapsed, 0U);
  ASSERT_EQ(data.points.size(), 5U);
  EXPECT_EQ(data.connectivity, (std::vector<std::uint32_t>{0, 1, 2, 3, 1, 2, 3, 4}));
  EXPECT_EQ(data.fields[0].values, (std::vector<double>{0, 1, 2, 3, 7}));
  EXPECT_EQ(data.fields[1].values, (std::vector<double>{10, 11, 20, 21}));
  MeshData apart = two_tetrahedra(1e-9);
  EXPECT_EQ(weld(apart, 0).merged, 0U);
  EXPECT_EQ(apart.points.size(), 8U);
}

TEST(Weld, JoinsPointsUpToTheDistance) {
  MeshData data = two_tetrahedra(1e-6);
  EXPECT_EQ(weld(data, 0.9e-6).merged, 0U);
  EXPECT_EQ(weld(data, 1.1e-6).merged, 3U);
  EXPECT_EQ(data.points[1].x(), 1);  // the first one stays
}

TEST(Weld, PlusAndMinusZeroAreEqual) {
  MeshData data;
  data.points = {{0.0, -0.0, 1}, {-0.0, 0.0, 1}};
  EXPECT_EQ(weld(data, 0).merged, 1U);
}

// A chain of points half as far apart as the distance: none moves farther than that.
TEST(Weld, NoPointMovesFartherThanTheDistance) {
  MeshData data;
  for (int i = 0; i < 100; ++i) data.points.emplace_back(-3 + 0.5 * i, 7, 0);
  const std::vector<Eigen::Vector3d> before = data.points;
  for (std::uint32_t i = 0; i < 100; ++i) {
    data.add_cell(CellType::vertex, std::array<std::uint32_t, 1>{i});
  }
  EXPECT_EQ(weld(data, 1).merged, 66U);  // of three in a row the first stays
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_LE((data.points[data.connectivity[i]] - before[i]).norm(), 1) << i;
  }
  for (std::size_t i = 1; i < data.points.size(); ++i) {
    EXPECT_GT((data.points[i] - data.points[i - 1]).norm(), 1) << i;
  }
}

TEST(Weld, LeavesOutCellsThatCollapse) {
  MeshData data = two_tetrahedra(0);
  data.points.emplace_back(0, 0, 1e-9);  // 8, near to 0
  data.add_cell(CellType::tetra, Tetra{0, 8, 2, 7});
  data.add_cell(CellType::triangle, std::array<std::uint32_t, 3>{0, 8, 2});
  data.fields.clear();
  data.fields.push_back({"c", Location::cell, 1, {1, 2, 3, 4}});
  const Welding welding = weld(data, 1e-8);
  EXPECT_EQ(welding.merged, 4U);
  EXPECT_EQ(welding.collapsed, 2U);
  EXPECT_EQ(data.cell_count(), 2U);
  EXPECT_EQ(data.fields[0].values, (std::vector<double>{1, 2}));
}

// A cube of two boxes that do not share the points between them.
TEST(Weld, PolyhedraAndHexahedraKeepTheirVolume) {
  MeshData data;
  for (int box = 0; box < 2; ++box) {
    for (int i = 0; i < 8; ++i) {
      data.points.emplace_back(box + (i & 1), i >> 1 & 1, i >> 2 & 1);
    }
  }
  data.add_cell(CellType::hexahedron, std::array<std::uint32_t, 8>{0, 1, 3, 2, 4, 5, 7, 6});
  data.add_cell(
      CellType::polyhedron,
      std::array<std::uint32_t, 31>{6, 4,  8,  10, 11, 9, 4, 12, 13, 15, 14, 4, 8,  9,  13, 12,
                                    4, 10, 14, 15, 11, 4, 8, 12, 14, 10, 4,  9, 11, 15, 13});
  EXPECT_EQ(weld(data, 0).merged, 4U);
  EXPECT_EQ(data.points.size(), 12U);
  const Decomposition split = decompose(data);
  double volume = 0;
  for (const Cell& cell : split.mesh.cells) volume += tests::volume(split.mesh, cell);
  EXPECT_NEAR(volume, 2, 1e-14);
  EXPECT_EQ(split.mesh.points.size(), 13U);  // and the polyhedron's centre
}

TEST(Weld, KeepsPointsThatAreNotFinite) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  MeshData data;
  data.points = {{kNan, 0, 0}, {kNan, 0, 0}, {1e300, 0, 0}, {1e300, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(weld(data, 1).merged, 1U);
  EXPECT_EQ(data.points.size(), 4U);
}

TEST(UnusedPoints, AreCounted) {
  MeshData data = two_tetrahedra(0);
  EXPECT_EQ(unused_points(data), 0U);
  data.points.emplace_back(9, 9, 9);
  EXPECT_EQ(unused_points(data), 1U);
}

}  // namespace
}  // namespace tetraglass::mesh
