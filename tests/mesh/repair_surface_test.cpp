#include "mesh/repair_surface.h"

#include <array>
#include <cmath>
#include <random>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "base/errors.h"
#include "mesh/import.h"
#include "mesh/surface_diagnosis.h"
#include "mesh/triangle_surface.h"
#include "support/data.h"
#include "support/meshes.h"
#include "support/temporary_folder.h"

namespace tetraglass::mesh {
namespace {

#ifdef TETRAGLASS_WITH_CGAL

using Triangle = std::array<std::uint32_t, 3>;

/// A sphere of triangles, open at both poles.
MeshData sphere(std::uint32_t n) {
  MeshData data;
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < 2 * n; ++j) {
      const double polar = 3.141592653589793 * (i + 0.5) / n;
      const double turn = 3.141592653589793 * j / n;
      data.points.emplace_back(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn),
                               std::cos(polar));
    }
  }
  const std::uint32_t m = 2 * n;
  for (std::uint32_t i = 0; i + 1 < n; ++i) {
    for (std::uint32_t j = 0; j < m; ++j) {
      const std::uint32_t a = i * m + j;
      const std::uint32_t b = i * m + (j + 1) % m;
      data.add_cell(CellType::triangle, Triangle{a, a + m, b});
      data.add_cell(CellType::triangle, Triangle{b, a + m, b + m});
    }
  }
  return data;
}

SurfaceDiagnosis diagnosis_of(const MeshData& data) {
  std::vector<std::string> notes;
  return diagnose(collect_triangles(data, notes));
}

double volume_of(const MeshData& data) {
  std::vector<std::string> notes;
  return enclosed_volume(triangle_surface(data, notes));
}

std::string joined(const std::vector<std::string>& notes) {
  return fmt::format("{}", fmt::join(notes, "; "));
}

TEST(RepairSurface, ClosesHolesUpToTheLimitAndTellsThem) {
  const MeshData open = sphere(16);  // holes of radius sin(pi / 32) about each pole
  ASSERT_EQ(diagnosis_of(open).open_edges, 64U);
  std::vector<std::string> notes;
  const MeshData closed = repair_surface(open, 0.1, notes);
  EXPECT_EQ(diagnosis_of(closed).open_edges, 0U);
  EXPECT_NE(joined(notes).find("2 holes of 64 edges closed by 60 triangles"), std::string::npos)
      << joined(notes);
  EXPECT_EQ(closed.points.size(), open.points.size());
  EXPECT_NEAR(volume_of(closed), 4.0 / 3 * 3.14159265, 0.1);
  notes.clear();
  const MeshData left = repair_surface(open, 0.05, notes);
  EXPECT_EQ(diagnosis_of(left).open_edges, 64U);
  EXPECT_NE(joined(notes).find("2 holes are left open"), std::string::npos) << joined(notes);
}

TEST(RepairSurface, TurnsTrianglesUntilNeighboursAgreeAndInnerShellsAreCavities) {
  std::mt19937 random(7);
  MeshData data;
  tests::add_cube(data, {0, 0, 0}, 3);
  tests::add_cube(data, {1, 1, 1}, 1);
  for (std::size_t i = 0; i < data.cell_count(); ++i) {
    if (random() % 2 == 0) std::swap(data.connectivity[4 * i + 1], data.connectivity[4 * i + 3]);
  }
  ASSERT_GT(diagnosis_of(data).disagreeing_edges, 0U);
  std::vector<std::string> notes;
  const MeshData repaired = repair_surface(data, 0.1, notes);
  EXPECT_EQ(diagnosis_of(repaired).disagreeing_edges, 0U);
  EXPECT_NEAR(volume_of(repaired), 26, 1e-12);
  EXPECT_NE(joined(notes).find("triangles turned"), std::string::npos) << joined(notes);
}

TEST(RepairSurface, LeavesOutTrianglesThatAreThereTwiceOrHaveNoArea) {
  MeshData data;
  tests::add_cube(data, {0, 0, 0}, 1);
  std::vector<std::string> notes;
  MeshData triangles = repair_surface(data, 0.1, notes);
  EXPECT_EQ(joined(notes), "repair: nothing to do");
  // A triangle abc becomes amc and mbc, m in the middle of ab, and a flat one, abm, closes the
  // slit; mbc is there once more, the other way round.
  const Triangle abc = {triangles.connectivity[0], triangles.connectivity[1],
                        triangles.connectivity[2]};
  const auto m = static_cast<std::uint32_t>(triangles.points.size());
  triangles.points.emplace_back((triangles.points[abc[0]] + triangles.points[abc[1]]) / 2);
  triangles.connectivity[1] = m;
  triangles.add_cell(CellType::triangle, Triangle{m, abc[1], abc[2]});
  triangles.add_cell(CellType::triangle, Triangle{abc[0], abc[1], m});
  triangles.add_cell(CellType::triangle, Triangle{abc[1], m, abc[2]});
  ASSERT_EQ(diagnosis_of(triangles).faults.flat, 1U);
  ASSERT_EQ(diagnosis_of(triangles).crowded_edges, 3U);
  notes.clear();
  const MeshData repaired = repair_surface(triangles, 0.1, notes);
  const SurfaceDiagnosis found = diagnosis_of(repaired);
  EXPECT_EQ(found.faults.flat, 0U) << joined(notes);
  ASSERT_EQ(found.open_edges, 0U) << joined(notes);
  EXPECT_NEAR(volume_of(repaired), 1, 1e-15);
  EXPECT_NE(joined(notes).find("1 triangles that were there twice"), std::string::npos)
      << joined(notes);
  EXPECT_NE(joined(notes).find("triangles without area removed"), std::string::npos)
      << joined(notes);
}

