#include "mesh/tet_mesh.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "support/meshes.h"

namespace tetraglass::mesh {
namespace {

using Eigen::Vector3d;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TetMesh brick() {
  return tests::box({-1, 0, 2}, {1, 3, 4}, 3, 4, 5,
                    [](const Vector3d& p) { return p.x() + p.y(); });
}

std::string message_of(const TetMesh& mesh, const std::string& spec) {
  try {
    (void)select_scalar(mesh, spec);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(Bounds, CoverThePointsThatCellsUse) {
  TetMesh mesh = brick();
  mesh.points.emplace_back(100, 100, 100);  // used by no cell
  mesh.points.emplace_back(kNan, -50, 0);   // used, but not finite
  mesh.cells.push_back({0, 1, 2, static_cast<std::uint32_t>(mesh.points.size() - 1)});
  const Box box = bounds(mesh);
  EXPECT_EQ(box.min(), Vector3d(-1, 0, 2));
  EXPECT_EQ(box.max(), Vector3d(1, 3, 4));
  EXPECT_TRUE(bounds(TetMesh{}).isEmpty());
}

TEST(SelectScalar, TakesTheFirstScalarFieldByDefault) {
  TetMesh mesh = brick();
  std::vector<double> vectors(3 * mesh.points.size(), 2.0);
  mesh.fields.insert(mesh.fields.begin(), Field{"V", Location::point, 3, vectors});
  EXPECT_EQ(select_scalar(mesh, "").name, "s");
  mesh.fields.pop_back();
  const ScalarField magnitude = select_scalar(mesh, "");
  EXPECT_EQ(magnitude.name, "V:magnitude");
  EXPECT_DOUBLE_EQ(magnitude.values.at(0), std::sqrt(12.0));
  mesh.fields.clear();
  const ScalarField height = select_scalar(mesh, "");
  EXPECT_EQ(height.name, "z");
  EXPECT_EQ(height.values, select_scalar(mesh, "z").values);
}

TEST(SelectScalar, GivesTheRangeOfTheFiniteValues) {
  TetMesh mesh = brick();
  ScalarField field = select_scalar(mesh, "s");
  EXPECT_EQ(field.name, "s");
  EXPECT_EQ(field.location, Location::point);
  EXPECT_EQ(field.values, mesh.fields[0].values);
  EXPECT_DOUBLE_EQ(field.min, -1);
  EXPECT_DOUBLE_EQ(field.max, 4);
  mesh.fields[0].values[3] = kInfinity;
  mesh.fields[0].values[7] = kNan;
  field = select_scalar(mesh, "s");
  EXPECT_LE(field.max, 4);
  for (double& value : mesh.fields[0].values) value = kNan;
  field = select_scalar(mesh, "s");
  EXPECT_EQ(field.min, 0);
  EXPECT_EQ(field.max, 0);
}

TEST(SelectScalar, TakesComponentsAndMagnitudes) {
  TetMesh mesh = brick();
  Field vector{"V", Location::cell, 3, {}};
  Field tensor{"T", Location::point, 9, {}};
  for (std::size_t i = 0; i < mesh.cells.size(); ++i) {
    const auto t = static_cast<double>(i);
    vector.values.insert(vector.values.end(), {3 * t, -4 * t, 12 * t});
  }
  for (std::size_t i = 0; i < 9 * mesh.points.size(); ++i) tensor.values.push_back(double(i % 9));
  mesh.fields.push_back(vector);
  mesh.fields.push_back(tensor);
  for (std::size_t i = 0; i < mesh.cells.size(); i += 17) {
    const auto t = static_cast<double>(i);
    EXPECT_EQ(select_scalar(mesh, "V:x").values[i], 3 * t);
    EXPECT_EQ(select_scalar(mesh, "V:y").values[i], -4 * t);
    EXPECT_EQ(select_scalar(mesh, "V:2").values[i], 12 * t);
    EXPECT_DOUBLE_EQ(select_scalar(mesh, "V").values[i], 13 * t);
    EXPECT_DOUBLE_EQ(select_scalar(mesh, "V:magnitude").values[i], 13 * t);
  }
  EXPECT_EQ(select_scalar(mesh, "V:x").location, Location::cell);
  EXPECT_EQ(select_scalar(mesh, "V:x").name, "V:x");
  EXPECT_EQ(select_scalar(mesh, "T:8").max, 8);
  EXPECT_DOUBLE_EQ(select_scalar(mesh, "T").max, std::sqrt(204.0));  // sum of squares below 9
  EXPECT_EQ(select_scalar(mesh, "s:x").min, -1);
  EXPECT_GT(select_scalar(mesh, "s:magnitude").min, 0);  // |s|, and no point has s = 0
  EXPECT_THROW((void)select_scalar(mesh, "V:3"), base::InputError);
  EXPECT_THROW((void)select_scalar(mesh, "V:-1"), base::InputError);
  EXPECT_THROW((void)select_scalar(mesh, "V:"), base::InputError);
  EXPECT_THROW((void)select_scalar(mesh, "V:1x"), base::InputError);
  EXPECT_THROW((void)select_scalar(mesh, "s:y"), base::InputError);
  EXPECT_NE(message_of(mesh, "V:w").find("x, y, z, magnitude"), std::string::npos);
}

TEST(SelectScalar, MagnitudeDoesNotOverflow) {
  TetMesh mesh = tests::unit_tetrahedron();
  mesh.fields = {Field{"V", Location::cell, 3, {1e200, 1e200, 1e200}},
                 Field{"W", Location::cell, 4, {1e200, 1e200, 1e200, 1e200}}};
  EXPECT_DOUBLE_EQ(select_scalar(mesh, "V").max, std::sqrt(3.0) * 1e200);
  EXPECT_DOUBLE_EQ(select_scalar(mesh, "W").max, 2e200);
}

TEST(SelectScalar, FindsNamesWithColonsAndAtSigns) {
  TetMesh mesh = tests::unit_tetrahedron();
  mesh.fields = {Field{"V", Location::point, 3, std::vector<double>(12, 1.0)},
                 Field{"V:x", Location::point, 1, std::vector<double>(4, 2.0)},
                 Field{"a:b", Location::point, 3, std::vector<double>(12, 3.0)},
                 Field{"q", Location::cell, 1, {4.0}},
                 Field{"q", Location::point, 1, std::vector<double>(4, 5.0)},
                 Field{"n@cell", Location::point, 1, std::vector<double>(4, 6.0)}};
  EXPECT_EQ(select_scalar(mesh, "V:x").max, 2);  // the field of that very name
  EXPECT_EQ(select_scalar(mesh, "V:0").max, 1);
  EXPECT_EQ(select_scalar(mesh, "a:b:y").max, 3);
  EXPECT_EQ(select_scalar(mesh, "q").max, 5);  // the point field comes first
  EXPECT_EQ(select_scalar(mesh, "q@cell").max, 4);
  EXPECT_EQ(select_scalar(mesh, "q@cell:0").max, 4);
  EXPECT_EQ(select_scalar(mesh, "q@point").max, 5);
  EXPECT_EQ(select_scalar(mesh, "n@cell").max, 6);
  EXPECT_THROW((void)select_scalar(mesh, "V@cell"), base::InputError);
}

TEST(SelectScalar, GeneratesCoordinatesAndRadius) {
  TetMesh mesh = brick();
  EXPECT_EQ(select_scalar(mesh, "z").min, 2);
  EXPECT_EQ(select_scalar(mesh, "z").max, 4);
  EXPECT_DOUBLE_EQ(select_scalar(mesh, "radius").max, Vector3d(1, 1.5, 1).norm());
  mesh.fields.push_back(
      Field{"x", Location::point, 1, std::vector<double>(mesh.points.size(), 9.0)});
  EXPECT_EQ(select_scalar(mesh, "x").max, 9);  // the mesh's own
}

TEST(SelectScalar, SuggestsTheNearestNames) {
  TetMesh mesh = brick();
  mesh.fields[0].name = "Temperature";
  EXPECT_NE(message_of(mesh, "temprature").find("did you mean 'Temperature'?"), std::string::npos);
  EXPECT_NE(message_of(mesh, "qq").find("there are: Temperature"), std::string::npos);
}

TEST(SelectScalar, RefusesAFieldOfTheWrongLength) {
  TetMesh mesh = brick();
  mesh.fields[0].values.pop_back();
  EXPECT_THROW((void)select_scalar(mesh, "s"), base::InputError);
}

TEST(FindDrawable, SortsOutFlatCellsAndThoseTouchingNan) {
  TetMesh mesh = brick();
  const std::size_t all = mesh.cells.size();
  const Vector3d a = mesh.points[mesh.cells[7][0]];
  const Vector3d b = mesh.points[mesh.cells[7][1]];
  mesh.points.emplace_back(0.5 * (a + b));  // on the line through a and b
  mesh.cells.push_back({mesh.cells[7][0], mesh.cells[7][1], mesh.cells[7][2],
                        static_cast<std::uint32_t>(mesh.points.size() - 1)});
  mesh.fields[0].values.push_back(0);
  Drawable drawable = find_drawable(mesh, select_scalar(mesh, "s"));
  ASSERT_EQ(drawable.cells.size(), all);
  for (std::uint32_t i = 0; i < all; ++i) ASSERT_EQ(drawable.cells[i], i);
  EXPECT_EQ(drawable.degenerate, 1U);
  EXPECT_EQ(drawable.nan, 0U);

  const std::uint32_t bad = mesh.cells[20][2];
  std::size_t touching = 0;
  for (const Cell& cell : mesh.cells) {
    for (const std::uint32_t v : cell) touching += v == bad ? 1 : 0;
  }
  mesh.fields[0].values[bad] = kNan;
  drawable = find_drawable(mesh, select_scalar(mesh, "s"));
  EXPECT_EQ(drawable.nan, touching);
  EXPECT_EQ(drawable.cells.size() + drawable.nan + drawable.degenerate, mesh.cells.size());
  for (const std::uint32_t cell : drawable.cells) {
    for (const std::uint32_t v : mesh.cells[cell]) EXPECT_NE(v, bad);
  }
  mesh.fields[0].values[bad] = 0;
  mesh.points[bad].y() = -kInfinity;
  EXPECT_EQ(find_drawable(mesh, select_scalar(mesh, "s")).nan, touching);
}

TEST(FindDrawable, LooksAtTheOwnValueOfACellField) {
  TetMesh mesh = brick();
  mesh.fields = {Field{"c", Location::cell, 1, std::vector<double>(mesh.cells.size(), 1.0)}};
  mesh.fields[0].values[5] = kNan;
  const Drawable drawable = find_drawable(mesh, select_scalar(mesh, "c"));
  EXPECT_EQ(drawable.nan, 1U);
  EXPECT_EQ(drawable.cells.size(), mesh.cells.size() - 1);
  EXPECT_EQ(drawable.cells[5], 6U);
}

TEST(FindDrawable, OfAnEmptyMeshIsEmpty) {
  const Drawable drawable = find_drawable(TetMesh{}, ScalarField{});
  EXPECT_TRUE(drawable.cells.empty());
  EXPECT_EQ(drawable.degenerate + drawable.nan, 0U);
}

}  // namespace
}  // namespace tetraglass::mesh
