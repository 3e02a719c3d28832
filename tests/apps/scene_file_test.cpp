// Scene files, by running the built program.
#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "project/image_file.h"
#include "tests/support/program.h"

namespace tetraglass::tests {
namespace {

using Json = nlohmann::json;

class SceneFile : public testing::Test {
 protected:
  SceneFile() {
    EXPECT_EQ(run_program("sample sphere --cells 1e3 -o " + file("mesh.vtu")).status, 0);
    std::filesystem::create_directory(file("scenes"));
  }

  std::string file(const std::string& name) const { return folder_.file(name); }

  project::Image picture(const std::string& name) const {
    return project::read_image(file(name)).image;
  }

  void expect_refused(const std::string& scene, const std::string& part) const {
    write_text(file("scenes/wrong.json"), scene);
    const ProgramRun run = run_program("render --scene " + file("scenes/wrong.json") + " " +
                                       file("mesh.vtu") + " -o " + file("wrong.png"));
    EXPECT_EQ(run.status, 1) << scene << run.err;
    EXPECT_EQ(run.err.find("tetraglass: error: " + file("scenes/wrong.json")), 0U) << run.err;
    EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(file("wrong.png")));
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(SceneFile, WhatIsSavedGivesTheSamePicture) {
  const std::string options =
      " --mode iso --isovalue 0.4 --isovalue 0.8 --iso-color 1,0.5,0 --clip 1,0,0,0.7 --clip "
      "0,-1,0,0.4"
      " --eye 4,-3,2 --fov 25 --legend-title 'T [K]' --legend --outline --background 1,1,1"
      " --size 320x240 ";
  const ProgramRun saved = run_program("render " + file("mesh.vtu") + " " + options + " -o " +
                                       file("a.npy") + " --save-scene " + file("scenes/s.json"));
  ASSERT_EQ(saved.status, 0) << saved.err;
  const Json scene = Json::parse(read_text(file("scenes/s.json")));
  EXPECT_EQ(scene["input"], "../mesh.vtu");
  EXPECT_EQ(scene["isovalue"], Json({0.4, 0.8}));
  EXPECT_EQ(scene["outline"], true);
  EXPECT_EQ(scene["fov"], 25);
  EXPECT_FALSE(scene.contains("save-scene"));
  const project::Image first = picture("a.npy");
  std::filesystem::remove(file("a.npy"));
  const ProgramRun again = run_program("render --scene " + file("scenes/s.json"));
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(picture("a.npy").rgba, first.rgba);
  // What is typed counts before the file.
  ASSERT_EQ(run_program("render --scene " + file("scenes/s.json") +
                        " --size 330x250 --isovalue 0.5 -o " + file("b.npy"))
                .status,
            0);
  EXPECT_EQ(picture("b.npy").width, 330);
}

TEST_F(SceneFile, ListsAndFlagsAreReadAsPeopleWriteThem) {
  write_text(file("scenes/s.json"),
             R"({"input": "../mesh.vtu", "output": "../a.npy", "size": "48x40", "eye": [4, 3, 2],
                 "target": [0, 0, 0.25], "clip": [[1, 0, 0, 0.5]], "legend": false, "mode": "mip"})");
  ASSERT_EQ(run_program("render --scene " + file("scenes/s.json")).status, 0);
  ASSERT_EQ(run_program("render " + file("mesh.vtu") + " -o " + file("b.npy") +
                        " --size 48x40 --eye 4,3,2 --target 0,0,0.25 --clip 1,0,0,0.5 --mode mip")
                .status,
            0);
  EXPECT_EQ(picture("a.npy").rgba, picture("b.npy").rgba);
}

TEST_F(SceneFile, WhatIsWrongIsSaidWithItsPlace) {
  expect_refused("{", "is not JSON");
  expect_refused("[1]", "must be");
  expect_refused(R"({"isovalu": 1})", "isovalue");
  expect_refused(R"({"mode": null})", "mode must be a text, a number, true or false, not null");
  expect_refused(R"({"mode": {"a": 1}})", "mode must be a text");
  expect_refused(R"({"outline": 3})", "outline must be true or false");
  expect_refused(R"({"eye": []})", "eye must not be an empty list");
  expect_refused(R"({"eye": [1, null, 2]})", "eye[1]");
  const ProgramRun missing = run_program("render --scene " + file("none.json"));
  EXPECT_EQ(missing.status, 1);
  EXPECT_NE(missing.err.find("none.json: cannot be read"), std::string::npos) << missing.err;
  // Values that cannot be are told by the option's name, as where they are typed.
  write_text(file("s.json"), R"({"input": "mesh.vtu", "output": "a.png", "size": "tall"})");
  const ProgramRun wrong = run_program("render --scene " + file("s.json"));
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.err.find("--size needs"), std::string::npos) << wrong.err;
  write_text(file("s.json"), R"({"size": "40x40"})");
  const ProgramRun without = run_program("render --scene " + file("s.json"));
  EXPECT_EQ(without.status, 2);
  EXPECT_NE(without.err.find("INPUT is required"), std::string::npos) << without.err;
}

}  // namespace
}  // namespace tetraglass::tests
