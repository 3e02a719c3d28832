// What must not change a picture: how the mesh is cut, numbered and turned, cells that show
// nothing, where the picture is cut.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/stability/drawing.h"
#include "tests/stability/hard_meshes.h"
#include "tests/support/scenes.h"

namespace tetraglass::tests {
namespace {

using project::Image;
using project::Mode;
using project::Scene;

const std::string kOrigin =
    "both pictures as near to the reference, moved by the roundings, as that allows";

/// A box with a field that is linear in its cells only.
mesh::TetMesh curved() {
  return box({-1, -0.7, -0.9}, {1, 0.8, 1.1}, 3, 3, 3, [](const Eigen::Vector3d& p) {
    return std::sin(2 * p.x()) * std::cos(3 * p.y()) + 0.4 * p.z();
  });
}

/// The picture of `changed` beside that of `scene`, which must be the same: by every contender, for
/// every effect and view. `recut`: gradients at the vertices, means over the cells around them, are
/// others.
void expect_same(Record& record, const mesh::TetMesh& mesh,
                 const std::function<Scene(const Scene&)>& changed, bool recut = false) {
  for (const View& view : outside_views(mesh::bounds(mesh))) {
    for (const Effect& effect : effects()) {
      Scene scene = effect_scene(mesh, effect, view);
      if (recut && scene.shading == project::Shading::smooth) {
        scene.shading = project::Shading::none;
      }
      const Scene other = changed(scene);
      std::map<project::Projector, Image> bounds;
      for (const Contender& contender : exact_contenders(scene)) {
        Image& bound = bounds[contender.projector];
        if (bound.rgba.empty()) {
          bound = by_reference(other, roundings(other, contender.projector, 0x1p-50)).bound;
          for (float& value : bound.rgba) value *= 2;
        }
        const std::string detail =
            fmt::format("{}, {}, {}", view.name, effect.name, contender.name);
        record.expect_near(contender.way, detail, draw(other, contender.request),
                           draw(scene, contender.request), bound);
      }
    }
  }
}

/// The same scene of another mesh that has its points, perhaps more, and a field of the same range.
Scene with_mesh(const Scene& scene, const mesh::TetMesh& mesh) {
  Scene result = scene;
  result.mesh = &mesh;
  result.field = mesh::select_scalar(mesh, "");
  result.drawable = mesh::find_drawable(mesh, result.field);
  return result;
}

std::uint32_t add_mean(mesh::TetMesh& mesh, const std::vector<std::uint32_t>& of) {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double value = 0;
  for (const std::uint32_t i : of) {
    point += mesh.points[i] / static_cast<double>(of.size());
    value += mesh.fields[0].values[i] / static_cast<double>(of.size());
  }
  mesh.points.push_back(point);
  mesh.fields[0].values.push_back(value);
  return static_cast<std::uint32_t>(mesh.points.size() - 1);
}

// 1 to 4: by the centroid.
TEST(StabilityProperties, CellsCutInFour) {
  const mesh::TetMesh mesh = curved();
  mesh::TetMesh fine = mesh;
  fine.cells.clear();
  for (const mesh::Cell& cell : mesh.cells) {
    const std::uint32_t middle = add_mean(fine, {cell[0], cell[1], cell[2], cell[3]});
    for (std::size_t i = 0; i < 4; ++i) {
      mesh::Cell part = cell;
      part[i] = middle;
      fine.cells.push_back(part);
    }
  }
  Record record("properties", "cells cut in four", kOrigin);
  expect_same(
      record, mesh, [&](const Scene& scene) { return with_mesh(scene, fine); }, true);
}

// 1 to 8: by the middles of the edges, which neighbours share.
TEST(StabilityProperties, CellsCutInEight) {
  const mesh::TetMesh mesh = curved();
  mesh::TetMesh fine = mesh;
  fine.cells.clear();
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto key = std::minmax(a, b);
    const auto found = middles.find(key);
    if (found != middles.end()) return found->second;
    return middles[key] = add_mean(fine, {a, b});
  };
  for (const mesh::Cell& c : mesh.cells) {
    std::array<std::array<std::uint32_t, 4>, 4> m{};
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) m[i][j] = i == j ? c[i] : middle(c[i], c[j]);
    }
    for (std::size_t i = 0; i < 4; ++i) fine.cells.push_back({m[0][i], m[1][i], m[2][i], m[3][i]});
    // The octahedron in the middle, around its diagonal 01 - 23.
    const std::array<std::uint32_t, 4> ring = {m[0][2], m[1][2], m[1][3], m[0][3]};
    for (std::size_t i = 0; i < 4; ++i) {
      fine.cells.push_back({m[0][1], m[2][3], ring[i], ring[(i + 1) % 4]});
    }
  }
  turn_positive(fine);
  Record record("properties", "cells cut in eight", kOrigin);
  expect_same(
      record, mesh, [&](const Scene& scene) { return with_mesh(scene, fine); }, true);
}

