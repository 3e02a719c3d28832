// Meshes that are hard to order and to go through: rings of cells that hide each other, overlaps,
// thousands of parts, ten thousand cells behind each other, none at all.
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "mesh/samples.h"
#include "tests/stability/drawing.h"
#include "tests/stability/hard_meshes.h"
#include "tests/support/scenes.h"

namespace tetraglass::tests {
namespace {

using project::Projector;
using project::Scene;

const std::string kReference =
    "reference, moved by the roundings; depths: of every face on the ray";

/// Every effect by every contender but the reference itself. gl without --sort fragments is exact
/// for parts that do not overlap only.
void expect_as_reference(Record& record, const mesh::TetMesh& mesh, const std::vector<View>& views,
                         bool overlaps = false) {
  for (const View& view : views) {
    for (const Effect& effect : effects()) {
      const Scene scene = effect_scene(mesh, effect, view);
      std::map<Projector, Bounded> references;
      for (Contender contender : exact_contenders(scene)) {
        if (contender.projector == Projector::reference) continue;
        if (overlaps && contender.projector == Projector::gl && !is_commutative(scene)) {
          contender.request.sort = project::SortMethod::fragments;
        }
        Bounded& exact = references[contender.projector];
        if (exact.image.rgba.empty()) {
          exact = by_reference(scene, roundings(scene, contender.projector));
        }
        const std::string detail =
            fmt::format("{}, {}, {}", view.name, effect.name, contender.name);
        const project::Image image = draw(scene, contender.request);
        if (effect.mode != project::Mode::emission) expect_sound(image, detail);
        record.expect_near(contender.way, detail, image, exact.image, exact.bound);
      }
    }
  }
}

/// Tetrahedra of any shape in cubes of this size at these corners, each with points of its own.
mesh::TetMesh scattered(const std::vector<Eigen::Vector3d>& corners, double size) {
  std::mt19937 random;  // the default seed
  const auto number = [&] { return static_cast<double>(random()) / 4294967296.0; };
  mesh::TetMesh mesh;
  for (const Eigen::Vector3d& corner : corners) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (int k = 0; k < 4; ++k) {
      mesh.points.emplace_back(corner + size * Eigen::Vector3d(number(), number(), number()));
    }
    mesh.cells.push_back({first, first + 1, first + 2, first + 3});
  }
  turn_positive(mesh);
  add_point_field(mesh, "s", linear_field);
  return mesh;
}

TEST(StabilityOfMeshes, Cycles) {
  const mesh::TetMesh mesh = mesh::make_sample("cycle");
  std::vector<View> views = outside_views(mesh::bounds(mesh));
  View along_z = views[1];
  along_z.name = "along z";
  along_z.camera =
      project::frame_camera(mesh::bounds(mesh), {0, 0, 1}, Eigen::Vector3d::UnitY(), 30, 1);
  along_z.camera.parallel = true;
  views.push_back(along_z);
  Record record("meshes", "cells that hide each other in rings", kReference);
  expect_as_reference(record, mesh, views);
}

TEST(StabilityOfMeshes, Overlaps) {
  const mesh::TetMesh mesh = scattered(std::vector<Eigen::Vector3d>(60, {0, 0, 0}), 1);
  Record record("meshes", "overlapping cells", kReference);
  expect_as_reference(record, mesh, outside_views(mesh::bounds(mesh)), true);
}

TEST(StabilityOfMeshes, ThousandsOfParts) {
  std::vector<Eigen::Vector3d> lattice;
  for (int i = 0; i < 15 * 15 * 15; ++i) lattice.emplace_back(i % 15, i / 15 % 15, i / 225);
  const mesh::TetMesh mesh = scattered(lattice, 0.9);
  Record record("meshes", "3375 parts", kReference);
  expect_as_reference(record, mesh, outside_views(mesh::bounds(mesh)), true);
}

// A row of boxes, seen along: the error may grow with the depth as its bound does, by two roundings
// a cell.
TEST(StabilityOfMeshes, Depth) {
  for (const int bricks : {34, 340, 3400}) {
    std::vector<double> planes;
    for (int i = 0; i <= bricks; ++i) planes.push_back(i * 1e-3);
    const HardMesh row = graded_box({std::vector<double>{-0.5, 0.5}, {-0.5, 0.5}, planes});
    const double length = planes.back();
    project::Camera camera;
    camera.eye = {0.03, 0.05, length + 2};
    camera.target = {0.02, -0.01, 0};
    camera.fov_degrees = 3;
    View perspective{"perspective", camera, 8, 8};
    View parallel = perspective;
    parallel.name = "parallel";
    parallel.camera.parallel = true;
    parallel.camera.ortho_height = 0.4;
    const double most = deepest(effect_scene(row.mesh, {"", project::Mode::thickness}, parallel));
    Record record("meshes", fmt::format("{:.0f} cells deep", most),
                  "closed form moved by the roundings; two roundings a cell");
    if (bricks == 3400) {
      EXPECT_GE(most, 1e4);
      expect_closed_forms(record, row.mesh, row.body, {perspective});
    } else {
      expect_closed_forms(record, row.mesh, row.body, {parallel, perspective});
    }
  }
}

TEST(StabilityOfMeshes, Empty) {
  Record record("meshes", "no cell that can be drawn", "an empty picture");
  mesh::TetMesh flat = unit_tetrahedron();
  flat.points[3] = {1, 1, 0};
  const mesh::TetMesh none{{}, {}, {mesh::Field{"s", mesh::Location::point, 1, {}}}};
  const View view{"", down_z(2)};
  for (const mesh::TetMesh* mesh : {&std::as_const(flat), &none}) {
    for (const Effect& effect : effects()) {
      const Scene scene = effect_scene(*mesh, effect, view);
      for (const Contender& contender : exact_contenders(scene)) {
        record.expect_near(contender.way, effect.name, draw(scene, contender.request),
                           project::Image(kPixels, kPixels), 0);
      }
    }
  }
}

}  // namespace
}  // namespace tetraglass::tests
