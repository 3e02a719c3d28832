#include "apps/figure.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "apps/box_axes.h"
#include "apps/ink.h"
#include "apps/orbit.h"
#include "base/errors.h"
#include "project/render.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"
#include "tests/support/temporary_folder.h"

namespace tetraglass::apps {
namespace {

const Eigen::AlignedBox3d kBox(Eigen::Vector3d(-1, -0.5, -2), Eigen::Vector3d(1, 0.75, 2));

class FigureTest : public testing::Test {
 protected:
  FigureTest()
      : mesh_(tests::box(kBox.min(), kBox.max(), 2, 2, 2,
                         [](const Eigen::Vector3d& p) { return p.x(); })) {
    arguments_.size = "400x300";
    arguments_.opacity = "given";
  }

  mesh::TetMesh mesh_;
  RenderArguments arguments_;
};

TEST_F(FigureTest, NothingAskedForChangesNoBit) {
  const project::Scene scene = make_scene(arguments_, mesh_);
  EXPECT_EQ(scene.width, 400);
  EXPECT_EQ(scene.height, 300);
  EXPECT_TRUE(scene.opaque.empty());
  project::Image picture(400, 300);
  std::mt19937 random;
  for (float& value : picture.rgba) value = static_cast<float>(random()) * 1e-9F;
  const Figure figure(arguments_, scene, 400, 300);
  EXPECT_EQ(figure.around(picture, scene.camera).rgba, picture.rgba);
}

TEST_F(FigureTest, ThePictureItselfIsNotTouched) {
  arguments_.figure.legend = true;
  arguments_.figure.title = "Ünïcödé ∇·u";
  const project::Scene scene = make_scene(arguments_, mesh_);
  const Figure figure(arguments_, scene, 400, 300);
  ASSERT_LT(scene.width, 400);
  ASSERT_LT(scene.height, 300);
  project::Image picture(scene.width, scene.height);
  std::mt19937 random;
  for (float& value : picture.rgba) value = static_cast<float>(random()) * 1e-9F;
  const project::Image whole = figure.around(picture, scene.camera);
  ASSERT_EQ(whole.width, 400);
  ASSERT_EQ(whole.height, 300);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      for (int c = 0; c < 4; ++c) {
        ASSERT_EQ(whole.pixel(x, y + 300 - picture.height)[c], picture.pixel(x, y)[c]);
      }
    }
  }
}

/// The rows of the legend's bar of a figure, bottom first: in the column of the most colored
/// pixels.
std::vector<Eigen::Array3f> bar_of(const project::Image& image, int from_x) {
  const auto colored = [&](int x, int y) {
    const Eigen::Map<const Eigen::Array3f> rgb(image.pixel(x, y));
    return rgb.maxCoeff() - rgb.minCoeff() > 1e-3F;
  };
  int column = from_x;
  int most = 0;
  for (int x = from_x; x < image.width; ++x) {
    int count = 0;
    for (int y = 0; y < image.height; ++y) count += colored(x, y) ? 1 : 0;
    if (count > most) {
      most = count;
      column = x + 2;  // not at its edge
    }
  }
  std::vector<Eigen::Array3f> rows;
  for (int y = image.height - 1; y >= 0; --y) {
    if (colored(column, y))
      rows.emplace_back(Eigen::Map<const Eigen::Array3f>(image.pixel(column, y)));
  }
  return rows;
}

TEST_F(FigureTest, TheBarHasTheColorsOfTheTransferFunction) {
  arguments_.figure.legend = true;
  for (const std::string mode : {"full", "emission", "mip"}) {
    arguments_.mode = mode;
    const project::Scene scene = make_scene(arguments_, mesh_);
    const Figure figure(arguments_, scene, 400, 300);
    const project::Image image =
        figure.around(project::Image(scene.width, scene.height), scene.camera);
    const std::vector<Eigen::Array3f> rows = bar_of(image, scene.width);
    ASSERT_GT(rows.size(), 100U) << mode;
    const auto n = static_cast<double>(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double value = -1 + 2 * (static_cast<double>(i) + 0.5) / n;
      const preint::Color expected = scene.transfer_function.at(value).color;
      EXPECT_LT((rows[i].cast<double>() - expected).abs().maxCoeff(), 0.01) << mode << ' ' << i;
    }
  }
}

TEST_F(FigureTest, IsosurfacesHaveASwatchEach) {
  arguments_.figure.legend = true;
  arguments_.mode = "iso";
  arguments_.isovalues = {"-0.5", "0.5"};
  arguments_.iso_colors = {"1,0,0", "0,0,1"};
  const project::Scene scene = make_scene(arguments_, mesh_);
  const Figure figure(arguments_, scene, 400, 300);
  const std::vector<Eigen::Array3f> rows =
      bar_of(figure.around(project::Image(scene.width, scene.height), scene.camera), scene.width);
  ASSERT_GT(rows.size(), 10U);
  EXPECT_TRUE(rows.front().isApprox(Eigen::Array3f(1, 0, 0))) << "the lower value below";
  EXPECT_TRUE(rows.back().isApprox(Eigen::Array3f(0, 0, 1)));
}

