#include "tests/stability/drawing.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/errors.h"
#include "project/reference/ray_cells.h"
#include "project/render.h"
#include "tests/support/scenes.h"

namespace tetraglass::tests {
namespace {

using project::Integrator;
using project::Mode;
using project::Projector;
using project::Scene;
using project::Shading;

// So dark that one ray along the diagonal is two optical depths long.
constexpr double kDepth = 2;

double longest_edge(const mesh::TetMesh& mesh) {
  double longest = 0;
  for (const mesh::Cell& cell : mesh.cells) {
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) {
        longest = std::max(longest, (mesh.points[cell[i]] - mesh.points[cell[j]]).norm());
      }
    }
  }
  return longest;
}

/// The integrators that approximate, on a medium that is the same for every value: there only the
/// table over lengths errs, by linear interpolation: (kappa step)^2 / 8 a segment.
void expect_approximations(Record& record, const mesh::TetMesh& mesh, const Convex& body,
                           const View& view, double input) {
  const double extinction = kDepth / mesh::bounds(mesh).diagonal().norm();
  constexpr int kLengths = 32;
  struct Way {
    Mode mode;
    Integrator integrator;
    int n;
    int m;
  };
  for (const Way& way :
       {Way{Mode::full, Integrator::table3d, 8, kLengths}, Way{Mode::full, Integrator::psi, 16, 0},
        Way{Mode::full, Integrator::linear, 0, 0}, Way{Mode::absorption, Integrator::table2d, 8, 0},
        Way{Mode::emission, Integrator::linear, 0, 0}}) {
    Scene scene = effect_scene(mesh, {"", way.mode}, view);
    scene.transfer_function = constant_medium({0.2, 0.5, 1}, extinction);
    project::Request request;
    request.projector = Projector::gl;
    request.integrator = way.integrator;
    request.table_n = way.n;
    request.table_m = way.m;
    Roundings roundings = tests::roundings(scene, Projector::gl, input);
    if (way.integrator == Integrator::table3d) {
      const double step = longest_edge(mesh) / (kLengths - 1);
      roundings.per_segment += extinction * extinction * step * step / 8;
    }
    const Bounded exact = closed_form(body, scene, roundings, deepest(scene));
    record.expect_near(
        "gl tables",
        fmt::format("{}, {}, {}", view.name, to_string(way.mode), to_string(way.integrator)),
        draw(scene, request), exact.image, exact.bound);
  }
}

}  // namespace

std::vector<View> outside_views(const mesh::Box& box) {
  const project::Camera outside =
      project::frame_camera(box, {1, 0.8, 0.6}, Eigen::Vector3d::UnitZ(), 30, 1);
  project::Camera parallel =
      project::frame_camera(box, {-0.7, 0.31, 0.53}, Eigen::Vector3d::UnitY(), 30, 1);
  parallel.parallel = true;
  return {{"perspective", outside}, {"parallel", parallel}};
}

const std::vector<Effect>& effects() {
  static const std::vector<Effect> all = {
      {"thickness", Mode::thickness},
      {"emission", Mode::emission},
      {"absorption", Mode::absorption},
      {"mip", Mode::mip},
      {"mip of colors", Mode::mip, project::MipOf::transfer},
      {"full", Mode::full},
      {"iso smooth", Mode::iso, project::MipOf::field, Shading::smooth, 1},
      {"iso flat, translucent", Mode::iso, project::MipOf::field, Shading::flat, 0.5}};
  return all;
}

preint::TransferFunction five_colors(double low, double high, double diagonal) {
  const double k = kDepth / diagonal;
  const auto at = [&](double t) { return low + t * (high - low); };
  return preint::TransferFunction({{at(0), {0.1, 0.2, 0.9}, 0.5 * k},
                                   {at(0.2), {0.1, 0.8, 0.6}, k},
                                   {at(0.5), {0.9, 0.9, 0.2}, 0.2 * k},
                                   {at(0.8), {1, 0.4, 0.1}, 2 * k},
                                   {at(1), {0.8, 0, 0.3}, k}});
}

