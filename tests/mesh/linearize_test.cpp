#include "mesh/linearize.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "mesh/adjacency.h"
#include "mesh/decompose.h"
#include "mesh/import.h"
#include "support/data.h"
#include "support/meshes.h"
#include "support/total_volume.h"

namespace tetraglass::mesh {
namespace {

using Eigen::Vector3d;

using tests::total_volume;

/// Builds quadratic cells of linear ones, with a point in the middle of every edge: cells that
/// share an edge share its point.
class QuadraticBuilder {
 public:
  explicit QuadraticBuilder(std::vector<Vector3d> points) { mesh.points = std::move(points); }

  void add(CellType type, std::vector<std::uint32_t> corners) {
    std::vector<std::uint32_t> cell = corners;
    for (const auto& [a, b] : edges(type)) cell.push_back(between(corners[a], corners[b]));
    mesh.add_cell(type, cell);
  }

  /// As above, with points in the middle of quadrilaterals (by the positions of their corners) and,
  /// perhaps, in the middle of the cell.
  void add(CellType type, const std::vector<std::uint32_t>& corners, CellType edges_of,
           const std::vector<std::vector<std::size_t>>& faces, bool has_centre) {
    std::vector<std::uint32_t> cell = corners;
    for (const auto& [a, b] : edges(edges_of)) cell.push_back(between(corners[a], corners[b]));
    for (const std::vector<std::size_t>& face : faces) {
      std::vector<std::uint32_t> of_face;
      for (const std::size_t i : face) of_face.push_back(corners[i]);
      cell.push_back(middle_of(of_face));
    }
    if (has_centre) cell.push_back(middle_of(corners));
    mesh.add_cell(type, cell);
  }

  /// Every point numbered anew at random; point fields must not be there yet.
  void shuffle(std::mt19937& random) {
    std::vector<std::uint32_t> number(mesh.points.size());
    std::iota(number.begin(), number.end(), 0U);
    std::ranges::shuffle(number, random);
    std::vector<Vector3d> points(mesh.points.size());
    for (std::size_t i = 0; i < points.size(); ++i) points[number[i]] = mesh.points[i];
    mesh.points = points;
    for (std::uint32_t& i : mesh.connectivity) i = number[i];
  }

  void add_field(const std::function<double(const Vector3d&)>& f) {
    Field field{"f", Location::point, 1, {}};
    for (const Vector3d& p : mesh.points) field.values.push_back(f(p));
    mesh.fields.push_back(field);
  }

  MeshData mesh;

 private:
  using Edges = std::vector<std::pair<std::size_t, std::size_t>>;
  static const Edges& edges(CellType type) {
    static const std::map<CellType, Edges> kEdges = {
        {CellType::quadratic_tetra, {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}},
        {CellType::quadratic_hexahedron,
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
          {3, 7}}},
        {CellType::quadratic_wedge,
         {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}},
        {CellType::quadratic_pyramid,
         {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}}};
    return kEdges.at(type);
  }
  std::uint32_t between(std::uint32_t a, std::uint32_t b) {
    const auto [entry, is_new] =
        middles_.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.points.size()));
    if (is_new) mesh.points.emplace_back((mesh.points[a] + mesh.points[b]) / 2);
    return entry->second;
  }
  std::uint32_t middle_of(std::vector<std::uint32_t> corners) {
    std::ranges::sort(corners);
    const auto [entry, is_new] =
        face_middles_.try_emplace(corners, static_cast<std::uint32_t>(mesh.points.size()));
    if (is_new) {
      Vector3d sum = Vector3d::Zero();
      for (const std::uint32_t i : corners) sum += mesh.points[i];
      mesh.points.emplace_back(sum / static_cast<double>(corners.size()));
    }
    return entry->second;
  }
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles_;
  std::map<std::vector<std::uint32_t>, std::uint32_t> face_middles_;
};