TEST(StabilityProperties, MeshAndCameraTurned) {
  const mesh::TetMesh mesh = curved();
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.234, Eigen::Vector3d(0.3, -0.8, 0.5).normalized()).toRotationMatrix();
  mesh::TetMesh turned = mesh;
  for (Eigen::Vector3d& p : turned.points) p = turn * p;
  Record record("properties", "mesh and camera turned", kOrigin);
  expect_same(record, mesh, [&](const Scene& scene) {
    Scene result = with_mesh(scene, turned);
    for (Eigen::Vector3d* v : {&result.camera.eye, &result.camera.target, &result.camera.up}) {
      *v = turn * *v;
    }
    return result;
  });
}

TEST(StabilityProperties, CellsAndPointsPermuted) {
  const mesh::TetMesh mesh = curved();
  std::mt19937 random;  // the default seed
  const auto shuffle = [&](auto& list) {
    for (std::size_t i = list.size(); i > 1; --i) std::swap(list[i - 1], list[random() % i]);
  };
  std::vector<std::uint32_t> place(mesh.points.size());
  for (std::uint32_t i = 0; i < place.size(); ++i) place[i] = i;
  shuffle(place);
  mesh::TetMesh other = mesh;
  for (std::size_t i = 0; i < place.size(); ++i) {
    other.points[place[i]] = mesh.points[i];
    other.fields[0].values[place[i]] = mesh.fields[0].values[i];
  }
  for (mesh::Cell& cell : other.cells) {
    for (std::uint32_t& vertex : cell) vertex = place[vertex];
    shuffle(cell);
  }
  turn_positive(other);
  shuffle(other.cells);
  Record record("properties", "cells and points permuted", kOrigin);
  expect_same(record, mesh, [&](const Scene& scene) { return with_mesh(scene, other); });
}

// In front of, behind and in the mesh, of a value whose extinction is 0.
TEST(StabilityProperties, TransparentCellsAdded) {
  const mesh::TetMesh mesh = curved();
  mesh::TetMesh other = mesh;
  const double clear = mesh::select_scalar(mesh, "").max;
  std::mt19937 random;  // the default seed
  for (int i = 0; i < 40; ++i) {
    const auto first = static_cast<std::uint32_t>(other.points.size());
    for (int k = 0; k < 4; ++k) {
      Eigen::Vector3d p;
      for (int axis = 0; axis < 3; ++axis) {
        // Within the bounds: floats are of the half diagonal.
        const double t = static_cast<double>(random()) / 4294967296.0;
        p[axis] = mesh.points.front()[axis] * (1 - t) + mesh.points.back()[axis] * t;
      }
      other.points.push_back(p);
      other.fields[0].values.push_back(clear);
    }
    other.cells.push_back({first, first + 1, first + 2, first + 3});
  }
  turn_positive(other);
  const auto with_clear_value = [&](Scene scene) {
    // A jump just below the largest value, which only vertices have.
    std::vector<preint::ControlPoint> points = scene.transfer_function.points();
    points.back().value = clear - 1e-3;
    points.push_back({clear - 1e-3, {1, 1, 1}, 0});
    scene.transfer_function = preint::TransferFunction(points);
    return scene;
  };
  Record record("properties", "transparent cells added", kOrigin);
  for (const View& view : outside_views(mesh::bounds(mesh))) {
    for (const Effect& effect : effects()) {
      const bool sees_medium = effect.mode == Mode::full || effect.mode == Mode::emission ||
                               effect.mode == Mode::absorption || effect.mode == Mode::iso;
      if (!sees_medium) continue;
      const Scene scene = with_clear_value(effect_scene(mesh, effect, view));
      const Scene more = with_mesh(scene, other);
      for (const Contender& contender : exact_contenders(scene)) {
        // The order of the centroids is exact no more where cells overlap, whatever they show.
        const Bounded exact = by_reference(scene, roundings(scene, contender.projector));
        const std::string detail =
            fmt::format("{}, {}, {}", view.name, effect.name, contender.name);
        record.expect_near(contender.way, detail, draw(more, contender.request), exact.image,
                           exact.bound);
      }
    }
  }
}

// Two halves of a picture are the whole.
TEST(StabilityProperties, HalvesOfThePicture) {
  const mesh::TetMesh mesh = curved();
  Record record("properties", "picture drawn in two halves", kOrigin);
  for (const View& view : outside_views(mesh::bounds(mesh))) {
    for (const Effect& effect : effects()) {
      const Scene scene = effect_scene(mesh, effect, view);
      std::map<project::Projector, Image> bounds;
      for (const Contender& contender : exact_contenders(scene)) {
        Image& bound = bounds[contender.projector];
        if (bound.rgba.empty()) {
          bound = by_reference(scene, roundings(scene, contender.projector)).bound;
          for (float& value : bound.rgba) value *= 2;
        }
        Image both(kPixels, kPixels);
        for (const int x : {0, 11}) {
          Scene half = scene;
          half.region = project::Region{x, 0, x == 0 ? 11 : kPixels - 11, kPixels};
          const Image part = draw(half, contender.request);
          for (int y = 0; y < part.height; ++y) {
            std::copy_n(part.pixel(0, y), 4 * part.width, both.pixel(x, y));
          }
        }
        const std::string detail =
            fmt::format("{}, {}, {}", view.name, effect.name, contender.name);
        record.expect_near(contender.way, detail, both, draw(scene, contender.request), bound);
      }
    }
  }
}

}  // namespace
}  // namespace tetraglass::tests
