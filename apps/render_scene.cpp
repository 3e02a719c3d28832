#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/figure.h"
#include "apps/light_scene.h"
#include "apps/mesh_input.h"
#include "apps/options.h"
#include "apps/orbit.h"
#include "apps/render_arguments.h"
#include "apps/transfer_function_input.h"
#include "preint/transfer_function.h"
#include "preint/transfer_function_edit.h"

namespace tetraglass::apps {
namespace {

using project::Mode;

// A ray along the diagonal that meets the field's values as often as the mesh has them keeps
// exp(-3) = 5 % of the light.
constexpr double kAutomaticDepth = 3;

/// Color maps say nothing of opacity, so it comes from the data; x-ray, and files, mean the opacity
/// that they have.
bool wants_automatic_opacity(const RenderArguments& arguments) {
  const std::string& name = arguments.transfer_function;
  if (arguments.opacity.empty()) return is_preset_name(name) && name != "x-ray";
  return parse_choice<bool>(arguments.opacity, "--opacity", {{"given", false}, {"auto", true}});
}

preint::TransferFunction make_transfer_function(const RenderArguments& arguments,
                                                const mesh::ScalarField& field, double diagonal) {
  const std::string& name = arguments.transfer_function;
  const auto scaled = [&](const preint::TransferFunction& tf) {
    if (arguments.opacity_scale.empty()) return tf;
    return preint::scale_extinction(tf, parse_number(arguments.opacity_scale, "--opacity-scale"));
  };
  if (arguments.own_transfer_function) return scaled(*arguments.own_transfer_function);
  double low = field.min;
  double high = field.max;
  if (!arguments.range.empty()) std::tie(low, high) = parse_range(arguments.range, "--range");
  preint::TransferFunction tf = read_named_transfer_function(name, low, high, diagonal);
  if (!arguments.range.empty() && has_own_values(name)) {
    warn(
        "--range scales presets and color maps only; the values in the transfer function's file "
        "are kept");
  }
  if (arguments.logarithmic) tf = preint::with_logarithmic_values(tf);
  if (wants_automatic_opacity(arguments) && low < high) {
    constexpr std::size_t kBins = 64;
    const preint::Histogram histogram = preint::histogram(field.values, low, high, kBins);
    tf = preint::automatic_extinction(tf, histogram, kAutomaticDepth, diagonal);
  }
  return scaled(tf);
}

std::vector<preint::Isosurface> make_isosurfaces(
    const RenderArguments& arguments, const mesh::ScalarField& field,
    const preint::TransferFunction& transfer_function) {
  std::vector<preint::Isosurface> surfaces;
  for (const std::string& text : arguments.isovalues) {
    surfaces.push_back({parse_number(text, "--isovalue")});
  }
  if (surfaces.empty()) {
    surfaces.push_back({0.5 * field.min + 0.5 * field.max});
    fmt::print(stderr, "no --isovalue given: drawing the middle of the range, {:.6g}\n",
               surfaces[0].value);
  }
  if (arguments.iso_colors.size() > surfaces.size()) {
    throw base::UsageError("there are more --iso-color than --isovalue");
  }
  double opacity = 1;
  if (!arguments.iso_opacity.empty())
    opacity = parse_number(arguments.iso_opacity, "--iso-opacity");
  if (!(opacity >= 0 && opacity <= 1))
    throw base::UsageError("--iso-opacity must lie between 0 and 1");
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    preint::Isosurface& surface = surfaces[i];
    surface.opacity = opacity;
    surface.color = i < arguments.iso_colors.size()
                        ? parse_vector(arguments.iso_colors[i], "--iso-color").array()
                        : transfer_function.at(surface.value).color;
    if (surface.value < field.min || surface.value > field.max) {
      warn(fmt::format(
          "isovalue {:.6g} lies outside the field's range, {:.6g} to {:.6g}: nothing to see of it",
          surface.value, field.min, field.max));
    }
  }
  return surfaces;
}

/// Samples each way of a picture whose size is known.
int parse_samples(const RenderArguments& arguments, const project::Scene& scene) {
  if (arguments.samples.empty()) return 1;
  const int count = parse_count(arguments.samples, "--samples", 1);
  const int side = static_cast<int>(std::sqrt(count));
  if (side * side != count) {
    throw base::UsageError(
        fmt::format("--samples {} do not share a pixel evenly; the nearest that do are {} and {}",
                    count, side * side, (side + 1) * (side + 1)));
  }
  check_side(std::max(scene.width, scene.height), side);
  return side;
}

/// Of a picture whose size is known.
std::optional<project::Region> parse_region(const RenderArguments& arguments,
                                            const project::Scene& scene) {
  if (arguments.region.empty()) return std::nullopt;
  std::array<int, 4> pixels{};
  const std::vector<double> numbers = parse_numbers(arguments.region, "--region", 4, 4);
  for (std::size_t i = 0; i < 4; ++i) {
    const int limit = i % 2 == 0 ? scene.width : scene.height;
    const double least = i < 2 ? 0 : 1;
    if (!(numbers[i] >= least && numbers[i] <= limit) || numbers[i] != std::floor(numbers[i])) {
      throw base::UsageError("--region needs X,Y,WIDTH,HEIGHT, whole pixels of the picture");
    }
    pixels[i] = static_cast<int>(numbers[i]);
  }
  const project::Region region{pixels[0], pixels[1], pixels[2], pixels[3]};
  if (region.x + region.width > scene.width || region.y + region.height > scene.height) {
    throw base::UsageError(fmt::format("--region {} leaves the picture of {} x {} pixels",
                                       arguments.region, scene.width, scene.height));
  }
  return region;
}

std::vector<project::ClipPlane> make_clip_planes(const RenderArguments& arguments) {
  std::vector<project::ClipPlane> planes;
  for (const std::string& text : arguments.clip) {
    const std::vector<double> numbers = parse_numbers(text, "--clip", 4, 4);
    project::ClipPlane plane{{numbers[0], numbers[1], numbers[2]}, numbers[3]};
    if (plane.normal.isZero(0)) throw base::UsageError("--clip needs a normal that is not 0");
    planes.push_back(plane);
  }
  return planes;
}

void refuse_iso_options(const RenderArguments& arguments) {
  if (!arguments.isovalues.empty() || !arguments.iso_colors.empty() ||
      !arguments.iso_opacity.empty()) {
    throw base::UsageError("--isovalue, --iso-color and --iso-opacity are for --mode iso");
  }
}

project::GlRequest make_gl_request(const RenderArguments& arguments) {
  using project::Layout;
  using project::Minimum;
  using project::TargetFormat;
  project::GlRequest request;
  request.layout = parse_choice<std::optional<Layout>>(arguments.layout, "--layout",
                                                       {{"auto", std::nullopt},
                                                        {"indexed", Layout::indexed},
                                                        {"strip", Layout::strip},
                                                        {"faces12", Layout::faces12},
                                                        {"faces12-short", Layout::faces12_short}});
  if (!arguments.edge_fix.empty()) {
    request.edge_fix =
        parse_choice<bool>(arguments.edge_fix, "--edge-fix", {{"on", true}, {"off", false}});
  }
  if (!arguments.minimum.empty()) {
    request.minimum = parse_choice<Minimum>(arguments.minimum, "--minimum",
                                            {{"shader", Minimum::shader},
                                             {"texture8", Minimum::texture8},
                                             {"texture16", Minimum::texture16}});
  }
  if (!arguments.perspective.empty()) {
    request.interpolate_lengths = parse_choice<bool>(arguments.perspective, "--perspective",
                                                     {{"exact", false}, {"affine", true}});
  }
  if (!arguments.target_format.empty()) {
    request.target = parse_choice<TargetFormat>(arguments.target_format, "--target-format",
                                                {{"rgba32f", TargetFormat::rgba32f},
                                                 {"rgba16f", TargetFormat::rgba16f},
                                                 {"rgba8", TargetFormat::rgba8}});
  }
  if (!arguments.gpu_memory.empty())
    request.memory = parse_bytes(arguments.gpu_memory, "--gpu-memory");
  return request;
}

/// What should be seen beside the points of the mesh in a picture that is framed by itself.
std::vector<Eigen::Vector3d> points_around(const RenderArguments& arguments,
                                           const project::Scene& scene) {
  std::vector<Eigen::Vector3d> points;
  if (arguments.figure.outline || arguments.figure.axes) {
    const mesh::Box box = drawn_box(scene);
    for (int i = 0; i < 8; ++i) points.push_back(box.corner(static_cast<mesh::Box::CornerType>(i)));
  }
  for (const project::OpaqueSurface& surface : scene.opaque.surfaces) {
    points.insert(points.end(), surface.points.begin(), surface.points.end());
  }
  return points;
}

/// Sets up the camera of a scene whose size is known.
void frame_scene(const RenderArguments& arguments, const Figure& figure,
                 const Eigen::Vector3d& middle, project::Scene& scene) {
  const double aspect = static_cast<double>(scene.width) / scene.height;
  // A copy of the mesh's points only where there are others.
  std::vector<Eigen::Vector3d> all = points_around(arguments, scene);
  if (!all.empty()) all.insert(all.begin(), scene.mesh->points.begin(), scene.mesh->points.end());
  const std::span<const Eigen::Vector3d> points = all.empty() ? scene.mesh->points : all;
  scene.camera = make_camera(arguments, points, middle, aspect);
  if (!is_framed(arguments)) return;
  const int frames = std::max(1, orbit_frames(arguments));
  const Eigen::Vector3d pivot = orbit_pivot(arguments, scene);
  if (frames > 1) {
    scene.camera =
        make_camera(arguments, swept_by_orbit(points, pivot, scene.camera.up), middle, aspect);
  }
  // Of more frames every so many tell where the labels go.
  constexpr int kPlaces = 36;
  scene.camera = figure.with_room_for_axes(orbit(scene.camera, pivot, std::min(frames, kPlaces)));
}

}  // namespace

