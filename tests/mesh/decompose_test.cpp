#include "mesh/decompose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "mesh/adjacency.h"
#include "support/meshes.h"
#include "support/total_volume.h"

namespace tetraglass::mesh {
namespace {

using Eigen::Vector3d;

using tests::total_volume;

/// One cell of the given shape in its usual place, with a known volume.
struct Sample {
  CellType type;
  std::vector<Vector3d> points;
  double volume;
  std::size_t fewest, most;  // parts
};

std::vector<Vector3d> prism_points(int sides) {
  std::vector<Vector3d> points;
  for (int level = 0; level < 2; ++level) {
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * std::acos(-1.0) * i / sides;
      points.emplace_back(std::cos(angle), std::sin(angle), level);
    }
  }
  return points;
}

double prism_volume(int sides) {
  return sides * std::sin(2 * std::acos(-1.0) / sides) / 2;
}

std::vector<Sample> samples() {
  const std::vector<Vector3d> cube = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                      {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  const std::vector<Vector3d> voxel = {cube[0], cube[1], cube[3], cube[2],
                                       cube[4], cube[5], cube[7], cube[6]};
  // VTK's wedge has its first triangle counter-clockwise from outside.
  const std::vector<Vector3d> wedge = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1},
                                       {0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  return {
      {CellType::tetra, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 1.0 / 6, 1, 1},
      {CellType::hexahedron, cube, 1, 5, 6},
      {CellType::voxel, voxel, 1, 5, 6},
      {CellType::wedge, wedge, 0.5, 3, 3},
      {CellType::pyramid,
       {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}},
       1.0 / 3,
       2,
       2},
      {CellType::pentagonal_prism, prism_points(5), prism_volume(5), 16, 16},
      {CellType::hexagonal_prism, prism_points(6), prism_volume(6), 20, 20},
  };
}

/// The sample with its points numbered in another order.
MeshData renumbered(const Sample& sample, std::mt19937& random) {
  std::vector<std::uint32_t> number(sample.points.size());
  std::iota(number.begin(), number.end(), 0U);
  std::ranges::shuffle(number, random);
  MeshData data;
  data.points.resize(sample.points.size());
  for (std::size_t i = 0; i < number.size(); ++i) data.points[number[i]] = sample.points[i];
  data.add_cell(sample.type, number);
  return data;
}

TEST(Decompose, KeepsTheVolumeHoweverPointsAreNumbered) {
  std::mt19937 random(1);
  for (const Sample& sample : samples()) {
    for (int trial = 0; trial < 200; ++trial) {
      const Decomposition split = decompose(renumbered(sample, random));
      SCOPED_TRACE(to_string(sample.type));
      ASSERT_GE(split.mesh.cells.size(), sample.fewest);
      ASSERT_LE(split.mesh.cells.size(), sample.most);
      ASSERT_NEAR(total_volume(split.mesh), sample.volume, 1e-14);
      ASSERT_EQ(split.inverted, 0U);
      ASSERT_EQ(face_adjacency(split.mesh).crowded_faces, 0U);
      for (const Cell& cell : split.mesh.cells) ASSERT_GT(tests::volume(split.mesh, cell), 0);
    }
  }
}

TEST(Decompose, MirroredCellsAreTurnedAndCounted) {
  std::mt19937 random(2);
  for (const Sample& sample : samples()) {
    Sample mirrored = sample;
    for (Vector3d& p : mirrored.points) p.x() = -p.x();
    const Decomposition split = decompose(renumbered(mirrored, random));
    SCOPED_TRACE(to_string(sample.type));
    const bool starred = sample.most > 6;  // these have no direction that files agree on
    EXPECT_EQ(split.inverted, starred ? 0U : split.mesh.cells.size());
    EXPECT_NEAR(total_volume(split.mesh), sample.volume, 1e-14);
  }
}

TEST(Decompose, HexahedraGiveFiveWhereDiagonalsAllow) {
  // The smallest corner is 0; 2, 5 and 7 are smaller than the other corners of their faces.
  const std::array<std::uint32_t, 8> number = {0, 4, 1, 5, 6, 2, 7, 3};
  const Sample cube = samples()[1];
  MeshData data;
  data.points.resize(8);
  for (std::size_t i = 0; i < 8; ++i) data.points[number[i]] = cube.points[i];
  data.add_cell(CellType::hexahedron, number);
  EXPECT_EQ(decompose(data).mesh.cells.size(), 5U);
}

/// A block of cells of four types that meet in triangles and quadrilaterals: 3 x 3 x 3 bricks, each
/// a hexahedron, two wedges, or six pyramids around a point, with random numbers for the points.
MeshData mixed_block(std::mt19937& random) {
  constexpr std::uint32_t kN = 4;
  MeshData data;
  std::vector<Vector3d> points;
  for (std::uint32_t k = 0; k < kN; ++k) {
    for (std::uint32_t j = 0; j < kN; ++j) {
      for (std::uint32_t i = 0; i < kN; ++i) points.emplace_back(i, j, k);
    }
  }
  const std::size_t corners = points.size();
  std::vector<std::pair<CellType, std::vector<std::uint32_t>>> cells;
  for (std::uint32_t k = 0; k + 1 < kN; ++k) {
    for (std::uint32_t j = 0; j + 1 < kN; ++j) {
      for (std::uint32_t i = 0; i + 1 < kN; ++i) {
        const auto at = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
          return ((k + z) * kN + j + y) * kN + i + x;
        };
        const std::array<std::uint32_t, 8> v = {at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0),
                                                at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)};
        // Wedges fill the middle row along z, so that their triangles meet each other or the
        // border.
        if (i == 1 && j == 1) {
          cells.push_back({CellType::wedge, {v[4], v[5], v[7], v[0], v[1], v[3]}});
          cells.push_back({CellType::wedge, {v[5], v[6], v[7], v[1], v[2], v[3]}});
        } else if ((i + j + k) % 2 == 0) {
          cells.push_back({CellType::hexahedron, {v.begin(), v.end()}});
        } else {
          const auto top = static_cast<std::uint32_t>(points.size());
          points.emplace_back(i + 0.5, j + 0.5, k + 0.5);
          for (const auto& face :
               {std::array{0, 1, 2, 3}, std::array{4, 7, 6, 5}, std::array{0, 4, 5, 1},
                std::array{2, 6, 7, 3}, std::array{0, 3, 7, 4}, std::array{1, 5, 6, 2}}) {
            std::vector<std::uint32_t> pyramid;
            for (const int c : face) pyramid.push_back(v[static_cast<std::size_t>(c)]);
            pyramid.push_back(top);
            cells.push_back({CellType::pyramid, pyramid});
          }
        }
      }
    }
  }
  EXPECT_GT(points.size(), corners);
  std::vector<std::uint32_t> number(points.size());
  std::iota(number.begin(), number.end(), 0U);
  std::ranges::shuffle(number, random);
  data.points.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) data.points[number[i]] = points[i];
  for (auto& [type, cell] : cells) {
    for (std::uint32_t& i : cell) i = number[i];
    data.add_cell(type, cell);
  }
  return data;
}