// Contrast as WCAG 2.1 wants it: 4.5 to 1, which no ink much exceeds on a middle gray.
TEST_F(FigureTest, TextCanBeReadOnEveryBackground) {
  arguments_.figure.title = "MMMM";
  for (const std::string background :
       {"0,0,0", "1,1,1", "0.1,0.1,0.4", "0.9,0.6,0.1", "0.175,0.175,0.175", "0.185,0.185,0.185"}) {
    arguments_.background = background;
    const project::Scene scene = make_scene(arguments_, mesh_);
    const project::Background behind = make_background(arguments_, scene.mode);
    const Figure figure(arguments_, scene, 400, 300);
    const project::Image image =
        figure.around(project::Image(scene.width, scene.height), scene.camera);
    const double paper = 0.2126 * behind.rgb[0] + 0.7152 * behind.rgb[1] + 0.0722 * behind.rgb[2];
    double best = 1;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
      if (image.rgba[i + 3] < 1) continue;
      const double ink = static_cast<double>(image.rgba[i]);
      best = std::max(best, (std::max(ink, paper) + 0.05) / (std::min(ink, paper) + 0.05));
    }
    EXPECT_GT(best, 4.5) << background;
  }
  // What the background is, is not known: both dark and light are there.
  arguments_.background = "0,0,0,0";
  const project::Scene scene = make_scene(arguments_, mesh_);
  const Figure figure(arguments_, scene, 400, 300);
  const project::Image image =
      figure.around(project::Image(scene.width, scene.height), scene.camera);
  bool dark = false;
  bool light = false;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    dark = dark || (image.rgba[i + 3] > 0.9F && image.rgba[i] < 0.1F);
    light = light || image.rgba[i] > 0.7F;
  }
  EXPECT_TRUE(dark && light);
}

TEST_F(FigureTest, WhatHasNoPlaceIsRefused) {
  const auto refuses = [&](const auto& change) {
    RenderArguments arguments = arguments_;
    change(arguments);
    EXPECT_THROW((void)make_scene(arguments, mesh_), base::UsageError);
  };
  for (bool FigureArguments::*option : {&FigureArguments::legend, &FigureArguments::axes}) {
    refuses([&](RenderArguments& a) { a.figure.*option = true, a.mode = "thickness"; });
    refuses([&](RenderArguments& a) { a.figure.*option = true, a.region = "0,0,10,10"; });
    refuses([&](RenderArguments& a) { a.figure.*option = true, a.size = "40x30"; });
  }
  refuses([&](RenderArguments& a) { a.figure.legend_title = "T"; });
  refuses([&](RenderArguments& a) { a.figure.surface_color = "1,0,0"; });
}

TEST_F(FigureTest, ALongTitleIsCut) {
  arguments_.figure.legend = true;
  arguments_.figure.legend_title = std::string(300, 'W');
  const project::Scene scene = make_scene(arguments_, mesh_);
  EXPECT_GT(scene.width, 200);
  const Font font{14, false};
  const std::string cut = shortened("äöü äöü äöü äöü", font, 60);
  EXPECT_LE(text_size(cut, font).x(), 60);
  EXPECT_TRUE(cut.ends_with("…"));
  EXPECT_EQ(shortened("short", font, 600), "short");
}

// File and field names may be in any encoding.
TEST_F(FigureTest, TextThatIsNoUtf8IsSetAllTheSame) {
  EXPECT_EQ(printable("caf\xe9 \xff x\ny"), "caf? ? x y");
  EXPECT_EQ(printable("ψ²·10⁻³ 😀"), "ψ²·10⁻³ 😀");
  EXPECT_EQ(printable("\xc0\x80 \xed\xa0\x80 \xf4\x90\x80\x80 \xe2\x82"), "?? ??? ???? ??");
  arguments_.figure.title = "\xff";
  arguments_.figure.legend = true;
  const project::Scene scene = make_scene(arguments_, mesh_);
  const Figure figure(arguments_, scene, 400, 300);
  const project::Image image =
      figure.around(project::Image(scene.width, scene.height), scene.camera);
  const int top = 300 - scene.height;
  bool title = false;
  for (std::size_t i = 0; i < 4 * 400 * static_cast<std::size_t>(top); ++i)
    title = title || image.rgba[i] > 0.5F;
  EXPECT_TRUE(title) << "the question mark";
}

