// Views that are hard to decide: rays along faces, edges and through vertices, eyes on them, angles
// near 180 degrees, pictures of one pixel and of thousands.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "tests/stability/drawing.h"
#include "tests/stability/hard_meshes.h"

namespace tetraglass::tests {
namespace {

const std::string kOrigin =
    "closed form of a linear field in a convex body, moved by the roundings";

void expect(const std::string& name, const std::vector<View>& views) {
  const HardMesh box = plain_box(4);
  Record record("views", name, kOrigin);
  expect_closed_forms(record, box.mesh, box.body, views);
}

project::Camera looking(const Eigen::Vector3d& eye, const Eigen::Vector3d& along, double fov) {
  project::Camera camera;
  camera.eye = eye;
  camera.target = eye + along;
  camera.up = {0.1, 0.9, -0.2};
  camera.fov_degrees = fov;
  return camera;
}

project::Camera parallel(const Eigen::Vector3d& along, const Eigen::Vector3d& up, double height) {
  project::Camera camera = looking(-5 * along, along, 40);
  camera.up = up;
  camera.parallel = true;
  camera.ortho_height = height;
  return camera;
}

// The planes of the mesh lie at multiples of 1/2: pixel centres at multiples of 1/4, on the
// bricks' faces, edges and the faces' diagonals; of the silhouette too.
TEST(StabilityOfViews, AlongFacesAndEdges) {
  const double pixel = 0.25;
  expect("rays along faces and edges",
         {{"along -z", parallel(-Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitY(), 13 * pixel),
           13, 13},
          {"along x", parallel(Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ(), 13 * pixel), 13,
           13}});
}

// The middle rays of odd pictures run along the bricks' diagonals, where six cells meet, and along
// those of their faces.
TEST(StabilityOfViews, AlongDiagonals) {
  expect("rays along diagonals and through vertices",
         {{"(1, 1, 1)", looking({-3, -3, -3}, {1, 1, 1}, 40), 15, 15},
          {"(1, 1, 1) parallel", parallel({1, 1, 1}, {0, 1, 0}, 3), 15, 15},
          {"(1, 1, 0)", looking({-3, -3, 0}, {1, 1, 0}, 40), 15, 15},
          {"(1, 1, 0) parallel", parallel({1, 1, 0}, {0, 0, 1}, 3), 15, 15}});
}

TEST(StabilityOfViews, EyeInTheMesh) {
  expect("eye on a vertex, on an edge, in a face, in a cell",
         {{"on a vertex", looking({0.5, 0, -0.5}, {1, 0.8, 0.6}, 90)},
          {"on an edge", looking({0.5, 0, 0.3}, {-1, 0.3, 0.2}, 90)},
          {"in a face", looking({0.5, 0.1, 0.3}, {0.1, -1, 0.2}, 90)},
          {"in a cell", looking({0.47, 0.13, 0.31}, {0.3, 0.3, -1}, 90)}});
}

TEST(StabilityOfViews, EyeOnTheBoundary) {
  expect("eye on the boundary",
         {{"on a corner", looking({1, 1, 1}, {-1, -0.9, -0.8}, 90)},
          {"in a face, inwards", looking({1, 0.2, 0.3}, {-1, 0.1, 0.2}, 90)},
          {"in a face, along it", looking({1, 0.2, 0.3}, {0, 1, 0.3}, 60)},
          {"in a face, outwards", looking({1, 0.2, 0.3}, {1, 0.1, 0.2}, 60)}});
}

TEST(StabilityOfViews, EyeNextToAFace) {
  expect("eye next to a face",
         {{"1e-9 inside", looking({1 - 1e-9, 0.2, 0.3}, {-1, 0.5, 0.2}, 80)},
          {"1e-9 outside", looking({1 + 1e-9, 0.2, 0.3}, {-1, 0.5, 0.2}, 80)},
          {"1e-9 off an inner face", looking({0.5 + 1e-9, 0.2, 0.3}, {0.1, 1, 0.2}, 80)}});
}

TEST(StabilityOfViews, WideAngles) {
  expect("170 degrees", {{"inside", looking({0.1, 0.2, 0.3}, {1, 0.4, 0.2}, 170)},
                         {"outside", looking({-1.2, 0.2, 0.3}, {1, 0.4, 0.2}, 170)}});
}

TEST(StabilityOfViews, FarAway) {
  expect("a million diagonals away",
         {{"1e-6 radians", looking({-1e6, -2e6, 1e6}, {1, 2, -1}, 180 / M_PI * 1.2e-6)}});
}

TEST(StabilityOfViews, OnePixel) {
  project::Camera across = parallel({1, 0.3, -0.2}, {0, 1, 0}, 1);
  expect("one pixel", {{"perspective", looking({-3, -1, 2}, {1, 0.35, -0.6}, 30), 1, 1},
                       {"parallel", across, 1, 1}});
}

TEST(StabilityOfViews, WidePictures) {
  constexpr int kWide = 16384;
  const double part = 4.0 / kWide;  // as wide as the mesh with a margin
  expect(
      "16384 pixels wide",
      {{"parallel", parallel({1, 0.3, -0.2}, {0, 1, 0}, part), kWide, 1},
       {"perspective", looking({-3, -1, 2}, {1, 0.35, -0.6}, 180 / M_PI * part / 3.6), kWide, 1}});
}

}  // namespace
}  // namespace tetraglass::tests
