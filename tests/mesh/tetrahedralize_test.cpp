#include "mesh/tetrahedralize.h"

#include <array>
#include <random>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "mesh/adjacency.h"
#include "mesh/check.h"
#include "mesh/predicates.h"
#include "mesh/self_intersection.h"
#include "mesh/triangle_surface.h"
#include "support/meshes.h"
#include "support/total_volume.h"

namespace tetraglass::mesh {
namespace {

using Eigen::Vector3d;

using tests::add_cube;
using tests::total_volume;

[[maybe_unused]] std::string refusal(const MeshData& data) {
  std::vector<std::string> notes;
  try {
    static_cast<void>(fill_surface(data, notes));
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "";
}

#ifdef TETRAGLASS_WITH_TETGEN

TEST(FillSurface, FillsACubeWithPositiveTetrahedra) {
  MeshData data;
  add_cube(data, {0, 0, 0}, 2);
  std::vector<std::string> notes;
  const TetMesh mesh = fill_surface(data, notes);
  EXPECT_NEAR(total_volume(mesh), 8, 1e-10);
  for (const Cell& c : mesh.cells) {
    ASSERT_GT(
        orientation(mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]], mesh.points[c[3]]), 0);
  }
  // Enough to see the inside, few enough to draw.
  EXPECT_GT(mesh.cells.size(), 50'000U);
  EXPECT_LT(mesh.cells.size(), 200'000U);
  EXPECT_EQ(check(mesh).parts, 1U);
}

TEST(FillSurface, DoesNotDependOnTheUnit) {
  MeshData small;
  add_cube(small, {0, 0, 0}, 1e-9);
  MeshData large;
  add_cube(large, {0, 0, 0}, 1e9);
  std::vector<std::string> notes;
  EXPECT_NEAR(total_volume(fill_surface(small, notes)), 1e-27, 1e-37);
  EXPECT_NEAR(total_volume(fill_surface(large, notes)), 1e27, 1e17);
}

TEST(FillSurface, AShellTurnedInwardsIsACavityAndOneTurnedOutwardsIsNot) {
  std::vector<std::string> notes;
  MeshData cavity;
  add_cube(cavity, {0, 0, 0}, 3);
  add_cube(cavity, {1, 1, 1}, 1, false);
  EXPECT_NEAR(total_volume(fill_surface(cavity, notes)), 26, 1e-9);
  MeshData inside_out;
  add_cube(inside_out, {0, 0, 0}, 3, false);
  add_cube(inside_out, {1, 1, 1}, 1, true);
  EXPECT_NEAR(total_volume(fill_surface(inside_out, notes)), 26, 1e-9);
  MeshData inclusion;
  add_cube(inclusion, {0, 0, 0}, 3);
  add_cube(inclusion, {1, 1, 1}, 1);
  EXPECT_NEAR(total_volume(fill_surface(inclusion, notes)), 27, 1e-9);
  MeshData apart;
  add_cube(apart, {0, 0, 0}, 1);
  add_cube(apart, {5, 0, 0}, 2);
  EXPECT_NEAR(total_volume(fill_surface(apart, notes)), 9, 1e-9);
}

TEST(FillSurface, WhereDirectionsDisagreeTheInnerShellIsACavity) {
  MeshData data;
  add_cube(data, {0, 0, 0}, 3);
  add_cube(data, {1, 1, 1}, 1);
  std::swap(data.connectivity[1], data.connectivity[3]);  // one square turned over
  std::vector<std::string> notes;
  EXPECT_NEAR(total_volume(fill_surface(data, notes)), 26, 1e-9);
}

TEST(FillSurface, JoinsPointsThatAreEqual) {
  MeshData data;
  add_cube(data, {0, 0, 0}, 1);
  MeshData soup;
  for (std::size_t i = 0; i < data.cell_count(); ++i) {
    std::array<std::uint32_t, 4> face{};
    for (std::size_t k = 0; k < 4; ++k) {
      face[k] = static_cast<std::uint32_t>(soup.points.size());
      soup.points.push_back(data.points[data.cell(i)[k]]);
    }
    soup.add_cell(CellType::quad, face);
  }
  std::vector<std::string> notes;
  EXPECT_NEAR(total_volume(fill_surface(soup, notes)), 1, 1e-10);
}

/// The cells' largest and smallest volume.
std::pair<double, double> volume_range(const TetMesh& mesh) {
  std::pair<double, double> range = {1e300, 0};
  for (const Cell& cell : mesh.cells) {
    range.first = std::min(range.first, tests::volume(mesh, cell));
    range.second = std::max(range.second, tests::volume(mesh, cell));
  }
  return range;
}

TEST(FillSurface, KeepsToTheLargestVolumeAndTheQuality) {
  MeshData data;
  add_cube(data, {0, 0, 0}, 1);
  std::vector<std::string> notes;
  FillOptions options;
  options.max_volume = 1e-3;
  options.radius_edge_ratio = 1.4;
  options.min_dihedral = 14;
  const TetMesh mesh = fill_surface(data, notes, options);
  EXPECT_NEAR(total_volume(mesh), 1, 1e-12);
  EXPECT_LE(volume_range(mesh).second, 1e-3);
  EXPECT_GT(check(mesh).min_dihedral_degrees, 13);
  options.max_volume = 1e-12;
  EXPECT_THROW(static_cast<void>(fill_surface(data, notes, options)), base::InputError);
}

TEST(FillSurface, KeepsTheSurfaceWhereAskedTo) {
  MeshData data;
  add_cube(data, {0, 0, 0}, 1);
  std::vector<std::string> notes;
  FillOptions options;
  options.keep_surface = true;
  options.max_volume = 0.01;
  const TetMesh mesh = fill_surface(data, notes, options);
  EXPECT_EQ(check(mesh).boundary_faces, 12U);
  EXPECT_NEAR(total_volume(mesh), 1, 1e-12);
  EXPECT_GT(mesh.points.size(), 8U);
}

TEST(FillSurface, LeavesRegionsOfHolesEmpty) {
  MeshData data;
  add_cube(data, {0, 0, 0}, 3);
  add_cube(data, {1, 1, 1}, 1);  // turned outwards: a part of the solid
  std::vector<std::string> notes;
  FillOptions options;
  options.cells = 1000;
  const TetMesh both = fill_surface(data, notes, options);
  ASSERT_EQ(both.fields.size(), 1U);
  EXPECT_EQ(both.fields[0].name, "region");
  double inner = 0;
  for (std::size_t i = 0; i < both.cells.size(); ++i) {
    Vector3d center = Vector3d::Zero();
    for (const std::uint32_t p : both.cells[i]) center += both.points[p] / 4;
    const bool within = ((center - Vector3d(1.5, 1.5, 1.5)).cwiseAbs().array() < 0.5).all();
    if (within) inner += tests::volume(both, both.cells[i]);
  }
  EXPECT_NEAR(inner, 1, 1e-12);
  options.holes = {{1.5, 1.5, 1.5}};
  EXPECT_NEAR(total_volume(fill_surface(data, notes, options)), 26, 1e-10);
  options.holes = {{0.1, 0.1, 0.1}};
  EXPECT_NEAR(total_volume(fill_surface(data, notes, options)), 1, 1e-10);
  options.holes = {{9, 9, 9}};
  EXPECT_THROW(static_cast<void>(fill_surface(data, notes, options)), base::InputError);
}

// Two boxes that share a wall: its edges have three triangles.
TEST(FillSurface, WallsWithinMakeRegions) {
  MeshData data;
  add_cube(data, {0, 0, 0}, 1);
  add_cube(data, {1, 0, 0}, 1);
  data.types.erase(data.types.begin() + 10);  // the square x = 1 is there already
  data.connectivity.erase(data.connectivity.begin() + 40, data.connectivity.begin() + 44);
  data.offsets.pop_back();
  std::vector<std::string> notes;
  FillOptions options;
  options.cells = 1000;
  const TetMesh mesh = fill_surface(data, notes, options);
  EXPECT_NEAR(total_volume(mesh), 2, 1e-12);
  EXPECT_GT(mesh.cells.size(), 500U);
  ASSERT_EQ(mesh.fields.size(), 1U);
  for (std::size_t i = 0; i < mesh.cells.size(); ++i) {
    double x = 0;
    for (const std::uint32_t p : mesh.cells[i]) x += mesh.points[p].x() / 4;
    EXPECT_EQ(
        mesh.fields[0].values[i] == mesh.fields[0].values[0],
        (x < 1) == (mesh.points[mesh.cells[0][0]].x() + mesh.points[mesh.cells[0][1]].x() +
                        mesh.points[mesh.cells[0][2]].x() + mesh.points[mesh.cells[0][3]].x() <
                    4));
  }
}

#else

TEST(FillSurface, SaysThatThisBuildCannot) {
  MeshData data;
  add_cube(data, {0, 0, 0}, 2);
  std::vector<std::string> notes;
  EXPECT_THROW(static_cast<void>(fill_surface(data, notes)), base::UnavailableError);
}

#endif

#ifdef TETRAGLASS_WITH_TETGEN

TEST(FillSurface, RefusesOpenSurfacesWithTheNumberOfEdges) {
  MeshData data;
  add_cube(data, {0, 0, 0}, 1);
  data.types.pop_back();
  data.offsets.pop_back();
  data.connectivity.resize(data.offsets.back());
  EXPECT_NE(refusal(data).find("not closed: 4 of its 17 edges"), std::string::npos);
}

TEST(FillSurface, RefusesSurfacesThatIntersectThemselves) {
  MeshData crossing;
  add_cube(crossing, {0, 0, 0}, 2);
  add_cube(crossing, {1, 1, 1}, 2);
  EXPECT_NE(refusal(crossing).find("intersects itself"), std::string::npos);
  MeshData doubled;
  add_cube(doubled, {0, 0, 0}, 2);
  add_cube(doubled, {0, 0, 0}, 2);
  EXPECT_NE(refusal(doubled).find("intersects itself"), std::string::npos);
}

TEST(FillSurface, RefusesSurfacesWithoutVolume) {
  MeshData flat;
  flat.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  flat.add_cell(CellType::triangle, std::array<std::uint32_t, 3>{0, 1, 2});
  flat.add_cell(CellType::triangle, std::array<std::uint32_t, 3>{0, 2, 1});
  EXPECT_NE(refusal(flat), "");
}

#endif

TEST(FindFaults, CountsPairsThatMeetElsewhereThanInSharedCorners) {
  const auto pairs = [](std::vector<Vector3d> points,
                        std::vector<std::array<std::uint32_t, 3>> triangles) {
    TriangleSurface surface;
    surface.points = std::move(points);
    surface.triangles = std::move(triangles);
    const SurfaceFaults faults = find_faults(surface);
    EXPECT_EQ(faults.flat, 0U);
    return faults.crossings;
  };
  const std::vector<Vector3d> points = {{0, 0, 0},   {2, 0, 0}, {0, 2, 0}, {.5, .5, -1},
                                        {.5, .5, 1}, {5, 5, 1}, {2, 2, 0}, {1, 1, 0}};
  EXPECT_EQ(pairs(points, {{0, 1, 2}, {3, 4, 5}}), 1U);  // pierced
  EXPECT_EQ(pairs(points, {{0, 1, 2}, {3, 5, 6}}), 0U);
  EXPECT_EQ(pairs(points, {{0, 1, 2}, {1, 6, 2}}), 0U);  // neighbours in one plane
  EXPECT_EQ(pairs(points, {{0, 1, 2}, {1, 2, 3}}), 0U);  // neighbours at an angle
  EXPECT_EQ(pairs({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {1, 1, 0}}, {{0, 1, 2}, {0, 1, 3}}), 1U);
  EXPECT_EQ(pairs({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {1, 1, 0}, {1, .5, 0}}, {{0, 1, 2}, {0, 3, 4}}),
            1U);  // in one plane, one corner shared
  EXPECT_EQ(pairs({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {1, 1, 1}, {1, 1, -1}}, {{0, 1, 2}, {0, 3, 4}}),
            1U);  // through a shared corner
  EXPECT_EQ(
      pairs({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {-1, -1, 1}, {-1, -1, -1}}, {{0, 1, 2}, {0, 3, 4}}),
      0U);
  EXPECT_EQ(pairs(points, {{0, 1, 2}, {2, 1, 0}}), 1U);  // the same twice
}

TEST(FindFaults, FindsTrianglesWithoutArea) {
  TriangleSurface surface;
  surface.points = {{0, 0, 0}, {1, 1, 1}, {3, 3, 3}};
  surface.triangles = {{0, 1, 2}};
  EXPECT_EQ(find_faults(surface).flat, 1U);
}

#ifdef TETRAGLASS_WITH_CGAL

TEST(Delaunay, FillsTheHullOfThePoints) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> inside(0, 1);
  MeshData data;
  for (int i = 0; i < 8; ++i) data.points.emplace_back(i % 2, i / 2 % 2, i / 4);
  for (int i = 0; i < 500; ++i) {
    data.points.emplace_back(inside(random), inside(random), inside(random));
  }
  data.points.push_back(data.points[3]);  // doubled
  data.fields.push_back({"x", Location::point, 1, {}});
  for (const Vector3d& p : data.points) data.fields[0].values.push_back(p.x());
  data.fields[0].values.back() = 77;
  std::vector<std::string> notes;
  const TetMesh mesh = delaunay(data, notes);
  ASSERT_EQ(mesh.points.size(), 508U);
  EXPECT_NEAR(total_volume(mesh), 1, 1e-12);
  const Soundness soundness = check(mesh);
  EXPECT_TRUE(soundness.convex);
  EXPECT_TRUE(soundness.delaunay);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    EXPECT_EQ(mesh.fields[0].values[i], mesh.points[i].x());  // of equal points the first
  }
}

TEST(Delaunay, RefusesPointsWithoutVolume) {
  std::vector<std::string> notes;
  MeshData data;
  data.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_THROW(static_cast<void>(delaunay(data, notes)), base::InputError);
  data.points.emplace_back(1, 1, 0);
  data.points.emplace_back(3, 7, 0);
  EXPECT_THROW(static_cast<void>(delaunay(data, notes)), base::InputError);
  data.points.emplace_back(0, 0, std::numeric_limits<double>::infinity());
  EXPECT_THROW(static_cast<void>(delaunay(data, notes)), base::InputError);
}

#else

TEST(Delaunay, SaysThatThisBuildCannot) {
  std::vector<std::string> notes;
  EXPECT_THROW(static_cast<void>(delaunay({}, notes)), base::UnavailableError);
}

#endif

#ifdef TETRAGLASS_WITH_CGAL

TEST(RemeshSurface, FillsACubeWithACavityAndKeepsItsEdges) {
  MeshData data;
  add_cube(data, {0, 0, 0}, 3);
  add_cube(data, {1, 1, 1}, 1, false);
  std::vector<std::string> notes;
  FillOptions options;
  options.cells = 2000;
  const TetMesh mesh = remesh_surface(data, notes, options);
  EXPECT_NEAR(total_volume(mesh), 26, 0.05);
  EXPECT_GT(mesh.cells.size(), 1000U);
  EXPECT_LT(mesh.cells.size(), 6000U);
  EXPECT_EQ(check(mesh).degenerate, 0U);
  for (const Vector3d& corner : {Vector3d(0, 0, 0), Vector3d(3, 3, 3), Vector3d(1, 1, 2)}) {
    EXPECT_NE(std::ranges::find(mesh.points, corner), mesh.points.end());
  }
  options = {};
  options.max_volume = 0.05;
  const TetMesh fine = remesh_surface(data, notes, options);
  for (const Cell& cell : fine.cells) {
    ASSERT_GT(tests::volume(fine, cell), 0);
    ASSERT_LE(tests::volume(fine, cell), 1.4 * 0.05);
  }
}

TEST(RemeshSurface, RefusesWhatTetGenAloneCanDo) {
  MeshData data;
  add_cube(data, {0, 0, 0}, 3);
  std::vector<std::string> notes;
  FillOptions options;
  options.keep_surface = true;
  EXPECT_THROW(static_cast<void>(remesh_surface(data, notes, options)), base::InputError);
  data.types.pop_back();
  data.offsets.pop_back();
  EXPECT_THROW(static_cast<void>(remesh_surface(data, notes)), base::InputError);
}

#endif

}  // namespace
}  // namespace tetraglass::mesh