bool draws_all_times(const RenderArguments& arguments) {
  return arguments.import.time == "all";
}

bool draws_frames(const RenderArguments& arguments) {
  return !arguments.orbit.empty() || draws_all_times(arguments);
}

int orbit_frames(const RenderArguments& arguments) {
  return arguments.orbit.empty() ? 0 : parse_count(arguments.orbit, "--orbit", 1);
}

Eigen::Vector3d orbit_pivot(const RenderArguments& arguments, const project::Scene& scene) {
  return is_framed(arguments) ? drawn_box(scene).center() : scene.camera.target;
}

bool draws_grid(const RenderArguments& arguments) {
  return arguments.projector == "grid-reference" || arguments.projector == "slices";
}

DrawnField select_field(const RenderArguments& arguments, const mesh::TetMesh& mesh) {
  DrawnField result;
  result.field = select_scalar_of(arguments.input, mesh, arguments.field);
  if (arguments.field.empty() && mesh.fields.empty()) {
    fmt::print(stderr, "{}: has no fields; drawn by '{}' (--field x, y, z or radius)\n",
               arguments.input, result.field.name);
  }
  if (draws_grid(arguments)) {
    result.drawable.nan = static_cast<std::size_t>(std::ranges::count_if(
        result.field.values, [](double value) { return !std::isfinite(value); }));
  } else {
    result.drawable = mesh::find_drawable(mesh, result.field);
  }
  if (result.drawable.cells.empty() && !draws_grid(arguments)) {
    throw base::InputError(fmt::format(
        "{}: no cell can be drawn: {} have no volume, {} touch values of '{}' or "
        "coordinates that are not finite",
        arguments.input, result.drawable.degenerate, result.drawable.nan, result.field.name));
  }
  result.box = mesh::bounds(mesh);
  return result;
}