TEST(Decompose, NeighboursOfAllTypesShareTheirDiagonals) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 50; ++trial) {
    const Decomposition split = decompose(mixed_block(random));
    ASSERT_EQ(split.inverted, 0U);
    ASSERT_NEAR(total_volume(split.mesh), 27, 1e-12);
    const Adjacency adjacency = face_adjacency(split.mesh);
    ASSERT_EQ(adjacency.crowded_faces, 0U);
    // Nothing but the surface of the block is open: 6 sides of 9 squares, two triangles each.
    ASSERT_EQ(adjacency.boundary_faces, 6U * 9 * 2);
  }
}

TEST(Decompose, FacesThatAreNotFlatLoseNoVolume) {
  // Points inside the block are moved: the faces there become skew, but neighbours cut them alike,
  // so the parts still fill the block.
  std::mt19937 random(6);
  std::uniform_real_distribution<double> shift(-0.1, 0.1);
  for (int trial = 0; trial < 50; ++trial) {
    MeshData data = mixed_block(random);
    for (Vector3d& p : data.points) {
      if ((p.array() > 0).all() && (p.array() < 3).all()) {
        p += Vector3d(shift(random), shift(random), shift(random));
      }
    }
    const Decomposition split = decompose(data);
    ASSERT_EQ(split.inverted, 0U);
    ASSERT_NEAR(total_volume(split.mesh) / 27, 1, 1e-12);
    ASSERT_EQ(face_adjacency(split.mesh).crowded_faces, 0U);
    ASSERT_EQ(face_adjacency(split.mesh).boundary_faces, 6U * 9 * 2);
  }
}

