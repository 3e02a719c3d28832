#include "mesh/expression.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "tests/support/meshes.h"

namespace tetraglass::mesh {
namespace {

class Expression : public testing::Test {
 protected:
  Expression() {
    Field velocity{"V", Location::point, 3, {}};
    for (const Eigen::Vector3d& p : mesh_.points)
      velocity.values.insert(velocity.values.end(), p.data(), p.data() + 3);
    mesh_.fields.push_back(velocity);
    mesh_.fields.push_back(
        {"not usable", Location::point, 1, std::vector<double>(mesh_.points.size(), 1)});
    mesh_.fields.push_back(
        {"per_cell", Location::cell, 1, std::vector<double>(mesh_.cells.size(), 1)});
  }
  TetMesh mesh_ = tests::box({0, 0, 0}, {1, 2, 3}, 2, 2, 2, [](const auto& p) { return p.z(); });
};

TEST_F(Expression, KnowsCoordinatesAndFields) {
  const Field field = evaluate_expression(mesh_, "f", "sqrt(x^2 + y*y) - 2*s + mag(V) + radius");
  ASSERT_EQ(field.components, 1);
  ASSERT_EQ(field.tuples(), mesh_.points.size());
  EXPECT_EQ(field.name, "f");
  for (std::size_t i = 0; i < mesh_.points.size(); ++i) {
    const Eigen::Vector3d& p = mesh_.points[i];
    const double radius = (p - Eigen::Vector3d(0.5, 1, 1.5)).norm();
    EXPECT_NEAR(field.values[i], std::hypot(p.x(), p.y()) - 2 * p.z() + p.norm() + radius, 1e-12);
  }
}

TEST_F(Expression, MayBeAVector) {
  const Field field = evaluate_expression(mesh_, "f", "2*V + x*iHat");
  ASSERT_EQ(field.components, 3);
  EXPECT_NEAR(field.values[3 * 5], 3 * mesh_.points[5].x(), 1e-12);
  EXPECT_NEAR(field.values[3 * 5 + 1], 2 * mesh_.points[5].y(), 1e-12);
}

TEST_F(Expression, UndefinedValuesAreNotNumbers) {
  const Field field = evaluate_expression(mesh_, "f", "1 / x");
  for (std::size_t i = 0; i < mesh_.points.size(); ++i) {
    const double x = mesh_.points[i].x();
    EXPECT_EQ(std::isnan(field.values[i]), x == 0) << x;
  }
}

TEST_F(Expression, ErrorsSayWhat) {
  for (const std::string text : {"", "x +", "sqrt(x", "unknown + 1", "per_cell", "x y"}) {
    EXPECT_THROW((void)evaluate_expression(mesh_, "f", text), base::UsageError) << text;
  }
}

}  // namespace
}  // namespace tetraglass::mesh