/// A row of cells of all quadratic types that share their faces: a cube, six pyramids that fill a
/// second one, two wedges that fill a third, and a tetrahedron below one of the wedges.
QuadraticBuilder quadratic_row() {
  std::vector<Vector3d> points;
  for (int i = 0; i < 4; ++i) {
    for (const auto& [y, z] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
      points.emplace_back(i, y, z);
  }
  points.emplace_back(1.5, 0.5, 0.5);  // 16
  points.emplace_back(3, 0, -1);       // 17
  QuadraticBuilder row(points);
  row.add(CellType::quadratic_hexahedron, {0, 4, 5, 1, 3, 7, 6, 2});
  row.add(CellType::quadratic_pyramid, {4, 5, 6, 7, 16});
  row.add(CellType::quadratic_pyramid, {8, 11, 10, 9, 16});
  row.add(CellType::quadratic_pyramid, {4, 8, 9, 5, 16});
  row.add(CellType::quadratic_pyramid, {7, 6, 10, 11, 16});
  row.add(CellType::quadratic_pyramid, {4, 7, 11, 8, 16});
  row.add(CellType::quadratic_pyramid, {5, 9, 10, 6, 16});
  // VTK's wedges have their first triangle seen from outside.
  row.add(CellType::quadratic_wedge, {11, 15, 14, 8, 12, 13});
  row.add(CellType::quadratic_wedge, {11, 14, 10, 8, 13, 9});
  row.add(CellType::quadratic_tetra, {8, 13, 12, 17});
  return row;
}

TEST(Linearize, QuadraticCellsOfAllTypesAgreeOnTheirFaces) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 50; ++trial) {
    QuadraticBuilder row = quadratic_row();
    row.shuffle(random);
    const double volume = 3 + 1.0 / 6;
    const Decomposition corners = decompose(row.mesh);
    ASSERT_NEAR(total_volume(corners.mesh) / volume, 1, 1e-12);
    ASSERT_EQ(corners.inverted, 0U);
    const Linearization linear = linearize(row.mesh, true);
    EXPECT_EQ(linear.cut, 10U);
    EXPECT_EQ(linear.pieces, 8U + 6 * 10 + 2 * 8 + 8);
    const Decomposition split = decompose(linear.mesh);
    ASSERT_EQ(split.inverted, 0U);
    ASSERT_NEAR(total_volume(split.mesh) / volume, 1, 1e-12);
    for (const Cell& cell : split.mesh.cells) ASSERT_GT(tests::volume(split.mesh, cell), 0);
    const Adjacency adjacency = face_adjacency(split.mesh);
    ASSERT_EQ(adjacency.crowded_faces, 0U);
    // Open: 5 squares of the cube, 4 of the pyramids and 3 of the wedges, each of 8 triangles; 3
    // triangles of the wedges and 3 of the tetrahedron, of 4 each.
    ASSERT_EQ(adjacency.boundary_faces, (5U + 4 + 3) * 8 + (3 + 3) * 4);
  }
}