TEST(RepairSurface, KeepsPointFieldsWithTheirPoints) {
  MeshData data = sphere(8);
  data.fields.push_back({"p", Location::point, 3, {}});
  for (const Eigen::Vector3d& p : data.points) {
    data.fields[0].values.insert(data.fields[0].values.end(), p.data(), p.data() + 3);
  }
  std::vector<std::string> notes;
  const MeshData repaired = repair_surface(data, 1, notes);
  ASSERT_EQ(repaired.fields.size(), 1U);
  ASSERT_EQ(repaired.fields[0].values.size(), 3 * repaired.points.size());
  for (std::size_t i = 0; i < repaired.points.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(repaired.fields[0].values[3 * i + k],
                repaired.points[i][static_cast<Eigen::Index>(k)]);
    }
  }
}

TEST(RepairSurface, TakesSurfacesOfNothing) {
  std::vector<std::string> notes;
  EXPECT_EQ(repair_surface({}, 0.1, notes).cell_count(), 0U);
  MeshData slit;
  slit.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  slit.add_cell(CellType::triangle, Triangle{0, 1, 2});
  slit.add_cell(CellType::triangle, Triangle{0, 2, 1});
  EXPECT_NO_THROW(static_cast<void>(repair_surface(slit, 1, notes)));
}

#ifdef TETRAGLASS_WITH_TETGEN

TEST(RepairSurface, WhatCannotBeMendedIsToldWithWhatWasDone) {
  const tests::TemporaryFolder folder;
  const std::string file = folder.file("box.off");
  tests::write_text(file,
                    "OFF\n8 5 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
                    "4 0 3 2 1\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n");
  const auto refusal = [&](const ImportOptions& options) -> std::string {
    try {
      static_cast<void>(import_mesh(file, options));
    } catch (const base::InputError& error) {
      return error.what();
    }
    return "";
  };
  ImportOptions options;
  EXPECT_NE(refusal(options).find("try --repair"), std::string::npos) << refusal(options);
  options.repair = true;
  EXPECT_NE(refusal(options).find("1 holes are left open, the largest 0.816"), std::string::npos)
      << refusal(options);
  options.largest_hole = 0.9;
  const Import import = import_mesh(file, options);
  double volume = 0;
  for (const Cell& cell : import.mesh.cells) volume += tests::volume(import.mesh, cell);
  EXPECT_NEAR(volume, 1, 1e-10);
}

/// Good surfaces are left as they are; bad ones are mended, or refused with what is wrong.
TEST(RepairSurface, RealSurfacesAreFilledOrDiagnosed) {
  SKIP_WITHOUT_DATA();
  struct Expected {
    const char* file;
    const char* text;  ///< of the notes, or of the refusal
  };
  ImportOptions options;
  options.repair = true;
  for (const Expected& e : std::initializer_list<Expected>{
           {"surfaces_bad/oblong-shuffled.off", "triangles turned"},
           {"surfaces_bad/boeing.off", "1477 points equal others"},
           {"surfaces_bad/cow.off", "intersects itself"},
           {"surfaces_bad/bones.off", "4204 triangles in 26 parts"},
           {"surfaces_bad/ALSTOM_TEST4.off", "231 of its 3165 edges"},
           {"surfaces_bad/blobby_3cc.off", "219 of its 5235 edges"},
           {"surfaces_bad/beetle.obj", "edges have one triangle only"},
           {"surfaces_bad/tetra_intersected_by_triangle.off", "1 pairs of triangles"},
           {"surfaces_bad/degtri_sliding.off", "4 triangles without area removed"},
           {"surfaces_bad/quads_to_stitch.off", "12 of its 30 edges"},
           {"surfaces_bad/pig.stl", "1296 of its"}}) {
    std::string told;
    try {
      const Import import = import_mesh((tests::data_folder() / e.file).string(), options);
      told = joined(import.report.notes);
      EXPECT_GT(import.mesh.cells.size(), 1000U) << e.file;
    } catch (const base::InputError& error) {
      told = error.what();
    }
    EXPECT_NE(told.find(e.text), std::string::npos) << e.file << ": " << told;
  }
}

#endif

#else

TEST(RepairSurface, SaysThatThisBuildCannot) {
  std::vector<std::string> notes;
  EXPECT_THROW(static_cast<void>(repair_surface({}, 0.1, notes)), base::UnavailableError);
}

#endif

}  // namespace
}  // namespace tetraglass::mesh
