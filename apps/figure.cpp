#include "apps/figure.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "apps/box_axes.h"
#include "apps/color_legend.h"
#include "apps/ink.h"
#include "apps/options.h"
#include "mesh/read_surface.h"
#include "mesh/triangle_surface.h"

namespace tetraglass::apps {
namespace {

// In a picture of 800 x 600 pixels.
constexpr double kTitleSize = 21;
constexpr double kTitleRoom = 48;
constexpr double kLegendGap = 14;
constexpr double kLegendMargin = 20;
constexpr double kAxesMargin = 12;

Font title_font(double scale) {
  return {kTitleSize * scale, true};
}

/// A gray that stands out a little from the background.
preint::Color outline_color(const project::Background& background) {
  if (background.alpha < 0.5) return preint::Color::Constant(0.22);
  const double luminance =
      0.2126 * background.rgb[0] + 0.7152 * background.rgb[1] + 0.0722 * background.rgb[2];
  return preint::Color::Constant(luminance > 0.18 ? 0.45 * luminance : 0.2 + luminance);
}

void refuse_impossible(const RenderArguments& arguments, const project::Scene& scene) {
  if (!arguments.figure.any()) return;
  if (scene.mode == project::Mode::thickness) {
    throw base::UsageError(
        "pictures of mode thickness hold lengths, not colors: --legend, --axes and --title have no "
        "place in them");
  }
  if (!arguments.region.empty()) {
    throw base::UsageError(
        "--region draws a part of the picture; --legend, --axes and --title need all of it");
  }
}

/// Files of other formats may hold surfaces, too, but as the surface of what is drawn.
void check_surface_name(const std::string& file) {
  const std::vector<std::string> known = {".stl", ".obj", ".off", ".ply"};
  std::string extension = std::filesystem::path(file).extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return std::tolower(c); });
  if (std::ranges::find(known, extension) != known.end()) return;
  throw base::ReadError(file, "is no surface for --surface, which reads .stl, .obj, .off and .ply");
}

}  // namespace

mesh::Box drawn_box(const project::Scene& scene) {
  mesh::Box box;
  for (const project::OpaqueSurface& surface : scene.opaque.surfaces) {
    for (const Eigen::Vector3d& point : surface.points) box.extend(point);
  }
  if (scene.drawable.cells.empty()) box.extend(mesh::bounds(*scene.mesh));
  for (const std::uint32_t cell : scene.drawable.cells) {
    for (const std::uint32_t vertex : scene.mesh->cells[cell]) {
      box.extend(scene.mesh->points[vertex]);
    }
  }
  return box;
}

void add_opaque_geometry(const RenderArguments& arguments, project::Scene& scene) {
  const FigureArguments& figure = arguments.figure;
  if (!figure.surface_color.empty() && figure.surfaces.empty()) {
    throw base::UsageError("--surface-color is that of --surface, which is not given");
  }
  preint::Color color(0.62, 0.6, 0.57);
  if (!figure.surface_color.empty()) {
    color = parse_vector(figure.surface_color, "--surface-color").array();
    if (!(color >= 0).all()) throw base::UsageError("--surface-color needs numbers of at least 0");
  }
  for (const std::string& file : figure.surfaces) {
    check_surface_name(file);
    std::vector<std::string> notes;
    try {
      mesh::TriangleSurface surface = mesh::collect_triangles(mesh::read_surface(file), notes);
      if (surface.triangles.empty()) throw base::InputError("has no faces to draw");
      scene.opaque.surfaces.push_back(
          project::shaded_surface(std::move(surface.points), std::move(surface.triangles), color));
    } catch (const base::InputError& error) {
      throw base::InputError(file + ": " + error.what());
    }
    for (const std::string& note : notes) fmt::print(stderr, "{}: {}\n", file, note);
  }
  if (figure.outline) {
    const double scale = std::min(scene.width / 800.0, scene.height / 600.0);
    scene.opaque.lines = project::box_outline(drawn_box(scene),
                                              outline_color(make_background(arguments, scene.mode)),
                                              1.5 * std::max(0.6, scale));
  }
}

