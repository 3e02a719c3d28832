#include "mesh/samples.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "mesh/adjacency.h"
#include "mesh/check.h"
#include "mesh/predicates.h"
#include "support/meshes.h"

namespace tetraglass::mesh {
namespace {

using Eigen::Vector3d;

double mesh_volume(const TetMesh& mesh) {
  return std::accumulate(
      mesh.cells.begin(), mesh.cells.end(), 0.0,
      [&](double sum, const Cell& cell) { return sum + tests::volume(mesh, cell); });
}

TEST(Samples, AllAreSoundAndPositivelyOriented) {
  for (const std::string& name : sample_names()) {
    const TetMesh mesh = make_sample(name);
    ASSERT_FALSE(mesh.cells.empty()) << name;
    ASSERT_FALSE(mesh.fields.empty()) << name;
    EXPECT_EQ(mesh.fields[0].name, name == "heat-sink" ? "temperature" : name);
    EXPECT_EQ(mesh.fields[0].values.size(), mesh.points.size()) << name;
    for (const Cell& c : mesh.cells) {
      ASSERT_EQ(
          orientation(mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]], mesh.points[c[3]]),
          1)
          << name;
    }
    const Soundness soundness = check(mesh);
    EXPECT_EQ(soundness.nan_values, 0U) << name;
    EXPECT_EQ(soundness.crowded_faces, 0U) << name;
  }
}

TEST(Samples, OfWeilerHave148955Cells) {
  for (const char* name : {"orbital", "sphere", "linear"}) {
    const TetMesh mesh = make_sample(name);
    EXPECT_EQ(mesh.cells.size(), 148955U);
    EXPECT_EQ(mesh.points.size(), 32768U);
    EXPECT_EQ(bounds(mesh).min(), Vector3d(-1, -1, -1));
    EXPECT_EQ(bounds(mesh).max(), Vector3d(1, 1, 1));
    EXPECT_NEAR(mesh_volume(mesh), 8, 1e-10);
    const Soundness soundness = check(mesh);
    EXPECT_TRUE(soundness.convex);
    EXPECT_EQ(soundness.parts, 1U);
    EXPECT_EQ(soundness.boundary_faces, 6U * 31U * 31U * 2U);  // so all inner faces match
  }
}

TEST(Samples, TakeTheNearestCellCount) {
  EXPECT_EQ(make_sample("sphere", 1).cells.size(), 5U);
  EXPECT_EQ(make_sample("sphere", 22).cells.size(), 5U);  // 5 or 40
  EXPECT_EQ(make_sample("sphere", 23).cells.size(), 40U);
  EXPECT_EQ(make_sample("sphere", 40).cells.size(), 40U);
  EXPECT_EQ(make_sample("sphere", 100000).cells.size(), 5U * 27U * 27U * 27U);
}

TEST(Samples, HoldTheirFields) {
  const TetMesh linear = make_sample("linear", 1000);
  const auto [low, high] =
      std::minmax_element(linear.fields[0].values.begin(), linear.fields[0].values.end());
  EXPECT_DOUBLE_EQ(*low, 0);
  EXPECT_DOUBLE_EQ(*high, 1);
  const TetMesh sphere = make_sample("sphere", 1000);
  for (std::size_t i = 0; i < sphere.points.size(); ++i) {
    EXPECT_EQ(sphere.fields[0].values[i], sphere.points[i].norm());
  }
  const TetMesh orbital = make_sample("orbital", 600000);
  const double most =
      *std::max_element(orbital.fields[0].values.begin(), orbital.fields[0].values.end());
  EXPECT_LE(most, 1);
  EXPECT_GT(most, 0.98);  // a point of the grid comes near the maximum of each lobe
}

// The lobes: the points above half the maximum form eight pieces.
TEST(Samples, TheOrbitalHasEightLobes) {
  const TetMesh mesh = make_sample("orbital", 600000);
  TetMesh inside = mesh;
  inside.cells.clear();
  for (const Cell& cell : mesh.cells) {
    const bool high = std::all_of(cell.begin(), cell.end(),
                                  [&](auto v) { return mesh.fields[0].values[v] > 0.5; });
    if (high) inside.cells.push_back(cell);
  }
  EXPECT_EQ(check(inside).parts, 8U);
}

TEST(Samples, NeedlesFillTheBoxWithSlivers) {
  for (const std::size_t cells : {0, 5, 40, 135, 320, 4000}) {
    const TetMesh mesh = make_sample("needles", cells);
    EXPECT_NEAR(mesh_volume(mesh), 8, 1e-10) << cells;
    const Soundness soundness = check(mesh);
    EXPECT_EQ(soundness.degenerate, 0U);
    EXPECT_TRUE(soundness.convex);
    if (cells == 0 || cells >= 135) {
      EXPECT_LT(soundness.min_dihedral_degrees, 1e-5) << cells;
      EXPECT_GT(soundness.min_dihedral_degrees, 1e-7) << cells;
    }
  }
}

