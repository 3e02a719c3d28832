#include "mesh/mesh_volume.h"

#include <cmath>
#include <map>
#include <numbers>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "mesh/check.h"
#include "mesh/volume.h"
#include "support/meshes.h"

namespace tetraglass::mesh {
namespace {

#ifdef TETRAGLASS_WITH_CGAL

/// A cube of n^3 values over [-1, 1]^3.
MeshData image(std::size_t n, const tests::FieldFunction& f) {
  Volume volume;
  volume.size = {n, n, n};
  volume.origin = Eigen::Vector3d(-1, -1, -1);
  volume.axes = Eigen::Matrix3d::Identity() * (2.0 / double(n - 1));
  for (std::size_t i = 0; i < volume.points(); ++i) {
    volume.values.push_back(
        f(volume.origin +
          volume.axes * Eigen::Vector3d(double(i % n), double(i / n % n), double(i / (n * n)))));
  }
  return volume_mesh(volume);
}

std::map<double, double> volumes_by_region(const TetMesh& mesh) {
  const auto region = std::ranges::find(mesh.fields, "region", &Field::name);
  std::map<double, double> volumes;
  for (std::size_t i = 0; i < mesh.cells.size(); ++i) {
    const double label = region == mesh.fields.end() ? 0 : region->values[i];
    const double volume = tests::volume(mesh, mesh.cells[i]);
    EXPECT_GT(volume, 0);
    volumes[label] += volume;
  }
  return volumes;
}

double ball(double radius) {
  return 4.0 / 3 * std::numbers::pi * radius * radius * radius;
}

TEST(MeshVolume, GreyImagesAreMeshedFromTheirLevelUpAndCarryTheirValues) {
  const MeshData data = image(24, [](const Eigen::Vector3d& p) { return 1 - p.norm(); });
  VolumeRegions regions;
  regions.level = 0.4;  // the ball of radius 0.6
  FillOptions options;
  options.cells = 2000;
  std::vector<std::string> notes;
  const TetMesh mesh = mesh_volume(data, regions, notes, options);
  EXPECT_GT(mesh.cells.size(), 800U);
  EXPECT_LT(mesh.cells.size(), 5000U);
  EXPECT_NEAR(volumes_by_region(mesh)[0], ball(0.6), 0.05 * ball(0.6));
  ASSERT_EQ(mesh.fields.size(), 1U);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    // Linear interpolation of |p| is off by up to its curvature, most at the origin.
    EXPECT_NEAR(mesh.fields[0].values[i], 1 - mesh.points[i].norm(), 0.08);
  }
  EXPECT_EQ(check(mesh).crowded_faces, 0U);
}

TEST(MeshVolume, EveryLabelBecomesARegionAndNoPieceIsForgotten) {
  const MeshData data = image(30, [](const Eigen::Vector3d& p) {
    if ((p - Eigen::Vector3d(0.8, 0.8, 0.8)).norm() < 0.12) return 7.0;  // a small one, far away
    if (p.norm() > 0.6) return 0.0;
    return p.x() < 0 ? 1.0 : 2.0;
  });
  VolumeRegions regions;
  regions.labels = true;
  FillOptions options;
  options.cells = 3000;
  std::vector<std::string> notes;
  const TetMesh mesh = mesh_volume(data, regions, notes, options);
  std::map<double, double> volumes = volumes_by_region(mesh);
  ASSERT_EQ(volumes.size(), 3U);
  EXPECT_NEAR(volumes[1], ball(0.6) / 2, 0.08 * ball(0.6));
  EXPECT_NEAR(volumes[2], ball(0.6) / 2, 0.08 * ball(0.6));
  EXPECT_GT(volumes[7], 0.3 * ball(0.12));
  EXPECT_EQ(check(mesh).parts, 2U);
}

TEST(MeshVolume, WrongImagesAreRefused) {
  std::vector<std::string> notes;
  VolumeRegions regions;
  const auto refused = [&](const MeshData& data) {
    EXPECT_THROW(static_cast<void>(mesh_volume(data, regions, notes)), base::InputError);
  };
  const MeshData grey = image(4, [](const Eigen::Vector3d& p) { return p.x(); });
  refused(grey);  // neither labels nor a level
  regions.level = 99;
  refused(grey);  // nothing so high
  regions.level.reset();
  regions.labels = true;
  refused(grey);  // no whole numbers
  refused(image(4, [](const auto&) { return 0.0; }));
  refused(image(4, [](const auto&) { return NAN; }));
  MeshData surface;
  tests::add_cube(surface, {0, 0, 0}, 1);
  refused(surface);
}

#else

TEST(MeshVolume, SaysThatThisBuildCannot) {
  std::vector<std::string> notes;
  EXPECT_THROW(static_cast<void>(mesh_volume({}, {}, notes)), base::UnavailableError);
}

#endif

}  // namespace
}  // namespace tetraglass::mesh