project::Scene make_scene(const RenderArguments& arguments, const mesh::TetMesh& mesh,
                          const mesh::ScalarField* values) {
  return make_scene(arguments, mesh, select_field(arguments, mesh), values);
}

project::Scene make_scene(const RenderArguments& arguments, const mesh::TetMesh& mesh,
                          DrawnField drawn, const mesh::ScalarField* values) {
  project::Scene scene;
  scene.mesh = &mesh;
  std::tie(scene.width, scene.height) = parse_size(arguments.size, "--size");
  scene.samples = parse_samples(arguments, scene);
  scene.region = parse_region(arguments, scene);
  scene.mode = parse_choice<Mode>(arguments.mode, "--mode",
                                  {{"full", Mode::full},
                                   {"emission", Mode::emission},
                                   {"absorption", Mode::absorption},
                                   {"mip", Mode::mip},
                                   {"iso", Mode::iso},
                                   {"thickness", Mode::thickness}});
  scene.mip_of = parse_choice<project::MipOf>(
      arguments.mip_of, "--mip-of",
      {{"field", project::MipOf::field}, {"transfer", project::MipOf::transfer}});
  scene.field = std::move(drawn.field);
  scene.drawable = std::move(drawn.drawable);
  scene.transfer_function = make_transfer_function(
      arguments, values != nullptr ? *values : scene.field, drawn.box.diagonal().norm());
  if (scene.mode == Mode::iso) {
    scene.isosurfaces = make_isosurfaces(arguments, values != nullptr ? *values : scene.field,
                                         scene.transfer_function);
  } else {
    refuse_iso_options(arguments);
  }
  if (draws_grid(arguments)) {
    try {
      scene.grid = mesh::rectilinear_grid(mesh);
    } catch (const base::InputError& error) {
      throw base::InputError(arguments.input + ": " + error.what());
    }
  }
  set_light(arguments, scene);
  scene.clip = make_clip_planes(arguments);
  if (!arguments.depth_cue.empty()) {
    const auto [near, far] = parse_range(arguments.depth_cue, "--depth-cue");
    if (!(near < far)) throw base::UsageError("--depth-cue needs NEAR below FAR");
    scene.depth_cue = project::DepthCue{near, far};
  }
  add_opaque_geometry(arguments, scene);
  const Figure figure(arguments, scene, scene.width, scene.height);
  scene.width = figure.picture_width();
  scene.height = figure.picture_height();
  frame_scene(arguments, figure, drawn.box.center(), scene);
  return scene;
}

