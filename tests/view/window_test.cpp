// The real window, on a virtual display, with real mouse and key events.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <sstream>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "project/image_file.h"
#include "tests/support/program.h"
#include "tests/view/drag_source.h"
#include "tests/view/virtual_display.h"

namespace tetraglass::tests {
namespace {

namespace fs = std::filesystem;
using project::Image;

constexpr int kPictureWidth = 300;
constexpr int kPictureHeight = 700;

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// The largest difference of two pictures in [0, 1], over the rows of `a`.
double difference(const Image& a, const Image& b) {
  double most = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      for (int c = 0; c < 3; ++c)
        most = std::max(most, std::abs(static_cast<double>(a.pixel(x, y)[c]) - b.pixel(x, y)[c]));
    }
  }
  return most;
}

constexpr double kOneOf255 = 1.0 / 255 + 1e-6;

class WindowTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!is_installed("Xvfb") || !is_installed("xdotool"))
      GTEST_SKIP() << "Xvfb and xdotool are not installed (scripts/setup does it)";
    ASSERT_EQ(
        run_program("sample sphere --cells 3000 -o '" + folder_.file("sphere.vtu") + "'").status,
        0);
    display_ = std::make_unique<VirtualDisplay>();
    ASSERT_TRUE(display_->ready());
  }

  void TearDown() override {
    if (HasFailure()) {
      std::cerr << "stdout: " << read_text(folder_.file("out"))
                << "stderr: " << read_text(folder_.file("err"));
    }
  }

  /// Starts the program and waits for its window and its first picture.
  void open(const std::vector<std::string>& options) {
    start({"sphere.vtu", "--size", fmt::format("{}x{}", kPictureWidth, kPictureHeight)}, options);
  }

  void start(const std::vector<std::string>& first, const std::vector<std::string>& options = {}) {
    std::vector<std::string> words = {TETRAGLASS_PROGRAM, "view"};
    words.insert(words.end(), first.begin(), first.end());
    words.insert(words.end(), options.begin(), options.end());
    program_ = std::make_unique<Beside>(words, [this] {
      ::setenv("DISPLAY", display_->name().c_str(), 1);
      if (::chdir(folder_.file("").c_str()) != 0) ::_exit(126);
      ::dup2(::open("out", O_WRONLY | O_CREAT | O_TRUNC, 0600), 1);
      ::dup2(::open("err", O_WRONLY | O_CREAT | O_TRUNC, 0600), 2);
    });
    // Focusing a window that is not there yet, or not shown yet, fails.
    ASSERT_TRUE(wait_until([&] {
      return !program_->running() ||
             xdotool("search --onlyvisible --name 'sphere.vtu - tetraglass' windowfocus --sync") ==
                 0;
    }));
    ASSERT_TRUE(program_->running());
  }

  [[nodiscard]] int xdotool(const std::string& words) const {
    return std::system(
        fmt::format("DISPLAY={} timeout 30 xdotool {} >/dev/null 2>&1", display_->name(), words)
            .c_str());
  }

  /// Presses a key and returns the line that the window prints for it, the last of `count`.
  std::string ask(const std::string& key, std::size_t count = 1) {
    const std::size_t before = lines_of(read_text(folder_.file("out"))).size();
    EXPECT_EQ(xdotool("key " + key), 0);
    std::vector<std::string> lines;
    EXPECT_TRUE(wait_until([&] {
      lines = lines_of(read_text(folder_.file("out")));
      return lines.size() >= before + count || !program_->running();
    })) << key;
    return lines.size() >= before + count ? lines[before + count - 1] : "";
  }

  [[nodiscard]] Image picture(const std::string& file) const {
    return project::read_image(folder_.file(file)).image;
  }

  /// The picture that the copied command line makes.
  Image rendered(const std::string& line, const std::string& file) {
    const std::string program = "tetraglass ";
    EXPECT_TRUE(line.starts_with(program)) << line;
    const std::string command =
        fmt::format("cd '{}' && '{}' {} 2>err-of-render", folder_.file(""), TETRAGLASS_PROGRAM,
                    line.substr(program.size()) + " >'" + file + ".out'");
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    const std::vector<std::string> made = lines_of(read_text(folder_.file(file + ".out")));
    return made.empty() ? Image() : picture(made.front());
  }

  /// The middle of each control point in the plot: white disks in the panel, left of the picture.
  static std::vector<Eigen::Vector2i> control_points(const Image& window) {
    constexpr int kRadius = 3;
    const int panel = window.width - kPictureWidth;
    std::vector<Eigen::Vector2i> found;
    const auto is_white = [&](int x, int y) {
      const float* pixel = window.pixel(x, y);
      return pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1;
    };
    for (int y = kRadius; y < window.height - kRadius; ++y) {
      for (int x = kRadius; x < panel - kRadius; ++x) {
        bool disk = true;
        for (int dy = -kRadius; disk && dy <= kRadius; ++dy) {
          for (int dx = -kRadius; disk && dx <= kRadius; ++dx)
            disk = dx * dx + dy * dy > kRadius * kRadius || is_white(x + dx, y + dy);
        }
        if (disk && (found.empty() || (found.back() - Eigen::Vector2i(x, y)).norm() > 5))
          found.emplace_back(x, y);
      }
    }
    return found;
  }

  /// Of the color of errors, within the smoothing of letters.
  static std::vector<Eigen::Vector2i> red_pixels(const Image& window) {
    std::vector<Eigen::Vector2i> found;
    for (int y = 0; y < window.height; ++y) {
      for (int x = 0; x < window.width; ++x) {
        const float* pixel = window.pixel(x, y);
        const Eigen::Vector3d color(pixel[0], pixel[1], pixel[2]);
        if ((255 * color - Eigen::Vector3d(255, 150, 130)).cwiseAbs().maxCoeff() < 8)
          found.emplace_back(x, y);
      }
    }
    return found;
  }

  /// With real events, in steps as a hand makes them.
  void drag(const Eigen::Vector2i& from, const Eigen::Vector2i& to) {
    std::string words = fmt::format("mousemove {} {} mousedown 1", from.x(), from.y());
    constexpr int kSteps = 5;
    for (int i = 1; i <= kSteps; ++i) {
      const Eigen::Vector2i place = from + i * (to - from) / kSteps;
      words += fmt::format(" sleep 0.05 mousemove {} {}", place.x(), place.y());
    }
    EXPECT_EQ(xdotool(words + " sleep 0.05 mouseup 1"), 0);
  }

  void quit() {
    EXPECT_EQ(xdotool("key q"), 0);
    ASSERT_TRUE(wait_until([&] { return !program_->running(); }));
    EXPECT_EQ(program_->exit_status(), 0);
  }

  TemporaryFolder folder_;
  std::unique_ptr<VirtualDisplay> display_;
  std::unique_ptr<Beside> program_;
};

