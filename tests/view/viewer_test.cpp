#include "apps/view/viewer.h"

#include <filesystem>
#include <semaphore>

#include <gtest/gtest.h>

#include "project/image_file.h"
#include "project/render.h"
#include "tests/support/program.h"
#include "tests/view/virtual_display.h"

namespace tetraglass::apps::view {
namespace {

namespace fs = std::filesystem;

/// A viewer of a small sample, and the thread that draws for it, without a window.
class ViewerTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new tests::TemporaryFolder;
    ASSERT_EQ(tests::run_program("sample sphere --cells 2000 -o " + file()).status, 0);
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }
  static std::string file() { return folder_->file("sphere.vtu"); }
  static tests::TemporaryFolder& folder() { return *folder_; }

  static RenderArguments arguments() {
    RenderArguments result;
    result.input = file();
    return result;
  }

  /// Draws until nothing is left to draw.
  void finish(Viewer& viewer) {
    for (int idle = 0; idle < 2;) {
      tick(viewer);
      auto request = viewer.next_request();
      if (!request) {
        ++idle;
        continue;
      }
      idle = 0;
      draw(viewer, *std::move(request));
    }
  }

  void tick(Viewer& viewer) { viewer.tick(now_ms_ += 1000); }

  void draw(Viewer& viewer, DrawRequest request) {
    drawing_.request(std::move(request));
    ready_.acquire();
    viewer.accept(drawing_.take());
  }

  static project::Image rendered(const Viewer& viewer) {
    RenderArguments made = viewer.arguments();
    static_cast<CameraArguments&>(made) = camera_arguments(*viewer.camera());
    const mesh::Import imported = mesh::import_mesh(made.input, made.import);
    const project::Scene scene = make_scene(made, imported.mesh);
    project::Stats stats;
    return project::render(scene, project::plan(scene, make_request(made)), stats);
  }

  double now_ms_ = 0;
  std::binary_semaphore ready_{0};
  Drawing drawing_{[this] { ready_.release(); }};

 private:
  static tests::TemporaryFolder* folder_;
};

tests::TemporaryFolder* ViewerTest::folder_ = nullptr;

// After whatever was done before, the picture at rest is that of render, number for number.
TEST_F(ViewerTest, AtRestThePictureIsThatOfRender) {
  Viewer viewer(arguments(), {});
  viewer.resize(90, 70);
  finish(viewer);
  ASSERT_TRUE(viewer.complete()) << viewer.error();
  EXPECT_EQ(viewer.picture()->image.rgba, rendered(viewer).rgba);
  viewer.orbit({0.1, 0.2});
  viewer.zoom(1.3, {0.1, 0});
  viewer.pan({0.02, 0.1});
  finish(viewer);
  EXPECT_EQ(viewer.picture()->image.rgba, rendered(viewer).rgba);
  for (int i = 0; i < 6; ++i) {
    viewer.next_mode();
    viewer.set_parallel(i % 2 == 0);
    finish(viewer);
    ASSERT_TRUE(viewer.complete()) << viewer.error();
    EXPECT_EQ(viewer.picture()->coarseness, 1);
    EXPECT_EQ(viewer.picture()->image.rgba, rendered(viewer).rgba) << viewer.arguments().mode;
  }
  EXPECT_EQ(viewer.arguments().mode, "full");
  viewer.editor().begin();
  viewer.editor().add(0.5);
  viewer.editor().move(0.6, 3);
  viewer.apply_edit();
  viewer.change_scene().opacity_scale = "0.5";
  finish(viewer);
  EXPECT_EQ(viewer.picture()->image.rgba, rendered(viewer).rgba);
  viewer.undo();
  EXPECT_FALSE(viewer.arguments().own_transfer_function);
  viewer.redo();
  EXPECT_TRUE(viewer.arguments().own_transfer_function);
}

// Frames of one scene are drawn by what was set up for the first one.
TEST_F(ViewerTest, AScenesSetUpIsKept) {
  Viewer viewer(arguments(), {});
  viewer.resize(60, 50);
  finish(viewer);
  const SceneFacts* facts = viewer.facts();
  viewer.orbit({0.1, 0.2});
  viewer.resize(70, 55);
  finish(viewer);
  EXPECT_EQ(viewer.picture()->scene_ms, 0);
  EXPECT_EQ(viewer.facts(), facts);
  EXPECT_EQ(viewer.picture()->width, 70);
}

