#include "sort/centroid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "mesh/samples.h"
#include "sort/views.h"
#include "support/meshes.h"

namespace tetraglass::sort {
namespace {

using Eigen::Vector3d;

Vector3d centroid(const mesh::TetMesh& mesh, std::uint32_t cell) {
  Vector3d sum = Vector3d::Zero();
  for (const std::uint32_t v : mesh.cells[cell]) sum += mesh.points[v];
  return sum / 4;
}

// In perspective the squared distance: what the keys count steps of.
double depth(const mesh::TetMesh& mesh, std::uint32_t cell, const View& view) {
  const Vector3d c = centroid(mesh, cell);
  return view.parallel ? view.direction.dot(c) : (c - view.eye).squaredNorm();
}

// `order` holds exactly `cells`, and no cell is followed by one that is farther by more than
// `slack`.
void expect_sorted(const mesh::TetMesh& mesh, const std::vector<std::uint32_t>& cells,
                   const View& view, const Order& order, double slack) {
  EXPECT_EQ(order.method, "centroid");
  EXPECT_FALSE(order.exact);
  ASSERT_EQ(order.cells.size(), cells.size());
  for (std::size_t i = 1; i < cells.size(); ++i) {
    ASSERT_GE(depth(mesh, order.cells[i - 1], view), depth(mesh, order.cells[i], view) - slack)
        << "place " << i << " of " << cells.size();
  }
  std::vector<std::uint32_t> sorted = order.cells;
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::uint32_t> expected = cells;
  std::sort(expected.begin(), expected.end());
  ASSERT_EQ(sorted, expected);
}

TEST(Centroid, PutsTheFarthestFirst) {
  const mesh::TetMesh mesh = mesh::make_sample("sphere");
  const std::vector<std::uint32_t> cells = all_cells(mesh);
  CentroidSorter sorter(mesh, cells);
  // Keys count steps of 2^-32 of the range, which is below 64 here.
  constexpr double kSlack = 0x1p-26;
  for (const View& view :
       {parallel({0, 0, -1}), parallel({1, 2, 3}), parallel({-0.3, 0.1, 0.01}), from({5, 4, 3}),
        from({0.1, 0.2, 0.3}), from({1, 1, 1}), from({0, 0, 0})}) {
    expect_sorted(mesh, cells, view, sorter.sort(view), kSlack);
  }
}

TEST(Centroid, OfNothingAndOfOneCell) {
  const mesh::TetMesh mesh = tests::unit_tetrahedron();
  EXPECT_TRUE(sort_centroid(mesh, {}, from({1, 2, 3})).cells.empty());
  EXPECT_TRUE(sort_centroid(mesh::TetMesh{}, {}, from({1, 2, 3})).cells.empty());
  const std::vector<std::uint32_t> one = {0};
  CentroidSorter sorter(mesh, one);
  EXPECT_EQ(sorter.sort(from({1, 2, 3})).cells, one);
  EXPECT_EQ(sorter.sort(parallel({1, 2, 3})).cells, one);
  EXPECT_EQ(sorter.sort(from(mesh.points[0])).cells, one);
}

TEST(Centroid, SortsOnlyTheCellsGiven) {
  const mesh::TetMesh mesh = mesh::make_sample("sphere", 5000);
  std::vector<std::uint32_t> cells;
  for (std::uint32_t i = 0; i < mesh.cells.size(); i += 3) cells.push_back(i);
  std::shuffle(cells.begin(), cells.end(), std::mt19937(3));
  const View view = from({3, -2, 1});
  expect_sorted(mesh, cells, view, sort_centroid(mesh, cells, view), 0x1p-26);
}

// Cells of one layer of a regular grid have equal depths; they keep the order they were given in,
// also where the work is cut into chunks.
TEST(Centroid, IsStable) {
  const mesh::TetMesh mesh =
      tests::box({0, 0, 0}, {128, 64, 8}, 128, 64, 8, [](const auto&) { return 0.0; });
  std::vector<std::uint32_t> cells = all_cells(mesh);
  std::shuffle(cells.begin(), cells.end(), std::mt19937(5));
  std::vector<std::uint32_t> expected = cells;
  const View view = parallel({0, 0, 1});
  // Depths are multiples of 1/4: exact in floating point.
  std::stable_sort(expected.begin(), expected.end(), [&](std::uint32_t a, std::uint32_t b) {
    return depth(mesh, a, view) > depth(mesh, b, view);
  });
  EXPECT_EQ(sort_centroid(mesh, cells, view).cells, expected);
}

TEST(Centroid, GivesTheSameOrderAgainWithReusedBuffers) {
  const mesh::TetMesh mesh = mesh::make_sample("sphere", 200000);
  CentroidSorter sorter(mesh, all_cells(mesh));
  const std::vector<std::uint32_t> first = sorter.sort(from({2, 3, 4})).cells;
  const std::vector<std::uint32_t> between = sorter.sort(parallel({1, -3, 2})).cells;
  EXPECT_EQ(sort_centroid(mesh, all_cells(mesh), parallel({1, -3, 2})).cells, between);
  EXPECT_EQ(sorter.sort(from({2, 3, 4})).cells, first);
}

// In single precision these meshes would be one depth.
TEST(Centroid, SortsAMeshFarFromTheOrigin) {
  mesh::TetMesh mesh = mesh::make_sample("sphere", 20000);
  const mesh::TetMesh centered = mesh;
  const Vector3d shift(0x1p40, -0x1p41, 0x1p39);
  for (Vector3d& p : mesh.points) {
    // Coordinates that the shift rounds would make another mesh.
    p = (p * 0x1p8).array().round().matrix() * 0x1p-8 + shift;
  }
  mesh::TetMesh rounded = mesh;
  for (Vector3d& p : rounded.points) p -= shift;
  const std::vector<std::uint32_t> cells = all_cells(mesh);
  const View view = parallel({1, 2, 3});
  expect_sorted(rounded, cells, view, sort_centroid(mesh, cells, view), 0x1p-30);
  expect_sorted(rounded, cells, from({2, 1, 3}),
                sort_centroid(mesh, cells, from(shift + Vector3d(2, 1, 3))), 0x1p-30);
}

// From very far the perspective order becomes the parallel one.
TEST(Centroid, SortsFromAFarEye) {
  const mesh::TetMesh mesh = mesh::make_sample("sphere", 20000);
  const std::vector<std::uint32_t> cells = all_cells(mesh);
  const Vector3d direction = Vector3d(1, 2, 3).normalized();
  for (const double distance : {1e9, 1e12, 1e15}) {
    const Order order = sort_centroid(mesh, cells, from(-distance * direction));
    // The sphere around the eye leaves its tangent plane by r^2 / (2 distance).
    expect_sorted(mesh, cells, parallel(direction), order, 3 / distance + 0x1p-30);
  }
}

TEST(Centroid, DoesNotDependOnTheUnit) {
  const mesh::TetMesh mesh = mesh::make_sample("sphere", 5000);
  const std::vector<std::uint32_t> cells = all_cells(mesh);
  const View view = from({2, 3, 4});
  const Order expected = sort_centroid(mesh, cells, view);
  for (const int exponent : {-400, -100, 100, 400}) {
    mesh::TetMesh scaled = mesh;
    for (Vector3d& p : scaled.points) p *= std::ldexp(1.0, exponent);
    const View far = from(view.eye * std::ldexp(1.0, exponent));
    EXPECT_EQ(sort_centroid(scaled, cells, far).cells, expected.cells) << "2^" << exponent;
  }
}

TEST(Centroid, PutsCellsWithoutADepthFirst) {
  mesh::TetMesh mesh = mesh::make_sample("sphere", 5000);
  const std::uint32_t bad = mesh.cells[700][1];
  mesh.points[bad].y() = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::uint32_t> cells = all_cells(mesh);
  for (const View& view : {from({2, 3, 4}), parallel({1, 1, 1})}) {
    const Order order = sort_centroid(mesh, cells, view);
    const auto is_bad = [&](std::uint32_t c) {
      return std::find(mesh.cells[c].begin(), mesh.cells[c].end(), bad) != mesh.cells[c].end();
    };
    const auto count = std::count_if(cells.begin(), cells.end(), is_bad);
    ASSERT_GT(count, 0);
    EXPECT_TRUE(std::all_of(order.cells.begin(), order.cells.begin() + count, is_bad));
    std::vector<std::uint32_t> sorted = order.cells;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(sorted, cells);
  }
}

}  // namespace
}  // namespace tetraglass::sort