// What is explored can be published: after editing the colors with the mouse, turning the mesh and
// changing the mode, the saved picture is what the window shows and what the copied command draws.
TEST_F(WindowTest, ThePictureIsThatOfTheCopiedCommandLine) {
  ASSERT_NO_FATAL_FAILURE(open({"--range", "0.2:1.5"}));
  const Image first = picture(ask("s"));
  ASSERT_EQ(first.width, kPictureWidth);
  ASSERT_EQ(first.height, kPictureHeight);

  const Image window = picture(ask("F12"));
  // The message of what was saved covers the lower left corner.
  Image shown(kPictureWidth, kPictureHeight / 2);
  for (int y = 0; y < shown.height; ++y) {
    std::copy_n(window.pixel(window.width - kPictureWidth, y), 4 * kPictureWidth,
                shown.pixel(0, y));
  }
  EXPECT_LE(difference(shown, first), kOneOf255);

  const std::vector<Eigen::Vector2i> points = control_points(window);
  ASSERT_GE(points.size(), 3U);
  const Eigen::Vector2i point = points[points.size() / 2];
  drag(point, point + Eigen::Vector2i(8, 25));
  const Image edited = picture(ask("s", 2).empty() ? "" : "sphere-2.png");
  EXPECT_GT(difference(edited, first), 0.02);
  EXPECT_TRUE(fs::exists(folder_.file("sphere-2.tf.json")));
  EXPECT_LE(difference(edited, rendered(ask("c", 2), "edited")), kOneOf255);

  const Eigen::Vector2i middle(window.width - kPictureWidth / 2, kPictureHeight / 2);
  drag(middle, middle + Eigen::Vector2i(60, 40));
  ASSERT_EQ(xdotool("key m"), 0);
  (void)ask("s", 2);
  const std::string command = ask("c", 2);
  EXPECT_NE(command.find("--mode emission"), std::string::npos) << command;
  const Image turned = picture("sphere-4.png");
  EXPECT_GT(difference(turned, edited), 0.02);
  EXPECT_LE(difference(turned, rendered(command, "turned")), kOneOf255);

  // Back to the preset, and in mode iso.
  ASSERT_EQ(xdotool("key ctrl+z key m key m key m"), 0);
  const Image surface = picture(ask("s"));
  const std::string iso = ask("c");
  EXPECT_NE(iso.find("--mode iso"), std::string::npos) << iso;
  EXPECT_EQ(iso.find("--tf"), std::string::npos) << iso;
  EXPECT_LE(difference(surface, rendered(iso, "surface")), kOneOf255);
  quit();
}

