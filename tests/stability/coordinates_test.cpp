// Coordinates that are hard to compute with: far from the origin, tiny and huge, of other units in
// one direction than in another.
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/stability/drawing.h"
#include "tests/stability/hard_meshes.h"

namespace tetraglass::tests {
namespace {

const std::string kOrigin =
    "closed form of a linear field in a convex body, moved by the roundings";

TEST(StabilityOfCoordinates, FarFromTheOrigin) {
  const HardMesh box = plain_box();
  const double cell = 2.0 / 3;
  const Eigen::Vector3d offset = 1e7 * cell * Eigen::Vector3d(1, -0.7, 0.4);
  const HardMesh far = transformed(box, Eigen::Matrix3d::Identity(), offset);
  std::vector<View> views = outside_views(mesh::bounds(box.mesh));
  for (View& view : views) {
    view.camera.eye += offset;
    view.camera.target += offset;
  }
  Record record("coordinates", "offset of 1e7 cells", kOrigin + ", of the points too");
  // A vertex, the eye, and their difference.
  expect_closed_forms(record, far.mesh, far.body, views, 3 * std::ldexp(offset.norm(), -53));
}

class Scale : public testing::TestWithParam<double> {};

TEST_P(Scale, OfAllCoordinates) {
  const HardMesh box =
      transformed(plain_box(), GetParam() * Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero());
  Record record("coordinates", fmt::format("scale of {:.0e}", GetParam()), kOrigin);
  expect_closed_forms(record, box.mesh, box.body, outside_views(mesh::bounds(box.mesh)));
}

INSTANTIATE_TEST_SUITE_P(Stability, Scale, testing::Values(1e-12, 1e12));

class Anisotropy : public testing::TestWithParam<Eigen::Vector3d> {};

TEST_P(Anisotropy, OfAMillion) {
  const Eigen::Vector3d scale = GetParam();
  const HardMesh box = transformed(plain_box(), scale.asDiagonal(), Eigen::Vector3d::Zero());
  // The whole of it, which is a line or a plane; and a part as large as it is thin, across and
  // along.
  std::vector<View> views = outside_views(mesh::bounds(box.mesh));
  for (const Eigen::Vector3d& along :
       {Eigen::Vector3d(0.02, 0.1, 1), Eigen::Vector3d(1, 1e-7, 0)}) {
    project::Camera near;
    near.parallel = true;
    near.ortho_height = 2.5 * scale.minCoeff();
    near.eye = 3 * scale.maxCoeff() * along.normalized();
    near.target = Eigen::Vector3d::Zero();
    views.push_back({along.x() == 1 ? "along" : "across", near});
  }
  Record record(
      "coordinates",
      fmt::format("axes scaled by {:.0e}, {:.0e}, {:.0e}", scale.x(), scale.y(), scale.z()),
      kOrigin + " (of depths: of the half diagonal)");
  expect_closed_forms(record, box.mesh, box.body, views);
}

INSTANTIATE_TEST_SUITE_P(Stability, Anisotropy,
                         testing::Values(Eigen::Vector3d(1e6, 1, 1),
                                         Eigen::Vector3d(1e3, 1e3, 1e-3)),
                         [](const auto& of) { return of.param.y() == 1 ? "Rod" : "Plate"; });

}  // namespace
}  // namespace tetraglass::tests