Figure::Figure(const RenderArguments& arguments, const project::Scene& scene, int width, int height)
    : arguments_(arguments.figure),
      logarithmic_(arguments.logarithmic),
      scene_(scene),
      background_(make_background(arguments, scene.mode)),
      box_(arguments.figure.axes ? drawn_box(scene) : mesh::Box()),
      width_(width),
      height_(height),
      scale_(std::min(width / 800.0, height / 600.0)),
      picture_{0, 0, width, height} {
  refuse_impossible(arguments, scene);
  arguments_.title = printable(arguments_.title);
  arguments_.legend_title = printable(arguments_.legend_title);
  if (!arguments_.legend_title.empty() && !arguments_.legend) {
    throw base::UsageError("--legend-title is that of --legend, which is not given");
  }
  if (!arguments_.title.empty()) {
    picture_.y = static_cast<int>(std::lround(kTitleRoom * scale_));
    picture_.height -= picture_.y;
  }
  if (arguments_.legend) {
    const ColorLegend legend(scene, legend_title(), logarithmic_, scale_, 0.3 * width);
    picture_.width -=
        static_cast<int>(std::ceil(legend.width() + (kLegendGap + kLegendMargin) * scale_));
  }
  // Smaller, letters of 14 pixels in 600 have no 5 pixels left.
  constexpr double kLeastScale = 0.35;
  if (arguments_.any() && (scale_ < kLeastScale || 2 * picture_.width < width)) {
    throw base::UsageError(
        fmt::format("a picture of {} x {} pixels has no room for --legend, --axes and --title: "
                    "ask for a larger --size, or a shorter title of the legend",
                    width, height));
  }
}

std::string Figure::legend_title() const {
  return arguments_.legend_title.empty() ? printable(scene_.field.name) : arguments_.legend_title;
}

project::Image Figure::around(const project::Image& picture, const project::Camera& camera) const {
  if (!arguments_.any()) return picture;
  project::Image image(width_, height_);
  for (int y = 0; y < picture.height; ++y) {
    const float* row = picture.pixel(0, y);
    std::copy(row, row + 4 * static_cast<std::size_t>(picture.width),
              image.pixel(picture_.x, picture_.y + y));
  }
  Ink ink(width_, height_);
  if (arguments_.axes) {
    const project::Frame frame(camera, picture_.width, picture_.height);
    BoxAxes(box_, frame, scale_).draw(Eigen::Vector2d(picture_.x, picture_.y), ink);
  }
  if (arguments_.legend) {
    const ColorLegend legend(scene_, legend_title(), logarithmic_, scale_, 0.3 * width_);
    const double left = picture_.x + picture_.width + kLegendGap * scale_;
    const double margin = kLegendMargin * scale_;
    legend.draw({Eigen::Vector2d(left, picture_.y + margin),
                 Eigen::Vector2d(left + legend.width(), height_ - margin)},
                ink, image);
  }
  if (!arguments_.title.empty()) {
    const Font font = title_font(scale_);
    ink.text(shortened(arguments_.title, font, width_ - 2 * kLegendMargin * scale_), font,
             {width_ / 2.0, picture_.y / 2.0 + 4 * scale_});
  }
  ink.print(ink_for(background_), image);
  return image;
}

project::Camera Figure::with_room_for_axes(std::vector<project::Camera> cameras) const {
  if (!arguments_.axes) return cameras.front();
  const double margin = kAxesMargin * scale_;
  const Eigen::Vector2d room(picture_.width - 2 * margin, picture_.height - 2 * margin);
  constexpr int kMostSteps = 100;  // labels change with the view, a little: no closed form
  for (int step = 0; step < kMostSteps; ++step) {
    Eigen::AlignedBox2d extent;
    for (const project::Camera& camera : cameras) {
      const project::Frame frame(camera, picture_.width, picture_.height);
      extent.extend(BoxAxes(box_, frame, scale_).extent());
    }
    if (extent.isEmpty()) break;
    const Eigen::Vector2d off =
        extent.center() - Eigen::Vector2d(picture_.width, picture_.height) / 2;
    const double excess = (extent.sizes().array() / room.array()).maxCoeff();
    if (off.norm() < 0.5 && excess <= 1) break;
    for (project::Camera& camera : cameras) {
      const project::Frame frame(camera, picture_.width, picture_.height);
      const double depth = frame.to_camera(box_.center()).z();
      // Sideways as far as moves the nearest corner there, and the others not yet: no overshooting.
      double nearest = depth;
      for (int i = 0; i < 8; ++i) {
        const auto corner = static_cast<mesh::Box::CornerType>(i);
        nearest = std::min(nearest, frame.to_camera(box_.corner(corner)).z());
      }
      const double pixel = frame.pitch() * (frame.parallel() ? 1 : nearest);
      const double back = frame.parallel() ? 0 : depth * std::max(0.0, excess - 1);
      const Eigen::Vector3d step_back =
          frame.axes().transpose() * Eigen::Vector3d(off.x() * pixel, -off.y() * pixel, -back);
      camera.eye += step_back;
      camera.target += step_back;
    }
  }
  return cameras.front();
}

}  // namespace tetraglass::apps