// A session opens as it was left; the gl projector draws on the display's OpenGL.
TEST_F(WindowTest, ASessionOpensAgain) {
  ASSERT_NO_FATAL_FAILURE(open({"--projector", "gl", "--clip", "1,0,0,0.25", "--outline", "--axes",
                                "--legend", "--title", "A sphere's distance"}));
  const std::vector<Eigen::Vector2i> points = control_points(picture(ask("F12")));
  ASSERT_GE(points.size(), 3U);
  drag(points[1], points[1] + Eigen::Vector2i(0, 20));
  ASSERT_EQ(xdotool("key p key 5"), 0);
  (void)ask("s", 2);
  const Image before = picture("sphere-1.png");
  EXPECT_LE(difference(before, rendered(ask("c", 2), "command")), kOneOf255);
  const std::string session = ask("ctrl+s", 2).empty() ? "" : "sphere-3.session.json";
  ASSERT_TRUE(fs::exists(folder_.file(session)));
  quit();
  ASSERT_NO_FATAL_FAILURE(start({session}));
  EXPECT_LE(difference(before, picture(ask("s"))), kOneOf255);
  quit();
  // Its camera alone is good for render.
  const std::string figure = "--outline --axes --legend --title \"A sphere's distance\"";
  const Image rest =
      rendered("tetraglass render sphere.vtu --size 300x700 --projector gl --clip 1,0,0,0.25 " +
                   figure + " --tf sphere-3.tf.json -o rest.png --camera " + session,
               "rest");
  EXPECT_LE(difference(before, rest), kOneOf255);
}

TEST_F(WindowTest, TinyAndHiddenWindowsAndAFileThatVanishes) {
  ASSERT_NO_FATAL_FAILURE(open({"--mode", "emission"}));
  (void)ask("s");
  const std::string window = "search --name 'sphere.vtu - tetraglass' ";
  ASSERT_EQ(xdotool(window + "windowsize 1 1"), 0);
  (void)ask("c");
  ASSERT_EQ(xdotool(window + "windowunmap --sync windowmap --sync"), 0);
  fs::remove(folder_.file("sphere.vtu"));
  ASSERT_EQ(xdotool(window + "windowsize 500 400"), 0);
  ASSERT_TRUE(wait_until([&] { return xdotool(window + "windowfocus --sync") == 0; }));
  EXPECT_EQ(ask("F12"), "window-1.png");
  // Until the window has its new size, pictures have the old one.
  EXPECT_TRUE(wait_until([&] {
    const Image seen = picture(ask("F12"));
    return seen.width == 500 && seen.height == 400;
  }));
  EXPECT_TRUE(program_->running());
  quit();
}

