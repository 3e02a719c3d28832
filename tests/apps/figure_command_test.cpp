// What stands around the picture, and rows of frames, by running the built program.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "project/image_file.h"
#include "tests/support/program.h"

namespace tetraglass::tests {
namespace {

using Json = nlohmann::json;

/// PATH as long as this lives.
class SearchPath {
 public:
  explicit SearchPath(const std::string& path) : before_(std::getenv("PATH")) {
    setenv("PATH", path.c_str(), 1);
  }
  ~SearchPath() { setenv("PATH", before_.c_str(), 1); }
  SearchPath(const SearchPath&) = delete;
  SearchPath& operator=(const SearchPath&) = delete;

 private:
  std::string before_;
};

class FigureCommand : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    for (const std::string size : {"1e3", "3e3"}) {
      ASSERT_EQ(run_program("sample sphere --cells " + size + " -o " + file(size + ".vtu")).status,
                0);
    }
    std::ofstream(file("times.pvd"))
        << R"(<?xml version="1.0"?><VTKFile type="Collection" version="0.1"><Collection>)"
        << R"(<DataSet timestep="0" file="3e3.vtu"/><DataSet timestep="0.5" file="1e3.vtu"/>)"
        << R"(<DataSet timestep="2" file="3e3.vtu"/></Collection></VTKFile>)";
    std::ofstream(file("cube.off")) << "OFF\n8 6 0\n-1 -1 -1\n1 -1 -1\n1 1 -1\n-1 1 -1\n-1 -1 1\n"
                                       "1 -1 1\n1 1 1\n-1 1 1\n4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n"
                                       "4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }

  static std::string file(const std::string& name) { return folder_->file(name); }
  static std::string sphere() { return file("3e3.vtu"); }

  static void expect_error(const std::string& arguments, int status, const std::string& part) {
    const ProgramRun run = run_program(arguments);
    EXPECT_EQ(run.status, status) << arguments << "\n" << run.err;
    EXPECT_NE(run.err.find("tetraglass: error: "), std::string::npos) << run.err;
    EXPECT_NE(run.err.find(part), std::string::npos) << arguments << "\n" << run.err;
    EXPECT_EQ(run.out, "") << arguments;
  }

  /// Nothing but the folder's own files.
  [[nodiscard]] std::size_t files_left() const {
    const std::filesystem::path folder(output_.file(""));
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
  }

  TemporaryFolder output_;

