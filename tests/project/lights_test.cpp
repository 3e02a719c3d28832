#include "project/light/lights.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/errors.h"
#include "project/light/lights_file.h"
#include "tests/support/temporary_folder.h"

namespace tetraglass::project {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class LightsFile : public testing::Test {
 protected:
  Lights read(const std::string& text) {
    tests::write_text(file_, text);
    return read_lights(file_);
  }
  std::string error(const std::string& text) {
    try {
      static_cast<void>(read(text));
    } catch (const base::ReadError& e) {
      return e.what();
    }
    return "";
  }

  tests::TemporaryFolder folder_;
  std::string file_ = folder_.file("lights.json");
};

TEST_F(LightsFile, AllKinds) {
  const Lights lights = read(R"({"ambient": [0.1, 0.2, 0.3], "lights": [
    {"type": "directional", "direction": [0, 0, -1], "color": [1, 0.5, 0]},
    {"type": "point", "position": [1, 2, 3]},
    {"type": "rectangle", "corner": [0, 0, 5], "edges": [[1, 0, 0], [0, 2, 0]]}]})");
  EXPECT_TRUE((lights.ambient == preint::Color(0.1, 0.2, 0.3)).all());
  ASSERT_EQ(lights.lights.size(), 3U);
  const auto& directional = std::get<DirectionalLight>(lights.lights[0]);
  EXPECT_EQ(directional.direction, Eigen::Vector3d(0, 0, -1));
  EXPECT_TRUE((directional.color == preint::Color(1, 0.5, 0)).all());
  const auto& point = std::get<PointLight>(lights.lights[1]);
  EXPECT_EQ(point.position, Eigen::Vector3d(1, 2, 3));
  EXPECT_TRUE((point.color == 1).all());
  const auto& rectangle = std::get<RectangleLight>(lights.lights[2]);
  EXPECT_EQ(rectangle.corner, Eigen::Vector3d(0, 0, 5));
  EXPECT_EQ(rectangle.edges[1], Eigen::Vector3d(0, 2, 0));
  EXPECT_TRUE(read(R"({"lights": []})").lights.empty());
}

TEST_F(LightsFile, ErrorsSayWhere) {
  EXPECT_THAT(error(R"({"light": []})"), HasSubstr("did you mean 'lights'?"));
  EXPECT_THAT(error(R"({"lights": [{"type": "spot"}]})"),
              AllOf(HasSubstr("lights[0].type is no light: 'spot'"), HasSubstr("point")));
  EXPECT_THAT(error(R"({"lights": [{"type": "point"}]})"), HasSubstr("lights[0] lacks 'position'"));
  EXPECT_THAT(error(R"({"lights": [{"type": "point", "direction": [0, 0, 1]}]})"),
              HasSubstr("unknown key 'direction'"));
  EXPECT_THAT(error(R"({"lights": [{"type": "directional", "direction": [0, 0, 0]}]})"),
              HasSubstr("lights[0].direction must not be 0"));
  EXPECT_THAT(error(R"({"lights": [{"type": "point", "position": [0, 0]}]})"),
              HasSubstr("lights[0].position must be a list of three numbers"));
  EXPECT_THAT(
      error(R"({"lights": [{"type": "point", "position": [0, 0, 0], "color": [1, -1, 0]}]})"),
      HasSubstr("lights[0].color must be finite and not negative"));
  EXPECT_THAT(
      error(R"({"lights": [{"type": "rectangle", "corner": [0,0,0], "edges": [[1,0,0]]}]})"),
      HasSubstr("lights[0].edges must be a list of two edges"));
}

// What is written reads back to the last bit.
TEST_F(LightsFile, ReadsBackAsWritten) {
  const std::string file = folder_.file("written.json");
  Lights lights;
  lights.ambient = {0.1, 1.0 / 3, 0};
  lights.lights.emplace_back(DirectionalLight{{-1, 0.1, 1e-300}, {1, 0.5, 2.0 / 7}});
  lights.lights.emplace_back(PointLight{{1e20, -3.7, 0}, {4, 0, 0}});
  lights.lights.emplace_back(RectangleLight{
      {0, 0, 5}, {Eigen::Vector3d(1, 0.3, 0), Eigen::Vector3d(0, 1, 0.1)}, {1, 1, 1}});
  write_lights(lights, file);
  const Lights again = read_lights(file);
  EXPECT_TRUE((again.ambient == lights.ambient).all());
  ASSERT_EQ(again.lights.size(), 3U);
  const auto& directional = std::get<DirectionalLight>(again.lights[0]);
  EXPECT_EQ(directional.direction, std::get<DirectionalLight>(lights.lights[0]).direction);
  EXPECT_TRUE((directional.color == std::get<DirectionalLight>(lights.lights[0]).color).all());
  const auto& point = std::get<PointLight>(again.lights[1]);
  EXPECT_EQ(point.position, std::get<PointLight>(lights.lights[1]).position);
  EXPECT_TRUE((point.color == std::get<PointLight>(lights.lights[1]).color).all());
  const auto& rectangle = std::get<RectangleLight>(again.lights[2]);
  EXPECT_EQ(rectangle.corner, std::get<RectangleLight>(lights.lights[2]).corner);
  EXPECT_EQ(rectangle.edges, std::get<RectangleLight>(lights.lights[2]).edges);
  EXPECT_THROW(write_lights(lights, folder_.file("no/folder.json")), base::WriteError);
}

}  // namespace
}  // namespace tetraglass::project