// Steps of time play round and round until they are stopped.
TEST_F(WindowTest, PlaysTheTimeSteps) {
  ASSERT_EQ(run_program("sample sphere --cells 1000 -o '" + folder_.file("other.vtu") + "'").status,
            0);
  write_text(folder_.file("sphere.vtu - tetraglass.pvd"),
             "<VTKFile type=\"Collection\" version=\"0.1\"><Collection>"
             "<DataSet timestep=\"0\" file=\"sphere.vtu\"/>"
             "<DataSet timestep=\"2\" file=\"other.vtu\"/></Collection></VTKFile>");
  ASSERT_NO_FATAL_FAILURE(start({"sphere.vtu - tetraglass.pvd", "--size", "200x500"}));
  const Image last = picture(ask("s"));
  ASSERT_EQ(xdotool("key space"), 0);
  // Sooner or later each step is asked for by the command line.
  for (const std::string step : {"--time index:0", "--time index:1"}) {
    EXPECT_TRUE(wait_until([&] { return ask("c").find(step) != std::string::npos; })) << step;
  }
  ASSERT_EQ(xdotool("key space"), 0);
  quit();
}

// A step whose file is gone is told of, and the picture of the last one stays; the file of that one
// is not needed any more.
TEST_F(WindowTest, AFileOfATimeStepThatVanishes) {
  ASSERT_EQ(run_program("sample sphere --cells 1000 -o '" + folder_.file("other.vtu") + "'").status,
            0);
  write_text(folder_.file("sphere.vtu - tetraglass.pvd"),
             "<VTKFile type=\"Collection\" version=\"0.1\"><Collection>"
             "<DataSet timestep=\"0\" file=\"sphere.vtu\"/>"
             "<DataSet timestep=\"2\" file=\"other.vtu\"/></Collection></VTKFile>");
  ASSERT_NO_FATAL_FAILURE(
      start({"sphere.vtu - tetraglass.pvd", "--size", "200x500", "--time", "index:0"}));
  const Image before = picture(ask("s"));
  const Image clean = picture(ask("F12"));
  fs::remove(folder_.file("sphere.vtu"));
  fs::remove(folder_.file("other.vtu"));
  ASSERT_EQ(xdotool("key space"), 0);
  // The message stands on the lower left of the picture, in red.
  EXPECT_TRUE(wait_until([&] {
    const Image window = picture(ask("F12"));
    return std::ranges::any_of(red_pixels(window),
                               [](const Eigen::Vector2i& place) { return place.y() > 350; });
  }));
  EXPECT_TRUE(red_pixels(clean).empty());
  const std::string command = ask("c");
  EXPECT_NE(command.find("--time index:0"), std::string::npos) << command;
  EXPECT_LE(difference(before, picture(ask("s"))), kOneOf255);
  // It can be turned still, and the message goes.
  ASSERT_EQ(xdotool("key 3"), 0);
  EXPECT_TRUE(wait_until([&] { return red_pixels(picture(ask("F12"))).empty(); }));
  EXPECT_GT(difference(before, picture(ask("s"))), 0.02);
  quit();
}