 private:
  static TemporaryFolder* folder_;
};

TemporaryFolder* FigureCommand::folder_ = nullptr;

TEST_F(FigureCommand, EverythingAroundThePictureInEveryFormatAndMode) {
  for (const std::string mode : {"full", "emission", "absorption", "mip", "iso"}) {
    const std::string base = output_.file(mode);
    const ProgramRun run = run_program(
        "render " + sphere() + " --size 320x240 --legend --legend-title 'T [K]' --title Sphere " +
        "--axes --outline --mode " + mode + " -o " + base + ".png -o " + base +
        ".npy --verify 200 " + "--stats " + base + ".json");
    ASSERT_EQ(run.status, 0) << run.err;
    const project::ReadImage image = project::read_image(base + ".npy");
    EXPECT_EQ(image.image.width, 320);
    EXPECT_EQ(image.image.height, 240);
    EXPECT_LT(Json::parse(read_text(base + ".json"))["verified"]["max_error"], 1e-4) << mode;
  }
}

TEST_F(FigureCommand, ThePictureIsThatOfTheSameSizeAndCameraWithoutThem) {
  const std::string camera = " --eye 3,2,1.5 --target 0.5,0.5,0.5 ";
  ASSERT_EQ(run_program("render " + sphere() + camera + " --size 320x240 --title T -o " +
                        output_.file("with.npy"))
                .status,
            0);
  const project::Image with = project::read_image(output_.file("with.npy")).image;
  const int height = 240 - 19;  // the title takes 48 pixels of 600
  ASSERT_EQ(run_program("render " + sphere() + camera + " --size 320x" + std::to_string(height) +
                        " -o " + output_.file("without.npy"))
                .status,
            0);
  const project::Image without = project::read_image(output_.file("without.npy")).image;
  const std::vector<float> lower(with.rgba.end() - static_cast<std::ptrdiff_t>(without.rgba.size()),
                                 with.rgba.end());
  EXPECT_EQ(lower, without.rgba);
}

TEST_F(FigureCommand, ASurfaceIsSeenThroughTheVolume) {
  const std::string base =
      "render " + sphere() + " --size 96x96 --field x --eye 9,7,5 --verify 300 ";
  std::vector<project::Image> images;
  for (const std::string projector : {"reference", "cpu", "gl"}) {
    const std::string name = output_.file(projector + ".npy");
    const ProgramRun run =
        run_program(base + "--surface " + file("cube.off") +
                    " --surface-color 0.8,0.1,0.1 --projector " + projector + " -o " + name);
    ASSERT_EQ(run.status, 0) << run.err;
    images.push_back(project::read_image(name).image);
  }
  for (std::size_t i = 0; i < images[0].rgba.size(); ++i) {
    ASSERT_NEAR(images[1].rgba[i], images[0].rgba[i], 1e-4);
    ASSERT_NEAR(images[2].rgba[i], images[0].rgba[i], 5e-4);
  }
  EXPECT_NEAR(images[0].pixel(48, 48)[3], 1, 1e-6) << "opaque";
  std::ofstream(output_.file("empty.off")) << "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n";
  expect_error(base + "--surface " + output_.file("empty.off") + " -o " + output_.file("a.png"), 1,
               "empty.off: has no faces to draw");
  expect_error(base + "--surface " + sphere() + " -o " + output_.file("a.png"), 1,
               "--surface, which reads .stl");
  expect_error(base + "--surface " + file("none.stl") + " -o " + output_.file("a.png"), 1,
               "none.stl");
  expect_error(base + "--outline --mode thickness -o " + output_.file("a.png"), 2, "thickness");
}

TEST_F(FigureCommand, AnOrbitWritesNumberedFrames) {
  const std::string base = "render " + sphere() + " --size 48x40 --eye 4,3,2 ";
  const ProgramRun run =
      run_program(base + "--orbit 5 -o " + output_.file("a.npy") + " -o " +
                  output_.file("b_%02d_.png") + " --stats " + output_.file("s.json"));
  ASSERT_EQ(run.status, 0) << run.err;
  std::string expected;
  for (int i = 0; i < 5; ++i) {
    expected += output_.file("a-000" + std::to_string(i) + ".npy\n") +
                output_.file("b_0" + std::to_string(i) + "_.png\n");
  }
  EXPECT_EQ(run.out, expected);
  const Json stats = Json::parse(read_text(output_.file("s.json")));
  EXPECT_EQ(stats["frames"]["count"], 5);
  EXPECT_GT(stats["frames"]["median_ms"], 0);
  EXPECT_GE(stats["frames"]["sum_ms"], 2 * stats["frames"]["median_ms"].get<double>());
  // The first is the picture without an orbit; a turn by hand gives the others.
  ASSERT_EQ(run_program(base + "-o " + output_.file("one.npy")).status, 0);
  EXPECT_EQ(project::read_image(output_.file("one.npy")).image.rgba,
            project::read_image(output_.file("a-0000.npy")).image.rgba);
  EXPECT_NE(project::read_image(output_.file("a-0001.npy")).image.rgba,
            project::read_image(output_.file("a-0000.npy")).image.rgba);
}

// Steps of other values on one mesh: what is kept of the mesh changes no number.
TEST_F(FigureCommand, TimeStepsOfOneMeshAreThoseOfEachAlone) {
  int step = 0;
  std::string sets;
  for (const std::string expression : {"radius", "x + 2", "radius * radius"}) {
    const std::string name = "step" + std::to_string(step) + ".vtu";
    ASSERT_EQ(run_program("import " + sphere() + " --add-field 'hot=" + expression + "' -o " +
                          output_.file(name))
                  .status,
              0);
    sets += "<DataSet timestep=\"" + std::to_string(step++) + "\" file=\"" + name + "\"/>";
  }
  write_text(output_.file("run.pvd"), "<VTKFile type=\"Collection\" version=\"0.1\"><Collection>" +
                                          sets + "</Collection></VTKFile>");
  const std::string fixed = "render " + output_.file("run.pvd") +
                            " --field hot --size 40x30 --range 0.2:2.5 --opacity given --eye 4,3,2 "
                            "--target 0,0,0 ";
  for (const std::string options : {"", "--mode iso --isovalue 1 ", "--shading smooth "}) {
    ASSERT_EQ(run_program(fixed + options + "--time all -o " + output_.file("f.npy")).status, 0);
    for (const std::string number : {"0", "1", "2"}) {
      ASSERT_EQ(
          run_program(fixed + options + "--time index:" + number + " -o " + output_.file("i.npy"))
              .status,
          0);
      EXPECT_EQ(project::read_image(output_.file("i.npy")).image.rgba,
                project::read_image(output_.file("f-000" + number + ".npy")).image.rgba)
          << options << number;
    }
  }
}

TEST_F(FigureCommand, AllTimeStepsShareColorsAndCamera) {
  const std::string base = "render " + file("times.pvd") + " --size 48x40 ";
  const ProgramRun run = run_program(base + "--time all -o " + output_.file("t.npy"));
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 3);
  const auto frame = [&](const std::string& name) {
    return project::read_image(output_.file(name + ".npy")).image.rgba;
  };
  EXPECT_EQ(frame("t-0000"), frame("t-0002")) << "the same file";
  EXPECT_NE(frame("t-0000"), frame("t-0001"));
  // With all that could differ fixed, each is the picture of its step.
  const std::string fixed = base + "--range 0.2:1.2 --opacity given --eye 4,3,2 --target 0,0,0 ";
  ASSERT_EQ(run_program(fixed + "--time all -o " + output_.file("f.npy")).status, 0);
  for (const std::string step : {"0", "1", "2"}) {
    ASSERT_EQ(run_program(fixed + "--time index:" + step + " -o " + output_.file("i.npy")).status,
              0);
    EXPECT_EQ(frame("i"), frame("f-000" + step)) << step;
  }
  expect_error("render " + sphere() + " --time all -o " + output_.file("x.png"), 1,
               "3e3.vtu: has no time steps");
}