Scene effect_scene(const mesh::TetMesh& mesh, const Effect& effect, const View& view) {
  Scene scene = make_scene(mesh, effect.mode, constant_medium({1, 1, 1}, 1), kPixels);
  const mesh::ScalarField& field = scene.field;
  scene.camera = view.camera;
  scene.width = view.width;
  scene.height = view.height;
  scene.mip_of = effect.mip_of;
  if (field.min < field.max) {
    scene.transfer_function =
        five_colors(field.min, field.max, mesh::bounds(mesh).diagonal().norm());
  }
  if (effect.mode != Mode::iso) return scene;
  scene.shading = effect.shading;
  for (const double t : {1.0 / 3, 0.6}) {
    const double value = field.min + t * (field.max - field.min);
    scene.isosurfaces.push_back({value, {t, 1 - t, 0.5}, effect.opacity});
  }
  return scene;
}

std::vector<Contender> exact_contenders(const Scene& scene) {
  std::vector<Contender> result;
  for (const Projector projector : {Projector::cpu, Projector::gl, Projector::reference}) {
    Contender contender{to_string(projector), to_string(projector), projector, {}};
    contender.request.projector = projector;
    result.push_back(contender);
  }
  if (!is_commutative(scene)) {
    Contender fragments = result[1];
    fragments.name = "gl, fragments";
    fragments.request.sort = project::SortMethod::fragments;
    result.push_back(fragments);
  }
  return result;
}

project::Image draw(const Scene& scene, const project::Request& request) {
  project::Stats stats;
  return render(scene, plan(scene, request), stats);
}

namespace {

/// The same scene with every ray moved by so much of a pixel to the right and up.
Scene moved(Scene scene, double right, double up) {
  const project::Frame frame = make_frame(scene);
  const Eigen::Vector3d by =
      frame.pitch() * frame.axes().transpose() * Eigen::Vector3d(right, up, 0);
  const double distance = (scene.camera.target - scene.camera.eye).norm();
  scene.camera.target += by * (scene.camera.parallel ? 1 : distance);
  if (scene.camera.parallel) scene.camera.eye += by;
  return scene;
}

/// The same scene with every value of the field so much less.
Scene with_values_changed(Scene scene, double by) {
  std::vector<preint::ControlPoint> points = scene.transfer_function.points();
  for (preint::ControlPoint& point : points) point.value += by;
  scene.transfer_function = preint::TransferFunction(points);
  for (preint::Isosurface& surface : scene.isosurfaces) surface.value += by;
  return scene;
}

/// What a unit of length adds to a channel at most.
double strongest(const Scene& scene) {
  if (scene.mode == Mode::thickness) return 1;
  double most = 0;
  for (const preint::ControlPoint& point : scene.transfer_function.points()) {
    most = std::max(most, point.extinction * std::max(1.0, point.color.maxCoeff()));
  }
  return scene.mode == Mode::mip || scene.mode == Mode::iso ? 0 : most;
}

bool order_is_open(const std::vector<project::RaySegment>& segments, double rounding) {
  for (std::size_t i = 0; i + 1 < segments.size(); ++i) {
    const project::RaySegment& a = segments[i];
    const project::RaySegment& b = segments[i + 1];
    const bool overlap = b.entry < a.exit - rounding;
    if (overlap && std::abs(a.entry + a.exit - b.entry - b.exit) < 2 * rounding) return true;
  }
  return false;
}

}  // namespace

