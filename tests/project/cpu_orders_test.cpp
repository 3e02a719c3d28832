// The native projector with cells in an order of sort/, against its own exact order at every pixel.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "mesh/samples.h"
#include "project/compare.h"
#include "project/cpu/cpu_projector.h"
#include "tests/support/scenes.h"

namespace tetraglass::project {
namespace {

using tests::make_scene;

struct Drawn {
  Image image;
  Stats stats;
};

Drawn draw(const Scene& scene, SortMethod sort, std::optional<double> opaque_at = std::nullopt) {
  Request request;
  request.projector = Projector::cpu;
  request.sort = sort;
  request.opaque_at = opaque_at;
  Drawn result;
  result.image = render_cpu(scene, plan(scene, request), result.stats);
  return result;
}

std::vector<Camera> cameras(const mesh::Box& bounds) {
  const Camera outside = frame_camera(bounds, {1, 0.8, 0.6}, Eigen::Vector3d::UnitZ(), 30, 1);
  Camera parallel = outside;
  parallel.parallel = true;
  Camera inside = outside;
  inside.eye = bounds.center() + Eigen::Vector3d(0.07, 0.1, 0.13).cwiseProduct(bounds.sizes());
  inside.fov_degrees = 120;
  return {outside, parallel, inside};
}

/// Five peaks, nothing in between: most cells show nothing, and are left out of the order only
/// after they were sorted.
preint::TransferFunction peaks(const mesh::ScalarField& field, double extinction) {
  std::vector<preint::ControlPoint> points;
  for (int i = 0; i < 5; ++i) {
    const double t = 0.1 + 0.2 * i;
    const auto at = [&](double u) { return field.min + u * (field.max - field.min); };
    points.push_back({at(t - 0.02), preint::Color(t, 1 - t, 0.5), 0});
    points.push_back({at(t), preint::Color(t, 1, 0.5), extinction});
    points.push_back({at(t + 0.02), preint::Color(t, 1 - t, 1), 0});
  }
  return preint::TransferFunction(points);
}

// Sums of floats in another order of additions; rays that graze a cell.
constexpr double kLargest = 2e-5;

class CpuOrders : public testing::TestWithParam<std::string> {};

TEST_P(CpuOrders, ExactOrdersOfCellsGiveThePictureOfExactPixels) {
  const mesh::TetMesh mesh = mesh::make_sample(GetParam(), 20000);
  const mesh::ScalarField field = mesh::select_scalar(mesh, "");
  const double diagonal = mesh::bounds(mesh).diagonal().norm();
  std::vector<SortMethod> methods = {SortMethod::mpvo};
  if (GetParam() != "shells") methods.push_back(SortMethod::power);  // shells are not Delaunay
  for (const double extinction : {5.0, 300.0}) {
    for (const Camera& camera : cameras(mesh::bounds(mesh))) {
      Scene scene = make_scene(mesh, Mode::full, peaks(field, extinction / diagonal), 72);
      scene.camera = camera;
      const Drawn exact = draw(scene, SortMethod::fragments);
      EXPECT_GT(exact.stats.fragments, 10000U);
      for (const SortMethod method : methods) {
        const Drawn ordered = draw(scene, method);
        EXPECT_LE(compare(ordered.image, exact.image).max, kLargest) << to_string(method);
        EXPECT_EQ(ordered.stats.sort_method, to_string(method));
        EXPECT_TRUE(ordered.stats.sort_exact);
        EXPECT_GT(ordered.stats.sort_ms, 0);
      }
    }
  }
}

TEST_P(CpuOrders, OfTranslucentSurfaces) {
  const mesh::TetMesh mesh = mesh::make_sample(GetParam(), 20000);
  const mesh::ScalarField field = mesh::select_scalar(mesh, "");
  for (const Camera& camera : cameras(mesh::bounds(mesh))) {
    Scene scene = make_scene(mesh, Mode::iso, tests::constant_medium({1, 1, 1}, 1), 72);
    scene.camera = camera;
    for (const double t : {0.52, 0.5, 0.3, 0.8}) {  // close ones share cells; not ascending
      scene.isosurfaces.push_back({field.min + t * (field.max - field.min), {t, 1 - t, 0.5}, 0.4});
    }
    const Drawn exact = draw(scene, SortMethod::fragments);
    const Drawn ordered = draw(scene, SortMethod::mpvo);
    EXPECT_LE(compare(ordered.image, exact.image).max, kLargest);
  }
}

INSTANTIATE_TEST_SUITE_P(Samples, CpuOrders, testing::Values("sphere", "cavity", "shells"),
                         [](const auto& sample) { return sample.param; });

TEST(CpuOrder, RaysEndWhereTheyAreOpaque) {
  const mesh::TetMesh mesh = mesh::make_sample("sphere", 20000);
  const mesh::ScalarField field = mesh::select_scalar(mesh, "");
  const Scene scene = make_scene(
      mesh, Mode::full,
      preint::TransferFunction({{field.min, {1, 0, 0}, 20}, {field.max, {0, 1, 0}, 60}}), 96);
  const Drawn whole = draw(scene, SortMethod::mpvo, 1);
  const Drawn ended = draw(scene, SortMethod::mpvo, 0.9);
  EXPECT_LE(compare(ended.image, whole.image).max, 0.1 + 1e-6);
  EXPECT_LT(2 * ended.stats.fragments, whole.stats.fragments);
}

/// What an order cannot do is told, not hidden.
TEST(CpuOrder, CyclesAreTold) {
  const mesh::TetMesh mesh = mesh::make_sample("cycle");
  Scene scene = make_scene(mesh, Mode::full, preint::preset("viridis", 0, 1, 3));
  scene.camera = tests::down_z(2);
  const Drawn ordered = draw(scene, SortMethod::mpvo);
  EXPECT_FALSE(ordered.stats.sort_exact);
  EXPECT_GT(ordered.stats.cycles, 0U);
  EXPECT_FALSE(draw(scene, SortMethod::centroid).stats.sort_exact);
  EXPECT_TRUE(draw(scene, SortMethod::fragments).stats.sort_exact);
}

/// Cells in order need no delay lines.
TEST(CpuOrder, HoldsNoFragments) {
  const mesh::TetMesh mesh = mesh::make_sample("sphere", 20000);
  const mesh::ScalarField field = mesh::select_scalar(mesh, "");
  const Scene scene =
      make_scene(mesh, Mode::full, preint::preset("viridis", field.min, field.max, 2), 256);
  const auto bytes = [&](SortMethod sort) {
    return draw(scene, sort).stats.work.at(Effect::order).bytes;
  };
  EXPECT_EQ(bytes(SortMethod::mpvo), 3 * sizeof(std::uint32_t) * mesh.cells.size());
  EXPECT_GT(bytes(SortMethod::fragments), std::size_t{300000});  // 64 blocks, 16 records of each
}

}  // namespace
}  // namespace tetraglass::project
