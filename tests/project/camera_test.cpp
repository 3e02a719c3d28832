#include "project/camera.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "base/errors.h"

namespace tetraglass::project {
namespace {

Camera looking_down_z() {
  Camera camera;
  camera.eye = {0, 0, 5};
  camera.target = {0, 0, 0};
  camera.up = {0, 1, 0};
  camera.fov_degrees = 90;
  return camera;
}

// DESIGN section 2: x = (2 (i + 1/2)/W - 1) h W/H, y = (1 - 2 (j + 1/2)/H) h, h = tan(fov/2).
TEST(Frame, PixelCentresFollowTheDefinition) {
  const Frame frame(looking_down_z(), 8, 4);
  const Eigen::Vector2d first = frame.image_plane(0, 0);
  EXPECT_NEAR(first.x(), (2 * 0.5 / 8 - 1) * 2, 1e-15);
  EXPECT_NEAR(first.y(), 1 - 2 * 0.5 / 4, 1e-15);
  const Eigen::Vector2d last = frame.image_plane(7, 3);
  EXPECT_NEAR(last.x(), -first.x(), 1e-15);
  EXPECT_NEAR(last.y(), -first.y(), 1e-15);
}

TEST(Frame, PixelInvertsImagePlane) {
  Camera camera = looking_down_z();
  for (const bool parallel : {false, true}) {
    camera.parallel = parallel;
    camera.ortho_height = 3;
    const Frame frame(camera, 17, 31);
    for (const double x : {0.0, 3.5, 16.0}) {
      for (const double y : {0.0, 12.25, 30.0}) {
        const Eigen::Vector2d back = frame.pixel(frame.image_plane(x, y));
        EXPECT_NEAR(back.x(), x, 1e-12);
        EXPECT_NEAR(back.y(), y, 1e-12);
      }
    }
  }
}

TEST(Frame, RightIsRightAndUpIsUp) {
  const Frame frame(looking_down_z(), 4, 4);
  EXPECT_TRUE(frame.to_camera({1, 0, 0}).isApprox(Eigen::Vector3d(1, 0, 5)));
  EXPECT_TRUE(frame.to_camera({0, 1, 0}).isApprox(Eigen::Vector3d(0, 1, 5)));
  EXPECT_TRUE(frame.to_camera({0, 0, 1}).isApprox(Eigen::Vector3d(0, 0, 4)));
}

TEST(Frame, OrthoHeightSpansThePicture) {
  Camera camera = looking_down_z();
  camera.parallel = true;
  camera.ortho_height = 6;
  const Frame frame(camera, 2, 3);
  EXPECT_NEAR(frame.image_plane(0, 0).y() - frame.image_plane(0, 2).y(), 6.0 * 2 / 3, 1e-15);
}

TEST(Frame, RefusesWhatSeesNothing) {
  Camera camera = looking_down_z();
  camera.target = camera.eye;
  EXPECT_THROW(Frame(camera, 4, 4), base::UsageError);
  camera = looking_down_z();
  camera.up = {0, 0, 2};
  EXPECT_THROW(Frame(camera, 4, 4), base::UsageError);
  camera = looking_down_z();
  camera.fov_degrees = 180;
  EXPECT_THROW(Frame(camera, 4, 4), base::UsageError);
  camera = looking_down_z();
  camera.parallel = true;
  camera.ortho_height = 0;
  EXPECT_THROW(Frame(camera, 4, 4), base::UsageError);
  camera = looking_down_z();
  camera.eye.x() = std::nan("");
  EXPECT_THROW(Frame(camera, 4, 4), base::UsageError);
  EXPECT_THROW(Frame(looking_down_z(), 0, 4), base::UsageError);
}

// Framed for a perspective view, whose near corners are larger, a box stands beside the middle of a
// parallel view.
TEST(FrameCamera, ParallelViewsAreCentered) {
  const Eigen::AlignedBox3d box(Eigen::Vector3d(3, -1, 0), Eigen::Vector3d(7, 1, 9));
  std::vector<Eigen::Vector3d> corners = {Eigen::Vector3d::Constant(std::nan(""))};
  for (int i = 0; i < 8; ++i)
    corners.push_back(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)));
  Camera camera = frame_camera(box, {1, 0.8, 0.6}, Eigen::Vector3d::UnitZ(), 60, 1);
  camera.parallel = true;
  camera = centered(camera, corners);
  const Frame frame(camera, 10, 10);
  Eigen::AlignedBox3d extent;
  for (std::size_t i = 1; i < corners.size(); ++i) extent.extend(frame.to_camera(corners[i]));
  EXPECT_NEAR(extent.center().x(), 0, 1e-12);
  EXPECT_NEAR(extent.center().y(), 0, 1e-12);
  EXPECT_GT(extent.min().z(), 0);
}

TEST(FrameCamera, AllCornersAreInThePicture) {
  const Eigen::AlignedBox3d box(Eigen::Vector3d(-1, 2, 100), Eigen::Vector3d(5, 2.5, 101));
  for (const double aspect : {0.3, 1.0, 2.5}) {
    for (const bool parallel : {false, true}) {
      Camera camera = frame_camera(box, {1, 2, 0.5}, Eigen::Vector3d::UnitZ(), 40, aspect);
      camera.parallel = parallel;
      const int height = 200;
      const Frame frame(camera, static_cast<int>(height * aspect), height);
      for (int i = 0; i < 8; ++i) {
        const Eigen::Vector3d p =
            frame.to_camera(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)));
        const Eigen::Vector2d pixel =
            frame.pixel(parallel ? p.head<2>().eval() : (p.head<2>() / p.z()).eval());
        EXPECT_GT(p.z(), 0);
        EXPECT_GE(pixel.x(), -0.5) << "aspect " << aspect << " parallel " << parallel;
        EXPECT_LE(pixel.x(), frame.width() - 0.5);
        EXPECT_GE(pixel.y(), -0.5);
        EXPECT_LE(pixel.y(), frame.height() - 0.5);
      }
    }
  }
}

}  // namespace
}  // namespace tetraglass::project