TEST_F(FigureCommand, WhatDoesNotGoTogetherIsToldBeforehand) {
  const std::string base = "render " + file("times.pvd") + " -o " + output_.file("a.png") + " ";
  expect_error(base + "--orbit 3 --time all", 2, "--orbit shows one time step");
  expect_error(base + "--orbit 0", 2, "--orbit");
  expect_error(base + "--orbit 3 --verify 10", 2, "--verify");
  expect_error(base + "--fps 10", 2, "--fps");
  expect_error("render " + sphere() + " -o " + output_.file("a.mp4"), 1, "is a film");
  expect_error("render " + sphere() + " --orbit 2 -o " + output_.file("a%s.png"), 2, "%04d");
  expect_error("render " + sphere() + " --orbit 2 -o " + output_.file("a%d%d.png"), 2, "%04d");
  EXPECT_EQ(files_left(), 0U);
}

TEST_F(FigureCommand, FilmsNeedFfmpegAndAreWholeOrNotThere) {
  const std::string command = "render " + sphere() + " --size 33x31 --orbit 4 --fps 10 -o ";
  {
    const SearchPath nowhere("/nonexistent");
    expect_error(command + output_.file("a.mp4"), 1, "ffmpeg, which is not installed");
  }
  {
    const TemporaryFolder programs;
    std::ofstream(programs.file("ffmpeg")) << "#!/bin/sh\necho some trouble >&2\nexit 3\n";
    chmod(programs.file("ffmpeg").c_str(), 0755);
    const SearchPath broken(programs.file(""));
    expect_error(command + output_.file("a.gif"), 1, "ffmpeg ended with status 3: some trouble");
  }
  EXPECT_EQ(files_left(), 0U);
  if (std::system("command -v ffmpeg >/dev/null") != 0) GTEST_SKIP() << "ffmpeg is not installed";
  for (const std::string name : {"a.mp4", "a.webm", "a.gif"}) {
    const ProgramRun run = run_program(command + output_.file(name));
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.out, output_.file(name) + "\n");
    EXPECT_GT(std::filesystem::file_size(output_.file(name)), 300U);
  }
  EXPECT_EQ(files_left(), 3U);
}

}  // namespace
}  // namespace tetraglass::tests