project::Request make_request(const RenderArguments& arguments) {
  using project::ContextKind;
  using project::Integrator;
  using project::Projector;
  using project::SortMethod;
  project::Request request;
  request.projector =
      parse_choice<std::optional<Projector>>(arguments.projector, "--projector",
                                             {{"auto", std::nullopt},
                                              {"cpu", Projector::cpu},
                                              {"gl", Projector::gl},
                                              {"reference", Projector::reference},
                                              {"slices", Projector::slices},
                                              {"grid-reference", Projector::grid_reference}});
  if (!arguments.light_map.empty()) {
    request.light_map = parse_count(arguments.light_map, "--light-map", 1);
  }
  request.context = parse_choice<std::optional<ContextKind>>(
      arguments.context, "--context",
      {{"auto", std::nullopt}, {"osmesa", ContextKind::osmesa}, {"egl", ContextKind::egl}});
  request.sort = parse_choice<std::optional<SortMethod>>(arguments.sort, "--sort",
                                                         {{"auto", std::nullopt},
                                                          {"none", SortMethod::none},
                                                          {"centroid", SortMethod::centroid},
                                                          {"power", SortMethod::power},
                                                          {"mpvo", SortMethod::mpvo},
                                                          {"fragments", SortMethod::fragments}});
  request.integrator = parse_choice<std::optional<Integrator>>(arguments.integrator, "--integrator",
                                                               {{"auto", std::nullopt},
                                                                {"exact", Integrator::exact},
                                                                {"table2d", Integrator::table2d},
                                                                {"table3d", Integrator::table3d},
                                                                {"psi", Integrator::psi},
                                                                {"linear", Integrator::linear}});
  request.gl = make_gl_request(arguments);
  request.slices = make_slices_request(arguments.slices);
  if (!arguments.opaque_at.empty()) {
    request.opaque_at = parse_number(arguments.opaque_at, "--opaque-at");
  }
  if (!arguments.table.empty()) {
    const std::size_t cross = arguments.table.find('x');
    request.table_n = parse_count(arguments.table.substr(0, cross), "--table", 2);
    if (cross != std::string::npos)
      request.table_m = parse_count(arguments.table.substr(cross + 1), "--table", 2);
  }
  return request;
}

project::Background make_background(const RenderArguments& arguments, Mode mode) {
  project::Background background;
  // Absorption alone is black: it shows on white only.
  if (mode == Mode::absorption) background.rgb = {1, 1, 1};
  if (arguments.background.empty()) return background;
  const std::vector<double> rgba = parse_numbers(arguments.background, "--background", 3, 4);
  for (const double value : rgba) {
    if (!(value >= 0 && value <= 1))
      throw base::UsageError("--background needs numbers between 0 and 1");
  }
  background.rgb = {rgba[0], rgba[1], rgba[2]};
  if (rgba.size() == 4) background.alpha = rgba[3];
  return background;
}

}  // namespace tetraglass::apps
