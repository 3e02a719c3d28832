#include "mesh/adjacency.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "mesh/samples.h"
#include "support/meshes.h"

namespace tetraglass::mesh {
namespace {

using Triple = std::array<std::uint32_t, 3>;

Triple face_of(const Cell& cell, std::size_t face) {
  Triple triple{};
  for (std::size_t v = 0; v < 3; ++v) {
    triple[v] = cell[static_cast<std::size_t>(kFaceVertices[face][v])];
  }
  std::sort(triple.begin(), triple.end());
  return triple;
}

Cell sorted(Cell cell) {
  std::ranges::sort(cell);
  return cell;
}

// The same by a map from faces to cells: slow and obvious.
Adjacency by_map(const TetMesh& mesh) {
  std::map<Triple, std::vector<std::pair<std::uint32_t, std::size_t>>> owners;
  for (std::uint32_t c = 0; c < mesh.cells.size(); ++c) {
    for (std::size_t f = 0; f < 4; ++f) owners[face_of(mesh.cells[c], f)].emplace_back(c, f);
  }
  Adjacency result;
  result.neighbors.assign(mesh.cells.size(), {kNoCell, kNoCell, kNoCell, kNoCell});
  for (const auto& [face, cells] : owners) {
    if (cells.size() == 1) {
      ++result.boundary_faces;
    } else if (cells.size() == 2 &&
               sorted(mesh.cells[cells[0].first]) != sorted(mesh.cells[cells[1].first])) {
      result.neighbors[cells[0].first][cells[0].second] = cells[1].first;
      result.neighbors[cells[1].first][cells[1].second] = cells[0].first;
    } else {
      ++result.crowded_faces;
    }
  }
  return result;
}

void expect_same(const TetMesh& mesh) {
  const Adjacency fast = face_adjacency(mesh);
  const Adjacency slow = by_map(mesh);
  EXPECT_EQ(fast.neighbors, slow.neighbors);
  EXPECT_EQ(fast.boundary_faces, slow.boundary_faces);
  EXPECT_EQ(fast.crowded_faces, slow.crowded_faces);
}

TetMesh shuffled(TetMesh mesh, unsigned seed) {
  std::mt19937 bits(seed);
  std::vector<std::uint32_t> names(mesh.points.size());
  std::iota(names.begin(), names.end(), 0U);
  std::shuffle(names.begin(), names.end(), bits);
  for (Cell& cell : mesh.cells) {
    for (std::uint32_t& v : cell) v = names[v];
    std::rotate(cell.begin(), cell.begin() + 1, cell.end());
  }
  std::shuffle(mesh.cells.begin(), mesh.cells.end(), bits);
  return mesh;
}

TEST(Adjacency, OfNothingAndOfOneCell) {
  EXPECT_TRUE(face_adjacency(TetMesh{}).neighbors.empty());
  const Adjacency one = face_adjacency(tests::unit_tetrahedron());
  EXPECT_EQ(one.boundary_faces, 4U);
  EXPECT_EQ(one.crowded_faces, 0U);
  EXPECT_EQ(one.neighbors.at(0), (std::array{kNoCell, kNoCell, kNoCell, kNoCell}));
}

TEST(Adjacency, OfABoxHasTwoBoundaryTrianglesPerSquare) {
  const TetMesh mesh = tests::box({0, 0, 0}, {1, 1, 1}, 4, 5, 6, [](const auto&) { return 0.0; });
  const Adjacency adjacency = face_adjacency(mesh);
  EXPECT_EQ(adjacency.boundary_faces, 2U * 2U * (4U * 5U + 5U * 6U + 4U * 6U));
  EXPECT_EQ(adjacency.crowded_faces, 0U);
  expect_same(mesh);
}

TEST(Adjacency, IsMutualAndSharesThreeVertices) {
  const TetMesh mesh = make_sample("sphere", 50000);
  const Adjacency adjacency = face_adjacency(mesh);
  for (std::uint32_t c = 0; c < mesh.cells.size(); ++c) {
    for (std::size_t f = 0; f < 4; ++f) {
      const std::uint32_t other = adjacency.neighbors[c][f];
      if (other == kNoCell) continue;
      const auto& back = adjacency.neighbors[other];
      const auto place =
          static_cast<std::size_t>(std::find(back.begin(), back.end(), c) - back.begin());
      ASSERT_LT(place, 4U);
      ASSERT_EQ(face_of(mesh.cells[c], f), face_of(mesh.cells[other], place));
    }
  }
}

TEST(Adjacency, DoesNotDependOnTheNumbering) {
  for (unsigned seed = 0; seed < 3; ++seed)
    expect_same(shuffled(make_sample("sphere", 150000), seed));
}

TEST(Adjacency, LinksCrowdedFacesToNone) {
  TetMesh mesh = tests::unit_tetrahedron();
  mesh.points.insert(mesh.points.end(), {{1, 1, 1}, {2, 2, 2}});
  mesh.cells = {{0, 1, 2, 3}, {1, 3, 2, 4}, {1, 3, 2, 5}};
  const Adjacency adjacency = face_adjacency(mesh);
  EXPECT_EQ(adjacency.crowded_faces, 1U);
  EXPECT_EQ(adjacency.boundary_faces, 9U);
  for (const auto& neighbors : adjacency.neighbors) {
    for (const std::uint32_t neighbor : neighbors) EXPECT_EQ(neighbor, kNoCell);
  }
  mesh.cells = {{0, 1, 2, 3}, {1, 1, 2, 3}};  // the second cell has the face 123 twice
  expect_same(mesh);
  EXPECT_EQ(face_adjacency(mesh).crowded_faces, 1U);
}

TEST(Adjacency, LinksNoCellToItsDouble) {
  // Alone, a cell and its double share all four faces.
  TetMesh twice = tests::unit_tetrahedron();
  twice.cells.push_back({2, 1, 0, 3});
  const Adjacency alone = face_adjacency(twice);
  EXPECT_EQ(alone.crowded_faces, 4U);
  EXPECT_EQ(alone.boundary_faces, 0U);
  for (const auto& neighbors : alone.neighbors) {
    EXPECT_EQ(neighbors, (std::array{kNoCell, kNoCell, kNoCell, kNoCell}));
  }
  // On the hull of a mesh, the double of a cell must not hide that the mesh ends there.
  TetMesh box = tests::box({0, 0, 0}, {1, 1, 1}, 3, 3, 3, [](const auto&) { return 0.0; });
  const Adjacency before = face_adjacency(box);
  for (const std::uint32_t cell : {0U, 40U, 161U}) {
    SCOPED_TRACE(cell);
    TetMesh doubled = box;
    doubled.cells.push_back(box.cells[cell]);
    std::swap(doubled.cells.back()[0], doubled.cells.back()[2]);
    const Adjacency after = face_adjacency(doubled);
    const auto open = static_cast<std::size_t>(std::ranges::count(before.neighbors[cell], kNoCell));
    EXPECT_EQ(after.crowded_faces, 4U);
    EXPECT_EQ(after.boundary_faces, before.boundary_faces - open);
    for (const std::uint32_t c : {cell, static_cast<std::uint32_t>(box.cells.size())}) {
      EXPECT_EQ(after.neighbors[c], (std::array{kNoCell, kNoCell, kNoCell, kNoCell}));
    }
    expect_same(doubled);
    expect_same(shuffled(doubled, cell));
  }
}

// One vertex that every cell has: all faces but the outer ones fall to it.
TEST(Adjacency, OfAFanAroundOneVertex) {
  TetMesh mesh = tests::unit_tetrahedron();
  constexpr std::uint32_t kBlades = 20000;
  mesh.points.resize(kBlades + 3);
  mesh.cells.clear();
  for (std::uint32_t i = 0; i < kBlades; ++i) mesh.cells.push_back({0, 1, i + 2, i + 3});
  const Adjacency adjacency = face_adjacency(mesh);
  EXPECT_EQ(adjacency.boundary_faces, 2U * kBlades + 2U);
  expect_same(mesh);
}

}  // namespace
}  // namespace tetraglass::mesh