Bounded by_reference(const Scene& scene, const Roundings& roundings) {
  project::Request request;
  request.projector = Projector::reference;
  const double p = roundings.position;
  Bounded result{draw(scene, request), {}};
  result.bound = project::Image(result.image.width, result.image.height);
  for (const auto& [one, other] : {std::pair(moved(scene, p, p), moved(scene, -p, -p)),
                                   std::pair(moved(scene, p, -p), moved(scene, -p, p)),
                                   std::pair(with_values_changed(scene, roundings.value),
                                             with_values_changed(scene, -roundings.value))}) {
    const project::Image a = draw(one, request);
    const project::Image b = draw(other, request);
    for (std::size_t i = 0; i < a.rgba.size(); ++i) {
      result.bound.rgba[i] += std::max(std::abs(a.rgba[i] - result.image.rgba[i]),
                                       std::abs(b.rgba[i] - result.image.rgba[i]));
    }
  }
  const project::RayCells cells(scene);
  std::vector<project::RaySegment> segments;
  for (int y = 0; y < result.image.height; ++y) {
    for (int x = 0; x < result.image.width; ++x) {
      cells.segments(x, y, segments);
      const double count = static_cast<double>(segments.size());
      const double stretch = cells.frame().ray_direction(cells.frame().image_plane(x, y)).norm();
      Eigen::Map<Eigen::Array4f> bound(result.bound.pixel(x, y));
      const Eigen::Array4d exact =
          Eigen::Map<Eigen::Array4f>(result.image.pixel(x, y)).cast<double>();
      bound += summation_bound(exact, roundings, count).cast<float>();
      bound += static_cast<float>(2 * count * roundings.depth * stretch * strongest(scene));
      if (order_is_open(segments, 2 * roundings.depth)) bound += 1;
    }
  }
  return result;
}

double deepest(const Scene& scene) {
  const project::RayCells cells(scene);
  std::vector<project::RaySegment> segments;
  std::size_t most = 0;
  for (int y = 0; y < cells.frame().height(); ++y) {
    for (int x = 0; x < cells.frame().width(); ++x) {
      cells.segments(x, y, segments);
      most = std::max(most, segments.size());
    }
  }
  return static_cast<double>(most);
}

namespace {

// What the fragment lists of Mesa's software renderer can sort is less.
constexpr double kMostSortedHere = 4096;

/// Whether the plan says that the mesh is seen from too near for floats.
bool is_told(const Scene& scene, const project::Request& request) {
  return plan(scene, request).gl.position_rounding > project::kLargestPositionRounding;
}

}  // namespace

void expect_closed_forms(Record& record, const mesh::TetMesh& mesh, const Convex& body,
                         const std::vector<View>& views, double input) {
  for (std::size_t v = 0; v < views.size(); ++v) {
    const View& view = views[v];
    double most = -1;
    for (std::size_t e = 0; e < effects().size(); ++e) {
      const Effect& effect = effects()[e];
      const Scene scene = effect_scene(mesh, effect, view);
      if (most < 0) most = deepest(scene);
      // Shaders take long to compile: modes that add up differ only in what becomes of a segment.
      const bool added_up = is_commutative(scene) && effect.mode != Mode::thickness;
      const bool in_turn = !added_up || e % views.size() == v;
      for (const Contender& contender : exact_contenders(scene)) {
        if (contender.projector == Projector::gl && !in_turn) continue;
        if (is_told(scene, contender.request)) {
          record.note_told(contender.way, "told for " + view.name + ": positions too coarse");
          continue;
        }
        const Bounded exact =
            closed_form(body, scene, roundings(scene, contender.projector, input), most);
        const std::string detail =
            fmt::format("{}, {}, {}", view.name, effect.name, contender.name);
        if (contender.request.sort && most > kMostSortedHere) {
          EXPECT_THROW((void)draw(scene, contender.request), base::UnavailableError) << detail;
          record.note_told(contender.way, contender.name + " refused: lists too long");
          continue;
        }
        const project::Image image = draw(scene, contender.request);
        if (effect.mode != Mode::emission) expect_sound(image, detail);
        record.expect_near(contender.way, detail, image, exact.image, exact.bound);
      }
    }
  }
  expect_approximations(record, mesh, body, views.front(), input);
}

}  // namespace tetraglass::tests
