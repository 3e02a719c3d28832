#include "mesh/samples.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "mesh/adjacency.h"
#include "mesh/check.h"
#include "mesh/predicates.h"
#include "support/meshes.h"

namespace tetraglass::mesh {
namespace {

using Eigen::Vector3d;

TEST(Samples, AllAreSoundAndPositivelyOriented) {
  for (const std::string& name : sample_names()) {
    const TetMesh mesh = make_sample(name);
    ASSERT_FALSE(mesh.cells.empty()) << name;
    ASSERT_FALSE(mesh.fields.empty()) << name;
    EXPECT_EQ(mesh.fields[0].name, name);
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
    const double volume = std::accumulate(
        mesh.cells.begin(), mesh.cells.end(), 0.0,
        [&](double sum, const Cell& cell) { return sum + tests::volume(mesh, cell); });
    EXPECT_NEAR(volume, 8, 1e-10);
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

TEST(Samples, RefuseWrongNamesAndSizes) {
  try {
    (void)make_sample("shpere");
    FAIL() << "nothing was thrown";
  } catch (const base::UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("'sphere'"), std::string::npos) << error.what();
  }
  EXPECT_THROW((void)make_sample("sphere", 40'000'000'000), base::UsageError);
}

}  // namespace
}  // namespace tetraglass::mesh
