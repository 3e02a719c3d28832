#include "apps/camera_options.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "mesh/samples.h"
#include "tests/support/temporary_folder.h"

namespace tetraglass::apps {
namespace {

class CameraFile : public testing::Test {
 protected:
  project::Camera read(const std::string& json) {
    tests::write_text(file_, json);
    CameraArguments arguments;
    arguments.file = file_;
    return make_camera(arguments, mesh_, 1);
  }
  std::string complaint(const std::string& json) {
    try {
      (void)read(json);
    } catch (const base::ReadError& error) {
      return error.what();
    }
    return "none";
  }

  tests::TemporaryFolder folder_;
  std::string file_ = folder_.file("camera.json");
  mesh::TetMesh mesh_ = mesh::make_sample("linear", 10);
};

TEST_F(CameraFile, PerspectiveAndParallel) {
  const project::Camera camera =
      read(R"({"eye": [1, 2, 3], "target": [0.5, 0, 0], "up": [0, 1, 0], "fov": 40})");
  EXPECT_EQ(camera.eye, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(camera.target, Eigen::Vector3d(0.5, 0, 0));
  EXPECT_EQ(camera.up, Eigen::Vector3d(0, 1, 0));
  EXPECT_FALSE(camera.parallel);
  EXPECT_EQ(camera.fov_degrees, 40);
  const project::Camera parallel =
      read(R"({"camera": {"eye": [1, 2, 3], "target": [0, 0, 0], "ortho": 2.5}})");
  EXPECT_TRUE(parallel.parallel);
  EXPECT_EQ(parallel.ortho_height, 2.5);
  EXPECT_EQ(parallel.up, Eigen::Vector3d(0, 0, 1));
}

TEST_F(CameraFile, ComplaintsNameTheFileAndThePlace) {
  const std::string start = R"({"eye": [1, 2, 3], "target": [0, 0, 0])";
  EXPECT_NE(complaint(R"({"eye": [1, 2, 3]})").find(file_), std::string::npos);
  EXPECT_NE(complaint(R"({"eye": [1, 2], "target": [0, 0, 0]})").find("eye"), std::string::npos);
  EXPECT_NE(complaint(start + R"(, "fov": 180})").find("fov"), std::string::npos);
  EXPECT_NE(complaint(start + R"(, "ortho": 0})").find("ortho"), std::string::npos);
  EXPECT_NE(complaint(start + R"(, "ortho": 1, "fov": 30})").find("keep one"), std::string::npos);
  EXPECT_NE(complaint(start + R"(, "fovy": 30})").find("fov"), std::string::npos);
}

TEST_F(CameraFile, StandsAlone) {
  tests::write_text(file_, R"({"eye": [1, 2, 3], "target": [0, 0, 0]})");
  CameraArguments arguments;
  arguments.file = file_;
  arguments.fov = "30";
  EXPECT_THROW((void)make_camera(arguments, mesh_, 1), base::UsageError);
}

}  // namespace
}  // namespace tetraglass::apps