// A file from a file manager opens by its defaults; one that is none leaves everything as it was.
TEST_F(WindowTest, TakesFilesThatAreDropped) {
  ASSERT_EQ(run_program("sample linear --cells 600 -o '" + folder_.file("a cube.vtu") + "'").status,
            0);
  write_text(folder_.file("notes.txt"), "no mesh");
  ASSERT_NO_FATAL_FAILURE(open({"--mode", "emission", "--title", "kept"}));
  const Image before = picture(ask("s"));
  const std::string uri = "file://" + folder_.file("");
  ASSERT_EQ(drop_on_window(display_->name(), "sphere.vtu - tetraglass", uri + "notes.txt\r\n"), "");
  EXPECT_TRUE(wait_until([&] { return !red_pixels(picture(ask("F12"))).empty(); }));
  EXPECT_LE(difference(before, picture(ask("s"))), kOneOf255);
  const std::string same = ask("c");
  EXPECT_NE(same.find("sphere.vtu"), std::string::npos) << same;
  EXPECT_NE(same.find("--title kept"), std::string::npos) << same;

  ASSERT_EQ(drop_on_window(display_->name(), "sphere.vtu - tetraglass", uri + "a%20cube.vtu\r\n"),
            "");
  const Image dropped = picture(ask("s"));
  const std::string command = ask("c");
  EXPECT_NE(command.find("a cube.vtu"), std::string::npos) << command;
  EXPECT_EQ(xdotool("search --name 'a cube.vtu - tetraglass'"), 0);
  EXPECT_EQ(command.find("emission"), std::string::npos) << command;
  EXPECT_GT(difference(before, dropped), 0.02);
  EXPECT_LE(difference(dropped, rendered(command, "dropped")), kOneOf255);
  quit();
}

// The display goes away under the window, and its OpenGL with it: a line, and an end that is no
// crash, at rest and while something is drawn.
TEST_F(WindowTest, ADisplayThatVanishes) {
  for (const std::string projector : {"cpu", "gl"}) {
    if (!display_) display_ = std::make_unique<VirtualDisplay>();
    ASSERT_TRUE(display_->ready());
    ASSERT_NO_FATAL_FAILURE(open({"--projector", projector}));
    if (projector == "cpu") {
      (void)ask("s");
    } else {
      ASSERT_EQ(xdotool("key 5 key 3 key 5"), 0);
    }
    display_.reset();
    ASSERT_TRUE(wait_until([&] { return !program_->running(); }));
    EXPECT_EQ(program_->exit_status(), 1) << projector;
    const std::string err = read_text(folder_.file("err"));
    EXPECT_NE(err.find("tetraglass: error: the display is gone, and the window with it\n"),
              std::string::npos)
        << err;
    for (const std::string& line : lines_of(err))
      EXPECT_TRUE(line.starts_with("tetraglass: ")) << line;
  }
}

// A display without OpenGL: remote desktops, drivers that are not installed.
TEST(Window, WithoutOpenGlThereIsOneLine) {
  if (!is_installed("Xvfb")) GTEST_SKIP() << "Xvfb is not installed (scripts/setup does it)";
  const TemporaryFolder folder;
  const std::string mesh = folder.file("sphere.vtu");
  ASSERT_EQ(run_program("sample sphere --cells 100 -o '" + mesh + "'").status, 0);
  const VirtualDisplay display({"-extension", "GLX"});
  ASSERT_TRUE(display.ready());
  ::setenv("DISPLAY", display.name().c_str(), 1);
  const ProgramRun run = run_program("view '" + mesh + "'");
  ::unsetenv("DISPLAY");
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(lines_of(run.err).size(), 1U) << run.err;
  EXPECT_TRUE(run.err.starts_with("tetraglass: error: the display has no OpenGL 3.3")) << run.err;
}

TEST(Window, WithoutADisplayThereIsOneLine) {
  const TemporaryFolder folder;
  const std::string mesh = folder.file("sphere.vtu");
  ASSERT_EQ(run_program("sample sphere --cells 100 -o '" + mesh + "'").status, 0);
  for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY"}) ::unsetenv(name);
  const ProgramRun run = run_program("view '" + mesh + "'");
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(lines_of(run.err).size(), 1U) << run.err;
  EXPECT_NE(run.err.find("tetraglass: error: no window can be opened"), std::string::npos);
  const ProgramRun missing = run_program("view no-such.vtu");
  EXPECT_EQ(missing.status, 1);
  EXPECT_EQ(missing.err, "tetraglass: error: no-such.vtu: there is no such file\n");
  EXPECT_EQ(run_program("view '" + mesh + "' --projector cppu").status, 2);
}

}  // namespace
}  // namespace tetraglass::tests