TEST(Samples, ShellsAreFourPartsAtAnySize) {
  for (const std::size_t cells : {0, 1, 10000, 30000, 200000}) {
    const TetMesh mesh = make_sample("shells", cells);
    const Soundness soundness = check(mesh);
    EXPECT_EQ(soundness.parts, 4U) << cells;
    EXPECT_EQ(soundness.degenerate, 0U) << cells;
    if (cells > 20000) {
      EXPECT_NEAR(double(mesh.cells.size()) / double(cells), 1, 0.3);
    }
    for (const Cell& cell : mesh.cells) ASSERT_GT(tests::volume(mesh, cell), 0) << cells;
  }
  // Parts that touch in a vertex would still be four: the distance of any two of them is positive
  // because no point is shared, and a ray from the middle passes through matter and gaps by turns.
  const TetMesh mesh = make_sample("shells");
  std::vector<double> radii;
  for (const Vector3d& p : mesh.points) {
    if (p.tail<2>().norm() < 0.05) radii.push_back(std::abs(p.x()));
  }
  std::sort(radii.begin(), radii.end());
  int gaps = 0;
  for (std::size_t i = 1; i < radii.size(); ++i) gaps += radii[i] - radii[i - 1] > 0.1 ? 1 : 0;
  EXPECT_EQ(gaps, 3);
}

TEST(Samples, TheCavityHasTwoBoundarySurfacesOneWithATunnel) {
  const TetMesh mesh = make_sample("cavity", 40000);
  const Soundness soundness = check(mesh);
  EXPECT_EQ(soundness.parts, 1U);
  EXPECT_FALSE(soundness.convex);
  // Euler characteristic of a solid with one tunnel and one cavity: 1 - 1 + 1; from its cells:
  // vertices - edges + faces - cells.
  const Adjacency adjacency = face_adjacency(mesh);
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const Cell& cell : mesh.cells) {
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = a + 1; b < 4; ++b) edges.insert(std::minmax(cell[a], cell[b]));
    }
  }
  const std::size_t faces = (4 * mesh.cells.size() + adjacency.boundary_faces) / 2;
  EXPECT_EQ(long(mesh.points.size()) - long(edges.size()) + long(faces) - long(mesh.cells.size()),
            1);
  EXPECT_NEAR(mesh_volume(make_sample("cavity", 2300)), 8 - 0.25 - 0.5 - 0.75, 1e-12);  // 8 voxels
}

// Where the line through (x, y) along z is inside a cell: from low to high (none if low > high).
std::pair<double, double> z_range(const TetMesh& mesh, const Cell& cell, double x, double y) {
  double low = -10;
  double high = 10;
  for (const auto& face : kFaceVertices) {
    const auto at = [&](std::size_t i) -> const Vector3d& {
      return mesh.points[cell[static_cast<std::size_t>(face[i])]];
    };
    const Vector3d outwards = (at(1) - at(0)).cross(at(2) - at(0));
    const double base = outwards.dot(Vector3d(x, y, 0) - at(0));  // <= -z outwards.z inside
    if (std::abs(outwards.z()) < 1e-12 * outwards.norm()) {       // a face along the line
      if (base > 0) return {1, -1};
    } else if (outwards.z() > 0) {
      high = std::min(high, -base / outwards.z());
    } else {
      low = std::max(low, -base / outwards.z());
    }
  }
  return {low, high};
}

TEST(Samples, TheRingIsACycleOfCellsThatHideTheNext) {
  for (const std::size_t cells : {0, 18, 33, 300}) {
    const TetMesh mesh = make_sample("cycle", cells);
    EXPECT_EQ(mesh.cells.size(), cells == 0 ? 27 : cells);
    const std::size_t ring = mesh.cells.size() - 3;
    const Adjacency adjacency = face_adjacency(mesh);
    EXPECT_EQ(check(mesh).parts, 4U);
    for (std::uint32_t i = 0; i < ring; ++i) {
      const auto next = static_cast<std::uint32_t>((i + 1) % ring);
      const auto& neighbors = adjacency.neighbors[i];
      const auto place = static_cast<std::size_t>(
          std::find(neighbors.begin(), neighbors.end(), next) - neighbors.begin());
      ASSERT_LT(place, 4U) << "cell " << i << " of " << cells;
      Vector3d middle = Vector3d::Zero();
      for (const int v : kFaceVertices[place]) {
        middle += mesh.points[mesh.cells[i][static_cast<std::size_t>(v)]] / 3;
      }
      // Along z through the middle of the common face: one cell ends where the next one begins.
      const auto here = z_range(mesh, mesh.cells[i], middle.x(), middle.y());
      const auto there = z_range(mesh, mesh.cells[next], middle.x(), middle.y());
      EXPECT_NEAR(here.first, there.second, 1e-12);
      EXPECT_LT(here.first, here.second);
      EXPECT_LT(there.first, there.second);
    }
  }
}

TEST(Samples, TheBarsInTheRingAreACycleToo) {
  const TetMesh mesh = make_sample("cycle");
  const std::size_t ring = mesh.cells.size() - 3;
  for (std::size_t i = 0; i < 3; ++i) {
    const Cell& bar = mesh.cells[ring + i];
    const Cell& next = mesh.cells[ring + (i + 1) % 3];
    bool seen = false;
    for (double x = -0.4; x < 0.4; x += 0.005) {
      for (double y = -0.4; y < 0.4; y += 0.005) {
        const auto high = z_range(mesh, bar, x, y);
        const auto low = z_range(mesh, next, x, y);
        if (high.first > high.second || low.first > low.second) continue;
        EXPECT_GT(high.first, low.second);
        seen = true;
      }
    }
    EXPECT_TRUE(seen);
  }
}

TEST(Samples, RefuseWrongNamesAndSizes) {
  try {
    (void)make_sample("shpere");
    FAIL() << "nothing was thrown";
  } catch (const base::UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("'sphere'"), std::string::npos) << error.what();
  }
  for (const std::string& name : sample_names()) {
    EXPECT_THROW((void)make_sample(name, 40'000'000'000), base::UsageError) << name;
  }
}

}  // namespace
}  // namespace tetraglass::mesh