TEST(Decompose, CollapsedHexahedronIsNoCrack) {
  // Two bricks side by side; the second one has its far edge drawn together to a line, as points
  // that are the same, next to which lies a wedge that shares that line.
  MeshData data;
  data.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1},
                 {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {2, 0, 0}, {2, 0, 1}};
  data.add_cell(CellType::hexahedron, std::array<std::uint32_t, 8>{0, 1, 2, 3, 4, 5, 6, 7});
  data.add_cell(CellType::hexahedron, std::array<std::uint32_t, 8>{1, 8, 8, 2, 5, 9, 9, 6});
  const Decomposition split = decompose(data);
  EXPECT_NEAR(total_volume(split.mesh), 1.5, 1e-14);
  EXPECT_EQ(split.inverted, 0U);
  EXPECT_GT(split.collapsed, 0U);
  const Adjacency adjacency = face_adjacency(split.mesh);
  EXPECT_EQ(adjacency.crowded_faces, 0U);
  EXPECT_EQ(adjacency.boundary_faces, 5U * 2 + 1 + 1 + 2 + 2);
}

TEST(Decompose, PointsThatCoincideGiveCellsWithoutVolumeThatStay) {
  MeshData data;
  data.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                 {0, 0, 1}, {1, 0, 1}, {1, 0, 1}, {0, 0, 1}};  // the top is a line
  data.add_cell(CellType::hexahedron, std::array<std::uint32_t, 8>{0, 1, 2, 3, 4, 5, 6, 7});
  const Decomposition split = decompose(data);
  EXPECT_EQ(split.mesh.cells.size(), 6U);
  EXPECT_EQ(split.mesh.points.size(), 8U);
  EXPECT_NEAR(total_volume(split.mesh), 0.5, 1e-14);
  EXPECT_EQ(face_adjacency(split.mesh).boundary_faces, 12U);
}

TEST(Decompose, InputTetrahedraKeepTheirOrderAndNumber) {
  MeshData data;
  data.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}};
  data.add_cell(CellType::tetra, std::array<std::uint32_t, 4>{0, 1, 2, 3});
  data.add_cell(CellType::tetra, std::array<std::uint32_t, 4>{0, 2, 1, 3});  // turned over
  data.add_cell(CellType::tetra, std::array<std::uint32_t, 4>{0, 1, 2, 4});  // flat
  data.add_cell(CellType::tetra, std::array<std::uint32_t, 4>{0, 1, 2, 2});  // no four points
  const Decomposition split = decompose(data);
  ASSERT_EQ(split.mesh.cells.size(), 4U);
  EXPECT_EQ(split.inverted, 1U);
  EXPECT_EQ(split.mesh.cells[0], (Cell{0, 1, 2, 3}));
  EXPECT_GT(tests::volume(split.mesh, split.mesh.cells[1]), 0);
  EXPECT_EQ(split.mesh.cells[2], (Cell{0, 1, 2, 4}));
}

TEST(Decompose, FieldsFollowTheirPointsAndCells) {
  MeshData data;
  data.points = {{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1},
                 {8, 8, 8}, {1, 1, 0}, {0, 0, 5}, {1, 0, 5}};
  data.add_cell(CellType::triangle, std::array<std::uint32_t, 3>{0, 1, 2});
  data.add_cell(CellType::tetra, std::array<std::uint32_t, 4>{1, 2, 3, 4});
  data.add_cell(CellType::pyramid, std::array<std::uint32_t, 5>{1, 2, 6, 3, 7});
  data.fields.push_back({"p", Location::point, 2, {}});
  for (int i = 0; i < 9; ++i) {
    data.fields[0].values.push_back(i);
    data.fields[0].values.push_back(-i);
  }
  data.fields.push_back({"c", Location::cell, 1, {10, 20, 30}});
  const Decomposition split = decompose(data);
  EXPECT_EQ(split.skipped, 1U);
  ASSERT_EQ(split.mesh.points.size(), 6U);  // those numbered 1 2 3 4 6 7
  EXPECT_EQ(split.mesh.fields[0].values,
            (std::vector<double>{1, -1, 2, -2, 3, -3, 4, -4, 6, -6, 7, -7}));
  EXPECT_EQ(split.mesh.fields[1].values, (std::vector<double>{20, 30, 30}));
  EXPECT_EQ(split.mesh.points[4], Vector3d(1, 1, 0));
}

TEST(Decompose, PolyhedronIsStarredFromTheMeanOfItsPoints) {
  const Sample cube = samples()[1];
  MeshData data;
  data.points = cube.points;
  // Six faces, some seen from inside.
  const std::vector<std::uint32_t> stream = {6, 4, 0, 1, 2, 3, 4, 4, 5, 6, 7, 4, 0, 4, 5, 1,
                                             4, 2, 6, 7, 3, 4, 0, 3, 7, 4, 4, 1, 2, 6, 5};
  data.add_cell(CellType::polyhedron, stream);
  data.fields.push_back({"x", Location::point, 1, {}});
  for (const Vector3d& p : data.points) data.fields[0].values.push_back(p.x());
  const Decomposition split = decompose(data);
  EXPECT_EQ(split.mesh.cells.size(), 12U);
  EXPECT_EQ(split.inverted, 0U);
  EXPECT_NEAR(total_volume(split.mesh), 1, 1e-14);
  ASSERT_EQ(split.mesh.points.size(), 9U);
  EXPECT_EQ(split.mesh.points[8], Vector3d(0.5, 0.5, 0.5));
  EXPECT_EQ(split.mesh.fields[0].values[8], 0.5);
}

