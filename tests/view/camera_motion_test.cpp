#include "apps/view/camera_motion.h"

#include <numbers>

#include <gtest/gtest.h>

#include "mesh/samples.h"

namespace tetraglass::apps::view {
namespace {

using project::Camera;
using project::Frame;

constexpr int kWidth = 400;
constexpr int kHeight = 300;

Camera oblique(bool parallel) {
  Camera camera;
  camera.eye = {3, -4, 2};
  camera.target = {0.5, 0.25, -0.1};
  camera.up = {0.1, 0.2, 1};
  camera.parallel = parallel;
  camera.ortho_height = 2.5;
  return camera;
}

/// Where a place of the world is in the picture, in parts of its height from the middle, downwards.
Eigen::Vector2d seen(const Camera& camera, const Eigen::Vector3d& place) {
  const Frame frame(camera, kWidth, kHeight);
  const Eigen::Vector3d in_camera = frame.to_camera(place);
  const Eigen::Vector2d plane =
      camera.parallel ? in_camera.head<2>().eval() : (in_camera.head<2>() / in_camera.z()).eval();
  return (frame.pixel(plane) - Eigen::Vector2d(kWidth - 1, kHeight - 1) / 2) / kHeight;
}

TEST(CameraMotion, OrbitKeepsTheTargetAndTheDistance) {
  for (const bool parallel : {false, true}) {
    const Camera before = oblique(parallel);
    const Camera after = orbited(before, {0.3, -0.2});
    EXPECT_EQ(after.target, before.target);
    EXPECT_NEAR((after.eye - after.target).norm(), (before.eye - before.target).norm(), 1e-12);
    EXPECT_GT((after.eye - before.eye).norm(), 1);
  }
}

// What is in front of the target follows the mouse, as a ball does that one turns.
TEST(CameraMotion, OrbitTurnsTheNearSideWithTheMouse) {
  const Camera before = oblique(false);
  const Eigen::Vector3d near = before.target + 0.2 * (before.eye - before.target).normalized();
  const Eigen::Vector2d moved = seen(orbited(before, {0.05, 0.02}), near) - seen(before, near);
  EXPECT_GT(moved.x(), 0);
  EXPECT_GT(moved.y(), 0);
}

TEST(CameraMotion, AWholeTurnComesBack) {
  const Camera before = oblique(false);
  const Camera after = orbited(before, {2, 0});
  EXPECT_NEAR((after.eye - before.eye).norm(), 0, 1e-12);
}

TEST(CameraMotion, PanMovesTheTargetWithTheMouse) {
  for (const bool parallel : {false, true}) {
    const Camera before = oblique(parallel);
    const Eigen::Vector2d drag(0.12, -0.34);
    EXPECT_NEAR((seen(panned(before, drag), before.target) - drag).norm(), 0, 1e-12) << parallel;
  }
}

TEST(CameraMotion, ZoomKeepsWhatIsUnderTheMouseAndScalesTheRest) {
  for (const bool parallel : {false, true}) {
    const Camera before = oblique(parallel);
    const Eigen::Vector2d mouse(0.2, -0.1);
    // Places in the target's plane: one that is seen under the mouse, and one beside it. The target
    // of a camera dragged the other way is where the mouse was.
    const Eigen::Vector3d under = panned(before, -mouse).target;
    const Eigen::Vector3d beside = panned(before, {0.3, 0.05}).target;
    ASSERT_NEAR((seen(before, under) - mouse).norm(), 0, 1e-12);
    const Camera after = zoomed(before, 1.5, mouse);
    EXPECT_NEAR((seen(after, under) - mouse).norm(), 0, 1e-12);
    EXPECT_NEAR((seen(after, beside) - mouse - 1.5 * (seen(before, beside) - mouse)).norm(), 0,
                1e-12);
  }
}

TEST(CameraMotion, ParallelAndBackShowsTheTargetAsLarge) {
  const Camera before = oblique(false);
  const Camera parallel = with_parallel(before, true);
  EXPECT_TRUE(parallel.parallel);
  const Eigen::Vector3d beside = panned(before, {0.2, 0.1}).target;
  EXPECT_NEAR((seen(parallel, beside) - seen(before, beside)).norm(), 0, 1e-12);
  const Camera back = with_parallel(zoomed(parallel, 2, {0, 0}), false);
  EXPECT_NEAR((seen(back, beside) - 2 * seen(before, beside)).norm(), 0, 1e-12);
}

TEST(CameraMotion, OptionsGiveTheSameCameraToTheLastBit) {
  for (const bool parallel : {false, true}) {
    const Camera camera = zoomed(orbited(oblique(parallel), {0.123, 0.456}), 1.1, {0.1, 0.3});
    const mesh::TetMesh mesh = mesh::make_sample("linear", 100);
    const Camera read = make_camera(camera_arguments(camera), mesh, 1);
    EXPECT_EQ(read.eye, camera.eye);
    EXPECT_EQ(read.target, camera.target);
    EXPECT_EQ(read.up, camera.up);
    EXPECT_EQ(read.parallel, camera.parallel);
    if (parallel) {
      EXPECT_EQ(read.ortho_height, camera.ortho_height);
    } else {
      EXPECT_EQ(read.fov_degrees, camera.fov_degrees);
    }
  }
}

}  // namespace
}  // namespace tetraglass::apps::view