TEST_F(ViewerTest, MovingPicturesAreCoarserAndSaidSo) {
  Viewer viewer(arguments(), {});
  viewer.resize(90, 70);
  viewer.tick(0);
  const auto request = viewer.next_request();
  ASSERT_TRUE(request);
  EXPECT_GT(request->coarseness, 1);
  EXPECT_FALSE(viewer.complete());
}

TEST_F(ViewerTest, WhatIsRefusedIsTold) {
  Viewer viewer(arguments(), {});
  viewer.resize(90, 70);
  finish(viewer);
  const Drawn* before = viewer.picture();
  viewer.change_scene().sort = "none";
  finish(viewer);
  EXPECT_NE(viewer.error(), "");
  EXPECT_EQ(viewer.picture(), before) << "the last picture stays";
  viewer.change_scene().sort = "auto";
  finish(viewer);
  EXPECT_EQ(viewer.error(), "");
  EXPECT_TRUE(viewer.complete());
}

// Nothing of a file is read again until another one is opened; then its absence is told, and
// everything stays as it was.
TEST_F(ViewerTest, AFileThatVanishes) {
  const std::string copy = folder().file("copy.vtu");
  fs::copy_file(file(), copy);
  RenderArguments of_copy = arguments();
  of_copy.input = copy;
  Viewer viewer(of_copy, {});
  viewer.resize(60, 50);
  finish(viewer);
  ASSERT_TRUE(viewer.complete());
  fs::remove(copy);
  viewer.orbit({0.1, 0});
  viewer.next_mode();
  finish(viewer);
  EXPECT_TRUE(viewer.complete()) << viewer.error();
  const std::vector<std::string> command = viewer.command("a.png");
  const std::string missing = folder().file("missing.vtu");
  viewer.open(missing);
  viewer.open(missing);  // before it is known that it is not there
  finish(viewer);
  EXPECT_TRUE(viewer.refusal().starts_with(missing)) << viewer.refusal();
  EXPECT_TRUE(viewer.complete()) << viewer.error();
  EXPECT_EQ(viewer.command("a.png"), command);
  viewer.orbit({0.1, 0});
  EXPECT_EQ(viewer.refusal(), "");
  finish(viewer);
  EXPECT_TRUE(viewer.complete()) << viewer.error();
  viewer.open(file());
  finish(viewer);
  EXPECT_TRUE(viewer.complete()) << viewer.error();
}

// What nobody waits for any more is given up; the next picture is what it would have been.
TEST_F(ViewerTest, WhatIsOutdatedIsGivenUp) {
  RenderArguments slow = arguments();
  slow.projector = "reference";  // a second, in full
  Viewer viewer(slow, {});
  viewer.resize(450, 350);
  tick(viewer);
  draw(viewer, *viewer.next_request());
  tick(viewer);
  auto request = viewer.next_request();
  ASSERT_TRUE(request);
  ASSERT_EQ(request->coarseness, 1);
  drawing_.request(*std::move(request));
  ASSERT_TRUE(tests::wait_until([&] {
    const auto busy = drawing_.busy();
    return busy && busy->stage == Busy::Stage::draw && busy->ms > 20;
  }));
  EXPECT_FALSE(viewer.outdated());
  viewer.resize(60, 50);
  EXPECT_TRUE(viewer.outdated());
  drawing_.interrupt();
  ready_.acquire();
  std::unique_ptr<Drawn> drawn = drawing_.take();
  EXPECT_TRUE(drawn->interrupted);
  EXPECT_EQ(drawn->error, "");
  viewer.accept(std::move(drawn));
  finish(viewer);
  EXPECT_TRUE(viewer.complete()) << viewer.error();
  EXPECT_EQ(viewer.picture()->image.rgba, rendered(viewer).rgba);
}

// Another file that is being read can be left for the one that is shown.
TEST_F(ViewerTest, ReadingIsGivenUp) {
  Viewer viewer(arguments(), {});
  viewer.resize(60, 50);
  finish(viewer);
  const std::vector<std::string> command = viewer.command("a.png");
  viewer.give_up();  // nothing is being read
  EXPECT_EQ(viewer.refusal(), "");
  viewer.open(folder().file("missing.vtu"));
  ASSERT_TRUE(viewer.next_request());
  EXPECT_FALSE(viewer.outdated());
  viewer.give_up();
  EXPECT_TRUE(viewer.outdated());
  EXPECT_EQ(viewer.command("a.png"), command);
  EXPECT_TRUE(viewer.refusal().starts_with("given up: ")) << viewer.refusal();
  auto given_up = std::make_unique<Drawn>();
  given_up->interrupted = true;
  viewer.accept(std::move(given_up));
  finish(viewer);
  EXPECT_TRUE(viewer.complete()) << viewer.error();
  EXPECT_EQ(viewer.command("a.png"), command);
}