TEST(Decompose, PolyhedronAndHexahedronAgreeOnTheirFace) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<std::uint32_t> n(12);
    std::iota(n.begin(), n.end(), 0U);
    std::ranges::shuffle(n, random);
    MeshData data;
    data.points.resize(12);
    for (std::size_t i = 0; i < 12; ++i) {
      data.points[n[i]] = Vector3d(i / 4, (i % 4) / 2, i % 2);
    }
    data.add_cell(CellType::hexahedron, std::array{n[0], n[4], n[6], n[2], n[1], n[5], n[7], n[3]});
    const std::vector<std::uint32_t> stream = {6,     4,     n[4], n[5],  n[7],  n[6],  4,    n[8],
                                               n[10], n[11], n[9], 4,     n[4],  n[8],  n[9], n[5],
                                               4,     n[6],  n[7], n[11], n[10], 4,     n[4], n[6],
                                               n[10], n[8],  4,    n[5],  n[9],  n[11], n[7]};
    data.add_cell(CellType::polyhedron, stream);
    const Adjacency adjacency = face_adjacency(decompose(data).mesh);
    ASSERT_EQ(adjacency.crowded_faces, 0U);
    ASSERT_EQ(adjacency.boundary_faces, 20U);
  }
}

TEST(Decompose, HigherOrderIsReducedToCorners) {
  MeshData data;
  data.points = {{0, 0, 0},   {1, 0, 0},   {0, 1, 0},   {0, 0, 1},   {0.5, 0, 0},
                 {.5, .5, 0}, {0, 0.5, 0}, {0, 0, 0.5}, {.5, 0, .5}, {0, .5, .5}};
  std::vector<std::uint32_t> ten(10);
  std::iota(ten.begin(), ten.end(), 0U);
  data.add_cell(CellType::quadratic_tetra, ten);
  const Decomposition split = decompose(data);
  EXPECT_EQ(split.nonlinear.at(CellType::quadratic_tetra), 1U);
  EXPECT_EQ(split.mesh.cells.size(), 1U);
  EXPECT_EQ(split.mesh.points.size(), 4U);
}

TEST(Decompose, CoordinatesThatAreNotFiniteAreCarriedAlong) {
  MeshData data;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  data.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, nan}};
  data.add_cell(CellType::tetra, std::array<std::uint32_t, 4>{0, 1, 2, 3});
  EXPECT_EQ(decompose(data).mesh.cells.size(), 1U);
}

TEST(Decompose, RefusesWhatContradictsItself) {
  const auto message = [](const MeshData& data) -> std::string {
    try {
      const Decomposition split = decompose(data);
    } catch (const base::InputError& error) {
      return error.what();
    }
    return "";
  };
  MeshData data;
  data.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  EXPECT_NE(message(data), "");  // no cells

  MeshData flat = data;
  flat.add_cell(CellType::triangle, std::array<std::uint32_t, 3>{0, 1, 2});
  EXPECT_NE(message(flat).find("no cell of dimension 3"), std::string::npos);

  MeshData beyond = data;
  beyond.add_cell(CellType::tetra, std::array<std::uint32_t, 4>{0, 1, 2, 4});
  EXPECT_EQ(message(beyond), "cell 0 (tetra) names point 4, but there are 4 points");

  MeshData short_cell = data;
  short_cell.add_cell(CellType::hexahedron, std::array<std::uint32_t, 4>{0, 1, 2, 3});
  EXPECT_EQ(message(short_cell), "cell 0 (hexahedron) has 4 points instead of 8");

  MeshData cut_off = data;
  cut_off.add_cell(CellType::polyhedron, std::array<std::uint32_t, 4>{2, 3, 0, 1});
  EXPECT_EQ(message(cut_off), "cell 0 (polyhedron) ends within its face 0 of 2");

  MeshData field = data;
  field.add_cell(CellType::tetra, std::array<std::uint32_t, 4>{0, 1, 2, 3});
  field.fields.push_back({"f", Location::point, 1, {1, 2, 3}});
  EXPECT_NE(message(field).find("'f'"), std::string::npos);
}

}  // namespace
}  // namespace tetraglass::mesh
