#include "apps/camera_options.h"

#include <cmath>
#include <limits>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "apps/options.h"
#include "base/json_file.h"

namespace tetraglass::apps {
namespace {

constexpr double kDefaultFov =
    30;  // degrees: little perspective distortion, as figures usually have

/// Whether z is no good as the up direction: less than a thousandth of the gaze goes across it.
bool is_along_z(const Eigen::Vector3d& gaze) {
  return gaze.head<2>().stableNorm() <= 1e-3 * std::abs(gaze.z());
}

double positive(const base::JsonValue& json, double most) {
  const double value = json.number();
  if (!(value > 0 && value < most)) {
    json.fail(std::isfinite(most) ? fmt::format("must lie between 0 and {}, exclusive", most)
                                  : "must be above 0");
  }
  return value;
}

Eigen::Vector3d read_vector(const base::JsonValue& json) {
  const std::vector<double> numbers = json.numbers(3, "three numbers: x, y, z");
  return {numbers[0], numbers[1], numbers[2]};
}

project::Camera read_camera(const std::string& file) {
  base::JsonValue json = base::JsonValue::read(file);
  if (const auto of_session = json.find("camera")) json = *of_session;
  json.allow_only({"eye", "target", "up", "fov", "ortho"});
  project::Camera camera;
  camera.eye = read_vector(json.member("eye"));
  camera.target = read_vector(json.member("target"));
  camera.up =
      is_along_z(camera.target - camera.eye) ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
  if (const auto up = json.find("up")) camera.up = read_vector(*up);
  camera.fov_degrees = kDefaultFov;
  const auto fov = json.find("fov");
  const auto ortho = json.find("ortho");
  if (fov && ortho) json.fail("has fov, for perspective, and ortho, for parallel views: keep one");
  if (fov) camera.fov_degrees = positive(*fov, 180);
  camera.parallel = ortho.has_value();
  if (ortho) camera.ortho_height = positive(*ortho, std::numeric_limits<double>::infinity());
  return camera;
}

}  // namespace

void add_camera_options(CLI::App* app, CameraArguments& a) {
  app->add_option(
      "--view", a.view,
      "Look from this direction, the mesh framed: +x, -z, X,Y,Z, ... Default: 1,0.8,0.6");
  app->add_option("--eye", a.eye, "X,Y,Z in the mesh's units, instead of --view");
  app->add_option("--target", a.target,
                  "X,Y,Z to look at, with --eye. Default: the centre of the mesh");
  app->add_option("--up", a.up, "X,Y,Z. Default: 0,0,1 (0,1,0 when looking along z)");
  app->add_option("--fov", a.fov, "Vertical field of view in degrees. Default: 30");
  app->add_option("--ortho", a.ortho,
                  "Parallel view; the height of the picture in the mesh's units");
  app->add_option(
         "--camera", a.file,
         "FILE.json in place of all these: {\"eye\": [X,Y,Z], \"target\": [X,Y,Z], \"up\": "
         "[X,Y,Z], \"fov\": DEG or \"ortho\": HEIGHT}, or a session of the window")
      ->type_name("FILE");
}

bool is_framed(const CameraArguments& arguments) {
  return arguments.eye.empty() && arguments.file.empty();
}

project::Camera make_camera(const CameraArguments& arguments, const mesh::TetMesh& mesh,
                            double aspect) {
  return make_camera(arguments, mesh.points, mesh::bounds(mesh).center(), aspect);
}

project::Camera make_camera(const CameraArguments& arguments,
                            std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& middle,
                            double aspect) {
  if (!arguments.file.empty()) {
    for (const std::string* other : {&arguments.eye, &arguments.target, &arguments.up,
                                     &arguments.fov, &arguments.ortho, &arguments.view}) {
      if (!other->empty()) {
        throw base::UsageError(
            "--camera stands in the place of --eye, --target, --up, --fov, --ortho and --view: "
            "give it alone");
      }
    }
    return read_camera(arguments.file);
  }
  if (!arguments.fov.empty() && !arguments.ortho.empty()) {
    throw base::UsageError(
        "--fov is for perspective, --ortho for parallel views: give one of them");
  }
  if (!arguments.eye.empty() && !arguments.view.empty()) {
    throw base::UsageError("--view frames the mesh by itself: give --eye or --view, not both");
  }
  if (arguments.eye.empty() && !arguments.target.empty()) {
    throw base::UsageError("--target needs --eye; to look from a direction use --view");
  }
  const double fov = arguments.fov.empty() ? kDefaultFov : parse_number(arguments.fov, "--fov");
  if (!(fov > 0 && fov < 180))
    throw base::UsageError("--fov must lie between 0 and 180 degrees (exclusive)");
  const Eigen::Vector3d direction =
      parse_direction(arguments.view.empty() ? "1,0.8,0.6" : arguments.view, "--view");
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  if (!arguments.up.empty()) {
    up = parse_vector(arguments.up, "--up");
  } else if (arguments.eye.empty() && is_along_z(direction)) {
    up = Eigen::Vector3d::UnitY();  // looking straight up or down: y is up, as on a map
  }
  project::Camera camera = project::frame_camera(points, direction, up, fov, aspect);
  if (!arguments.eye.empty()) {
    camera.eye = parse_vector(arguments.eye, "--eye");
    camera.target = arguments.target.empty() ? middle : parse_vector(arguments.target, "--target");
    if (arguments.up.empty() && is_along_z(camera.target - camera.eye))
      camera.up = Eigen::Vector3d::UnitY();
  }
  camera.parallel = !arguments.ortho.empty();
  if (camera.parallel) camera.ortho_height = parse_number(arguments.ortho, "--ortho");
  if (camera.parallel && arguments.eye.empty()) return project::centered(camera, points);
  return camera;
}

}  // namespace tetraglass::apps
