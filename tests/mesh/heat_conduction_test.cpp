#include "mesh/heat_conduction.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "tests/support/meshes.h"

namespace tetraglass::mesh {
namespace {

const auto kNoField = [](const auto&) { return 0.0; };

// A bar heated at one end and cooled at the other: T falls linearly, which linear elements have
// exactly.
TEST(HeatConduction, BarHasItsClosedForm) {
  const TetMesh bar = tests::box({0, 0, 0}, {0.1, 0.1, 1}, 2, 3, 8, kNoField);
  HeatProblem problem;
  problem.conductivity = 4;
  problem.ambient = 20;
  problem.surface = [](const Eigen::Vector3d& p) {
    if (p.z() < 1e-12) return SurfaceCondition{0, 100};
    if (p.z() > 1 - 1e-12) return SurfaceCondition{50, 0};
    return SurfaceCondition{};
  };
  const std::vector<double> temperature = steady_temperature(bar, problem);
  for (std::size_t i = 0; i < bar.points.size(); ++i) {
    // The flux 100 leaves through h = 50: 2 above ambient at the end, and 100 / 4 per metre from
    // there.
    EXPECT_NEAR(temperature[i], 20 + 2 + 25 * (1 - bar.points[i].z()), 1e-8);
  }
}

TEST(HeatConduction, WhatComesInGoesOut) {
  const TetMesh block = tests::box({-1, -2, 0}, {1, 2, 0.5}, 5, 7, 3, kNoField);
  HeatProblem problem;
  problem.conductivity = 0.3;
  problem.ambient = -5;
  problem.surface = [](const Eigen::Vector3d& p) {
    if (p.z() == 0 && p.x() < 0) return SurfaceCondition{0, 7};
    return SurfaceCondition{1.5 + p.y() / 4, 0};
  };
  const std::vector<double> temperature = steady_temperature(block, problem);
  // Constant temperature is a solution without flux; by linearity the heat given off is the excess
  // weighted by h. Both sums run over the same boundary faces, found here by their coordinates.
  double in = 0;
  double out = 0;
  for (const Cell& cell : block.cells) {
    for (const auto& face : kFaceVertices) {
      std::array<Eigen::Vector3d, 3> p;
      std::array<double, 3> t{};
      for (std::size_t k = 0; k < 3; ++k) {
        p[k] = block.points[cell[static_cast<std::size_t>(face[k])]];
        t[k] = temperature[cell[static_cast<std::size_t>(face[k])]];
      }
      bool on_boundary = false;
      for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {block.points.front()[axis], block.points.back()[axis]}) {
          on_boundary |= p[0][axis] == side && p[1][axis] == side && p[2][axis] == side;
        }
      }
      if (!on_boundary) continue;
      const double area = (p[1] - p[0]).cross(p[2] - p[0]).norm() / 2;
      const SurfaceCondition condition = problem.surface((p[0] + p[1] + p[2]) / 3);
      in += area * condition.flux;
      out += area * condition.transfer * ((t[0] + t[1] + t[2]) / 3 - problem.ambient);
    }
  }
  EXPECT_NEAR(in, 7 * 1 * 4, 1e-12);
  EXPECT_NEAR(out, in, 1e-8 * in);
}

TEST(HeatConduction, RefusesABodyThatCannotCool) {
  const TetMesh block = tests::box({0, 0, 0}, {1, 1, 1}, 2, 2, 2, kNoField);
  HeatProblem problem;
  problem.surface = [](const Eigen::Vector3d&) { return SurfaceCondition{0, 1}; };
  EXPECT_THROW((void)steady_temperature(block, problem), base::InputError);
}

}  // namespace
}  // namespace tetraglass::mesh