TEST_F(FigureTest, SurfacesBelongToTheBox) {
  arguments_.figure.outline = true;
  const tests::TemporaryFolder folder;
  tests::write_text(folder.file("s.off"), "OFF\n3 1 0\n0 0 0\n5 0 0\n0 0 -3\n3 0 1 2\n");
  arguments_.figure.surfaces = {folder.file("s.off")};
  const project::Scene scene = make_scene(arguments_, mesh_);
  const mesh::Box box = drawn_box(scene);
  EXPECT_EQ(box.min(), Eigen::Vector3d(-1, -0.5, -3));
  EXPECT_EQ(box.max(), Eigen::Vector3d(5, 0.75, 2));
  ASSERT_EQ(scene.opaque.lines.size(), 12U);
  mesh::Box lines;
  for (const project::OpaqueLine& line : scene.opaque.lines)
    lines.extend(line.from).extend(line.to);
  EXPECT_TRUE(lines.isApprox(box));
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Whether the point lies within the picture of the box: on one side of all edges of the outline.
bool covers(const std::vector<Eigen::Vector2d>& corners, const Eigen::Vector2d& p) {
  // Not if some line through the point has all corners on one side.
  for (int i = 0; i < 360; ++i) {
    const double angle = i * M_PI / 180;
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    if (std::all_of(corners.begin(), corners.end(),
                    [&](const Eigen::Vector2d& c) { return cross(direction, c - p) > 0; })) {
      return false;
    }
  }
  return true;
}

TEST_F(FigureTest, AxesAreAroundTheBoxAndInThePicture) {
  arguments_.figure.axes = true;
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 60; ++trial) {
    const Eigen::Vector3d direction(normal(random), normal(random), normal(random));
    arguments_.view = std::to_string(direction.x()) + "," + std::to_string(direction.y()) + "," +
                      std::to_string(direction.z());
    arguments_.fov = trial % 3 == 1 ? "70" : "";
    arguments_.ortho = trial % 3 == 2 ? "6.5" : "";
    const project::Scene scene = make_scene(arguments_, mesh_);
    const project::Frame frame(scene.camera, scene.width, scene.height);
    const BoxAxes axes(kBox, frame, 0.5);
    EXPECT_GE(axes.shown().size(), 2U) << arguments_.view;
    const Eigen::AlignedBox2d picture(Eigen::Vector2d(0, 0), Eigen::Vector2d(400, 300));
    EXPECT_TRUE(picture.contains(axes.extent()))
        << arguments_.view << " fov " << arguments_.fov << " ortho " << arguments_.ortho << ": "
        << axes.extent().min().transpose() << " to " << axes.extent().max().transpose();
    std::vector<Eigen::Vector2d> corners;
    for (int i = 0; i < 8; ++i) {
      const Eigen::Vector3d p =
          frame.to_camera(kBox.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)));
      const Eigen::Vector2d plane =
          frame.parallel() ? p.head<2>() : Eigen::Vector2d(p.head<2>() / p.z());
      corners.emplace_back(frame.pixel(plane).array() + 0.5);
    }
    const std::vector<Eigen::AlignedBox2d>& places = axes.label_places();
    ASSERT_GE(places.size(), 3U);
    for (std::size_t i = 0; i < places.size(); ++i) {
      EXPECT_FALSE(covers(corners, places[i].center())) << arguments_.view << " label " << i;
      for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(places[i].intersects(places[j]));
    }
  }
}

TEST_F(FigureTest, TheEyeInTheBoxHasNoAxes) {
  project::Camera camera;
  camera.eye = {0, 0, 0};
  camera.target = {1, 0, 0};
  camera.up = {0, 0, 1};
  const BoxAxes axes(kBox, project::Frame(camera, 400, 300), 0.5);
  EXPECT_TRUE(axes.shown().empty());
  EXPECT_TRUE(axes.extent().isEmpty());
}

// Whatever the angle, the orbit shows the whole mesh; and axes, where they are asked for.
TEST_F(FigureTest, AnOrbitKeepsAllInThePicture) {
  arguments_.orbit = "24";
  for (const bool with_axes : {false, true}) {
    arguments_.figure.axes = with_axes;
    for (const std::string view : {"1,0.8,0.6", "-0.2,1,3", "z"}) {
      arguments_.view = view;
      const project::Scene scene = make_scene(arguments_, mesh_);
      const Eigen::Vector3d pivot = orbit_pivot(arguments_, scene);
      for (const project::Camera& camera : orbit(scene.camera, pivot, 24)) {
        const project::Frame frame(camera, scene.width, scene.height);
        for (const Eigen::Vector3d& point : mesh_.points) {
          const Eigen::Vector3d p = frame.to_camera(point);
          ASSERT_GT(p.z(), 0);
          const Eigen::Vector2d pixel = frame.pixel(p.head<2>() / p.z());
          ASSERT_TRUE(pixel.x() > 0 && pixel.x() < 399 && pixel.y() > 0 && pixel.y() < 299) << view;
        }
        if (with_axes) {
          const Eigen::AlignedBox2d picture(Eigen::Vector2d(0, 0), Eigen::Vector2d(400, 300));
          EXPECT_TRUE(picture.contains(BoxAxes(kBox, frame, 0.5).extent())) << view;
        }
        EXPECT_NEAR((camera.eye - pivot).norm(), (scene.camera.eye - pivot).norm(), 1e-9);
        EXPECT_NEAR((camera.eye - pivot).dot(camera.up), (scene.camera.eye - pivot).dot(camera.up),
                    1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace tetraglass::apps