TEST(Linearize, CellsThatLackMiddlesTakeThoseOfTheirNeighbours) {
  // Cubes of 20, 24 and 27 points and wedges of 15 and 18 in a row along x, a pyramid of 19 on top
  // of the second cube. All points within are displaced, so that none lies where a shape function
  // would put it.
  const std::vector<std::vector<std::size_t>> sides = {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4},
                                                       {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};
  const std::vector<std::vector<std::size_t>> around(sides.begin(), sides.begin() + 4);
  std::vector<Vector3d> points;
  for (int i = 0; i < 5; ++i) {
    for (const auto& [y, z] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
      points.emplace_back(i, y, z);
  }
  points.emplace_back(1.5, 0.5, 2);  // 20
  std::mt19937 random(11);
  std::uniform_real_distribution<double> small(-0.05, 0.05);
  for (int trial = 0; trial < 50; ++trial) {
    QuadraticBuilder row(points);
    const auto cube = [](std::uint32_t i) {
      return std::vector<std::uint32_t>{i, i + 4, i + 5, i + 1, i + 3, i + 7, i + 6, i + 2};
    };
    const std::vector<std::vector<std::size_t>> quads = {{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
    row.add(CellType::quadratic_hexahedron, cube(0));
    row.add(CellType::biquadratic_quadratic_hexahedron, cube(4), CellType::quadratic_hexahedron,
            around, false);
    row.add(CellType::triquadratic_pyramid, {7, 11, 10, 6, 20}, CellType::quadratic_pyramid,
            {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}, true);
    row.add(CellType::triquadratic_hexahedron, cube(8), CellType::quadratic_hexahedron, sides,
            true);
    row.add(CellType::biquadratic_quadratic_wedge, {15, 19, 18, 12, 16, 17},
            CellType::quadratic_wedge, quads, false);
    row.add(CellType::quadratic_wedge, {15, 18, 14, 12, 17, 13});
    for (Vector3d& p : row.mesh.points) {
      const bool inside_cubes = p.x() > 0 && p.x() < 4 && p.y() > 0 && p.y() < 1 && p.z() > 0;
      if (inside_cubes && p.z() < 2) p += Vector3d(small(random), small(random), small(random));
    }
    const double volume = 4 + 1.0 / 3;
    row.shuffle(random);
    const Linearization linear = linearize(row.mesh, true);
    EXPECT_EQ(linear.pieces, 3U * 8 + 2 * 8 + 10);
    // Of the first cube five sides and the centre, of the second z and the centre, of the last
    // wedge one side.
    EXPECT_EQ(linear.added, 6U + 2 + 1);
    const Decomposition split = decompose(linear.mesh);
    ASSERT_EQ(split.inverted, 0U);
    const Adjacency adjacency = face_adjacency(split.mesh);
    ASSERT_EQ(adjacency.crowded_faces, 0U);
    ASSERT_EQ(adjacency.boundary_faces, (5U + 3 + 4 + 3) * 8 + 4 * 4 + 4 * 4);
    // Its outside is not quite flat where triangles of the pyramid and sides were displaced.
    EXPECT_NEAR(total_volume(split.mesh) / volume, 1, 0.05);
  }
}

TEST(Linearize, AddedPointsHaveTheValuesOfTheShapeFunctions) {
  // Serendipity elements hold all polynomials of degree two, and x y z in the middle of a brick.
  const auto f = [](const Vector3d& p) {
    return 1 + p.x() - 2 * p.y() + p.x() * p.y() - 3 * p.z() * p.z() + p.x() * p.x() +
           0.5 * p.y() * p.z();
  };
  QuadraticBuilder row = quadratic_row();
  row.add_field(f);
  row.mesh.fields.push_back({"c", Location::cell, 1, {}});
  for (std::size_t i = 0; i < row.mesh.cell_count(); ++i) {
    row.mesh.fields[1].values.push_back(static_cast<double>(i));
  }
  const Linearization linear = linearize(row.mesh, true);
  ASSERT_GT(linear.added, 0U);
  ASSERT_EQ(linear.mesh.fields[0].values.size(), linear.mesh.points.size());
  for (std::size_t i = 0; i < linear.mesh.points.size(); ++i) {
    EXPECT_NEAR(linear.mesh.fields[0].values[i], f(linear.mesh.points[i]), 1e-13);
  }
  ASSERT_EQ(linear.mesh.fields[1].values.size(), linear.mesh.cell_count());
  EXPECT_EQ(linear.mesh.fields[1].values[7], 0);
  EXPECT_EQ(linear.mesh.fields[1].values.back(), 9);
}

TEST(Linearize, LeavesOtherCellsInTheirPlace) {
  QuadraticBuilder row = quadratic_row();
  const Linearization same = linearize(row.mesh, false);
  EXPECT_EQ(same.cut, 0U);
  EXPECT_EQ(same.mesh.connectivity, row.mesh.connectivity);
}

TEST(Linearize, RefusesWrongNumbersOfPoints) {
  MeshData data;
  data.points.resize(40, Vector3d::Zero());
  std::vector<std::uint32_t> cell(11);
  std::iota(cell.begin(), cell.end(), 0U);
  for (const CellType type :
       {CellType::lagrange_tetra, CellType::lagrange_hexahedron, CellType::lagrange_wedge}) {
    MeshData wrong = data;
    wrong.add_cell(type, cell);
    EXPECT_THROW(static_cast<void>(linearize(wrong, false)), base::InputError);
  }
  MeshData beyond = data;
  beyond.add_cell(CellType::lagrange_tetra, std::array<std::uint32_t, 4>{0, 1, 2, 99});
  EXPECT_THROW(static_cast<void>(linearize(beyond, false)), base::InputError);
}

struct Known {
  const char* file;
  std::size_t pieces;
  double volume;         // of straight-sided cells; 0 where they are curved
  std::size_t boundary;  // triangles of it: four times those of the corner cells
};

TEST(Linearize, RealCellsOfHigherOrderHaveNoCracks) {
  SKIP_WITHOUT_DATA();
  for (const Known& known :
       // 12 triangles of 36 pieces; and, where 3 points on an edge are doubled in the file, 16
       // pieces of each of the two sides that do not meet.
       {Known{"torture/tets_in_1x1x1_block_o6.vtk", 5 * 216, 1, 12 * 36 + 2 * 16},
        // 15 quadrilaterals less two that are met from both sides, and two triangles.
        Known{"torture/LagrangeHexWedge.vtk", 2 * 8 + 8, 0, (15 - 4) * 8 + 2 * 4},
        Known{"tets/QuadraticTetra.vtu", 96 * 8, 8, 0},
        Known{"mixed/QuadraticWedge.vtu", 16 * 8, 8, 0},
        Known{"mixed/QuadraticPyramid.vtu", 48 * 10, 8, 0},
        Known{"mixed/notch_disp.vtu", 2192 * 8, 0, 0},
        Known{"mixed/simple-cube-multi-element-order2.e", 322 * 8, 2, 0},
        Known{"torture/TriQuadraticHexahedron.vtu", 7 * 8, 0, 0},
        Known{"torture/read_exodus_TET14.e", 192 * 8, 64, 0},
        Known{"torture/read_exodus_TET10.e", 192 * 8, 64, 0}}) {
    SCOPED_TRACE(known.file);
    ImportOptions options;
    options.refine_quadratic = true;
    const std::string file = (tests::data_folder() / known.file).string();
    const Import fine = import_mesh(file, options);
    const std::string note = "are cut into " + std::to_string(known.pieces) + " linear ones";
    EXPECT_TRUE(std::ranges::any_of(fine.report.notes, [&](const std::string& text) {
      return text.find(note) != std::string::npos;
    })) << note;
    const Adjacency adjacency = face_adjacency(fine.mesh);
    EXPECT_EQ(adjacency.crowded_faces, 0U);
    if (known.volume > 0) {
      EXPECT_NEAR(total_volume(fine.mesh) / known.volume, 1, 1e-6);
      EXPECT_EQ(fine.report.inverted, 0U);
    }
    // A crack would open faces inside.
    const std::size_t coarse = face_adjacency(import_mesh(file).mesh).boundary_faces;
    EXPECT_EQ(adjacency.boundary_faces, known.boundary > 0 ? known.boundary : 4 * coarse);
  }
}

}  // namespace
}  // namespace tetraglass::mesh