TEST_F(ViewerTest, NoPixelsNoPicture) {
  Viewer viewer(arguments(), {});
  for (const auto& [width, height] : {std::pair{0, 0}, {0, 5}, {5, 0}}) {
    viewer.resize(width, height);
    EXPECT_FALSE(viewer.next_request());
  }
  viewer.resize(1, 1);
  finish(viewer);
  EXPECT_TRUE(viewer.complete()) << viewer.error();
}

TEST_F(ViewerTest, VerifiesThePictureInFull) {
  Viewer viewer(arguments(), {});
  viewer.resize(60, 50);
  finish(viewer);
  viewer.verify(50);
  finish(viewer);
  ASSERT_TRUE(viewer.verified());
  EXPECT_EQ(viewer.verified()->pixels, 50U);
  EXPECT_LT(viewer.verified()->max_error, 1e-5);
  viewer.orbit({0.1, 0});
  EXPECT_FALSE(viewer.verified()) << "of another picture";
}

TEST_F(ViewerTest, FramesTheMeshFromASide) {
  Viewer viewer(arguments(), {});
  viewer.resize(60, 60);
  finish(viewer);
  viewer.look_from({0, 0, 1});
  finish(viewer);
  const project::Camera camera = *viewer.camera();
  EXPECT_NEAR((camera.eye - camera.target).normalized().z(), 1, 1e-12);
  viewer.zoom(5, {0, 0});
  viewer.pan({1, 1});
  viewer.frame();
  finish(viewer);
  EXPECT_NEAR((viewer.camera()->eye - camera.eye).norm(), 0, 1e-9);
}

// Lights of the window are drawn, and go to a file that the command line names.
TEST_F(ViewerTest, LightsAreThoseOfTheCommandLine) {
  RenderArguments lit = arguments();
  lit.mode = "iso";
  Viewer viewer(lit, {});
  viewer.resize(60, 50);
  finish(viewer);
  ASSERT_TRUE(viewer.complete()) << viewer.error();
  EXPECT_FALSE(viewer.facts()->lights);
  const std::vector<float> headlight = viewer.picture()->image.rgba;
  project::Lights lights;
  lights.ambient = {0.1, 0.2, 0.3};
  lights.lights.emplace_back(project::PointLight{{3, -2, 1.5}, {1, 0.1, 0.7}});
  viewer.set_lights(lights);
  finish(viewer);
  const std::vector<float> image = viewer.picture()->image.rgba;
  EXPECT_NE(image, headlight);
  EXPECT_EQ(image, rendered(viewer).rgba);
  ASSERT_TRUE(viewer.facts()->lights);

  const fs::path before = fs::current_path();
  fs::current_path(folder().file(""));
  const CopiedCommand copied = viewer.copy_command();
  ASSERT_EQ(copied.files.size(), 1U);
  EXPECT_NE(copied.line.find("--lights " + copied.files[0]), std::string::npos) << copied.line;
  std::string line = copied.line.substr(std::string("tetraglass ").size());
  const tests::ProgramRun run = tests::run_program(line + " -o lit.npy");
  EXPECT_EQ(run.status, 0) << run.err;
  const project::Image drawn = project::read_image("lit.npy").image;
  fs::current_path(before);
  EXPECT_EQ(drawn.rgba, image);

  viewer.set_lights(std::nullopt);
  finish(viewer);
  EXPECT_EQ(viewer.picture()->image.rgba, headlight);
}

// What is kept of a field is not taken for another one's.
TEST_F(ViewerTest, AnotherFieldIsAnother) {
  Viewer viewer(arguments(), {});
  viewer.resize(60, 50);
  finish(viewer);
  for (const char* field : {"x", "radius", ""}) {
    viewer.set_field(field);
    finish(viewer);
    ASSERT_TRUE(viewer.complete()) << viewer.error();
    EXPECT_EQ(viewer.picture()->image.rgba, rendered(viewer).rgba) << field;
  }
}

}  // namespace
}  // namespace tetraglass::apps::view
