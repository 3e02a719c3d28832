#include "project/render.h"

#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <oneapi/tbb/global_control.h>

#include "apps/mesh_input.h"
#include "apps/options.h"
#include "apps/render_report.h"
#include "apps/subcommands.h"
#include "apps/transfer_function_input.h"
#include "base/output_file.h"
#include "base/stopwatch.h"
#include "preint/transfer_function.h"
#include "preint/transfer_function_edit.h"
#include "project/image_file.h"

namespace tetraglass::apps {
namespace {

using project::Mode;

// A ray along the diagonal that meets the field's values as often as the mesh has them keeps
// exp(-3) = 5 % of the light.
constexpr double kAutomaticDepth = 3;

constexpr double kDefaultFov =
    30;  // degrees: little perspective distortion, as figures usually have

/// The options as typed; empty where not given.
struct RenderArguments {
  std::string input;
  std::vector<std::string> outputs;
  std::string size = "800x600";
  std::string field;
  std::string mode = "full";
  std::string mip_of = "field";
  std::vector<std::string> isovalues;
  std::vector<std::string> iso_colors;
  std::string iso_opacity;
  std::string transfer_function = "viridis";
  std::string range;
  std::string opacity;
  std::string opacity_scale;
  bool logarithmic = false;
  std::string eye;
  std::string target;
  std::string up;
  std::string fov;
  std::string ortho;
  std::string view;
  std::string projector = "auto";
  std::string context = "auto";
  std::string sort = "auto";
  std::string integrator = "auto";
  std::string table;
  std::string shading;
  std::string background;
  std::string stats;
  std::string verify;
  std::string threads;
  bool explain = false;
  mesh::ImportOptions import;
};

/// Whether z is no good as the up direction: less than a thousandth of the gaze goes across it.
bool is_along_z(const Eigen::Vector3d& gaze) {
  return gaze.head<2>().stableNorm() <= 1e-3 * std::abs(gaze.z());
}

project::Camera make_camera(const RenderArguments& arguments, const mesh::TetMesh& mesh,
                            double aspect) {
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
  project::Camera camera = project::frame_camera(mesh.points, direction, up, fov, aspect);
  if (!arguments.eye.empty()) {
    camera.eye = parse_vector(arguments.eye, "--eye");
    camera.target = arguments.target.empty() ? mesh::bounds(mesh).center()
                                             : parse_vector(arguments.target, "--target");
    if (arguments.up.empty() && is_along_z(camera.target - camera.eye))
      camera.up = Eigen::Vector3d::UnitY();
  }
  camera.parallel = !arguments.ortho.empty();
  if (camera.parallel) camera.ortho_height = parse_number(arguments.ortho, "--ortho");
  return camera;
}

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
  if (arguments.opacity_scale.empty()) return tf;
  return preint::scale_extinction(tf, parse_number(arguments.opacity_scale, "--opacity-scale"));
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

void refuse_iso_options(const RenderArguments& arguments) {
  if (!arguments.isovalues.empty() || !arguments.iso_colors.empty() ||
      !arguments.iso_opacity.empty()) {
    throw base::UsageError("--isovalue, --iso-color and --iso-opacity are for --mode iso");
  }
  if (!arguments.shading.empty() && arguments.shading != "none") {
    throw base::UsageError("--shading " + arguments.shading +
                           " is for --mode iso; other modes are not shaded");
  }
}

project::Scene make_scene(const RenderArguments& arguments, const mesh::TetMesh& mesh) {
  project::Scene scene;
  scene.mesh = &mesh;
  std::tie(scene.width, scene.height) = parse_size(arguments.size, "--size");
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
  scene.field = mesh::select_scalar(mesh, arguments.field);
  scene.drawable = mesh::find_drawable(mesh, scene.field);
  if (scene.drawable.cells.empty()) {
    throw base::InputError(fmt::format(
        "{}: no cell can be drawn: {} have no volume, {} touch values of '{}' or "
        "coordinates that are not finite",
        arguments.input, scene.drawable.degenerate, scene.drawable.nan, scene.field.name));
  }
  const mesh::Box box = mesh::bounds(mesh);
  scene.transfer_function = make_transfer_function(arguments, scene.field, box.diagonal().norm());
  if (scene.mode == Mode::iso) {
    scene.isosurfaces = make_isosurfaces(arguments, scene.field, scene.transfer_function);
    scene.shading = parse_choice<project::Shading>(
        arguments.shading.empty() ? "smooth" : arguments.shading, "--shading",
        {{"none", project::Shading::none},
         {"flat", project::Shading::flat},
         {"smooth", project::Shading::smooth}});
  } else {
    refuse_iso_options(arguments);
  }
  scene.camera = make_camera(arguments, mesh, static_cast<double>(scene.width) / scene.height);
  return scene;
}

project::Request make_request(const RenderArguments& arguments) {
  using project::ContextKind;
  using project::Integrator;
  using project::Projector;
  using project::SortMethod;
  project::Request request;
  request.projector = parse_choice<std::optional<Projector>>(
      arguments.projector, "--projector",
      {{"auto", std::nullopt}, {"gl", Projector::gl}, {"reference", Projector::reference}});
  request.context = parse_choice<std::optional<ContextKind>>(
      arguments.context, "--context", {{"auto", std::nullopt}, {"osmesa", ContextKind::osmesa}});
  request.sort = parse_choice<std::optional<SortMethod>>(arguments.sort, "--sort",
                                                         {{"auto", std::nullopt},
                                                          {"none", SortMethod::none},
                                                          {"centroid", SortMethod::centroid},
                                                          {"fragments", SortMethod::fragments}});
  request.integrator = parse_choice<std::optional<Integrator>>(arguments.integrator, "--integrator",
                                                               {{"auto", std::nullopt},
                                                                {"exact", Integrator::exact},
                                                                {"table2d", Integrator::table2d},
                                                                {"table3d", Integrator::table3d}});
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

/// A picture in the mesh's units of length is scaled for 8 bits: the longest path is white.
project::Image scaled_for_png(const project::Image& image) {
  project::Image scaled = image;
  float longest = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) longest = std::max(longest, image.rgba[i]);
  if (longest > 0) {
    for (std::size_t i = 0; i < scaled.rgba.size(); ++i) {
      if (i % 4 != 3) scaled.rgba[i] /= longest;
    }
  }
  fmt::print(stderr, "thickness in .png: white is {:.6g}\n", longest);
  return scaled;
}

void write_pictures(const RenderArguments& arguments, Mode mode, const project::Image& image) {
  const project::Background background = make_background(arguments, mode);
  for (const std::string& output : arguments.outputs) {
    const bool png =
        output.size() > 4 && CLI::detail::to_lower(output.substr(output.size() - 4)) == ".png";
    const project::WriteReport report =
        mode == Mode::thickness && png
            ? project::write_image(scaled_for_png(image), output, background)
            : project::write_image(image, output, background);
    if (report.clipped_pixels > 0) {
      warn(fmt::format(
          "{}: {} pixels are brighter than white and were clipped; .exr and .npy keep them", output,
          report.clipped_pixels));
    }
  }
}

void check_outputs(const RenderArguments& arguments) {
  const std::vector<std::string> known = project::image_extensions();
  for (const std::string& output : arguments.outputs) {
    const std::size_t dot = output.rfind('.');
    const std::string extension =
        dot == std::string::npos ? "" : CLI::detail::to_lower(output.substr(dot));
    if (std::find(known.begin(), known.end(), extension) == known.end()) {
      throw base::WriteError(
          output, "'" + extension + "' is no picture format" + base::suggestion(extension, known));
    }
    const base::OutputFile probe(output);
  }
  if (!arguments.stats.empty()) const base::OutputFile probe(arguments.stats);
}

void print_plan(const project::Plan& plan) {
  fmt::print("plan\n");
  for (const std::string& reason : plan.reasons) fmt::print("  {}\n", reason);
}

void limit_threads(const RenderArguments& arguments, std::optional<tbb::global_control>& control) {
  if (arguments.threads.empty()) return;
  const int threads = parse_count(arguments.threads, "--threads", 1);
  control.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  // Mesa's software rasterizer reads this when the context is made; 0 there means: in the calling
  // thread.
  setenv("LP_NUM_THREADS", std::to_string(threads > 1 ? threads : 0).c_str(), 1);
}

void render(const RenderArguments& arguments) {
  std::optional<tbb::global_control> control;
  limit_threads(arguments, control);
  const project::Request request = make_request(arguments);
  const int verify_count =
      arguments.verify.empty() ? 0 : parse_count(arguments.verify, "--verify", 1);
  check_outputs(arguments);

  const mesh::Import imported = import_and_tell(arguments.input, arguments.import);
  const project::Scene scene = make_scene(arguments, imported.mesh);
  if (scene.drawable.degenerate + scene.drawable.nan > 0) {
    warn(
        fmt::format("{} cells without volume and {} with values or coordinates that are not finite "
                    "are not drawn",
                    scene.drawable.degenerate, scene.drawable.nan));
  }
  const project::Plan plan = project::plan(scene, request);
  if (arguments.explain) print_plan(plan);

  RenderReport report;
  report.import = imported.report;
  const project::Image image = project::render(scene, plan, report.stats);
  if (verify_count > 0) {
    report.verification = verify(scene, image, verify_count);
    fmt::print(
        stderr,
        "verified {} random pixels against the reference: largest error {:.3g}, RMS {:.3g}\n",
        report.verification->pixels, report.verification->max_error,
        report.verification->rms_error);
  }
  const base::Stopwatch clock;
  write_pictures(arguments, scene.mode, image);
  report.write_ms = clock.milliseconds();
  if (!arguments.stats.empty()) {
    base::OutputFile stats(arguments.stats);
    stats.write(stats_json(scene, plan, report));
    stats.commit();
  }
  fmt::print(stderr, "{}\n", stage_lines(report));
  fmt::print("{}\n", fmt::join(arguments.outputs, "\n"));
}

void add_scene_options(CLI::App* app, RenderArguments& a) {
  app->add_option("--size", a.size, "Pixels, WxH")->capture_default_str();
  app->add_option("--field", a.field,
                  "Point or cell field; NAME:x|y|z|magnitude or NAME:INDEX of one with components. "
                  "Default: the first scalar");
  app->add_option("--time", a.import.time, "Time step: a time, 'last' (default) or 'index:N'");
  app->add_option("--mode", a.mode, "full | emission | absorption | mip | iso | thickness")
      ->capture_default_str();
  app->add_option("--mip-of", a.mip_of,
                  "field | transfer: the maximum of the field, or of the colors")
      ->capture_default_str();
  app->add_option("--isovalue", a.isovalues,
                  "In the field's units; repeatable. Default: the middle of the range")
      ->take_all()
      ->expected(1);
  app->add_option("--iso-color", a.iso_colors,
                  "Linear R,G,B in the order of the isovalues. Default: from --tf")
      ->take_all()
      ->expected(1);
  app->add_option("--iso-opacity", a.iso_opacity, "0 to 1, of all isosurfaces. Default: 1");
  app->add_option("--shading", a.shading,
                  "none | flat | smooth, for mode iso, by a headlight. Default there: smooth");
  app->add_option("--tf", a.transfer_function, transfer_function_help())->capture_default_str();
  app->add_option(
      "--opacity", a.opacity,
      "auto: show rare values, hide common ones (default for presets) | given: as --tf has it");
  app->add_option("--opacity-scale", a.opacity_scale, "All extinctions times this");
  app->add_flag("--log", a.logarithmic, "Spread --tf over the values logarithmically");
  app->add_option("--range", a.range,
                  "LO:HI, the values at the ends of a preset. Default: the field's range");
  app->add_option("--background", a.background,
                  "Linear R,G,B[,A] behind a .png. Default: black (white in mode absorption)");
}

void add_camera_options(CLI::App* app, RenderArguments& a) {
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
}

void add_method_options(CLI::App* app, RenderArguments& a) {
  app->add_option("--projector", a.projector, "auto | gl | reference (exact and slow)")
      ->capture_default_str();
  app->add_option("--context", a.context, "auto | osmesa, for --projector gl")
      ->capture_default_str();
  app->add_option("--sort", a.sort, "auto | none | centroid | fragments (reference)")
      ->capture_default_str();
  app->add_option(
         "--integrator", a.integrator,
         "auto | exact (no table) | table2d (emission, absorption, mip, iso) | table3d (full)")
      ->capture_default_str();
  app->add_option("--table", a.table, "N[xM], values and lengths of the table");
  app->add_option("--threads", a.threads, "Most threads to use. Default: all");
  app->add_flag("--explain", a.explain,
                "Print how the picture is drawn, and why, before drawing it");
  app->add_option("--stats", a.stats, "Write times, counts and the plan to this JSON file");
  app->add_option("--verify", a.verify,
                  "Check N random pixels against the reference and print the error");
}

}  // namespace

void add_render(CLI::App& program) {
  CLI::App* app = program.add_subcommand("render", "Draw a picture");
  auto arguments = std::make_shared<RenderArguments>();
  app->footer("usage: tetraglass render INPUT -o OUT.png|.exr|.npy [-o ...] [options]");
  app->option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::Throw);
  app->add_option("INPUT", arguments->input,
                  "A mesh with fields, a surface, a point cloud or a grid")
      ->required();
  app->add_option("-o,--output", arguments->outputs,
                  ".png (8 bit sRGB over the background), .exr or .npy (linear premultiplied float "
                  "RGBA); repeatable")
      ->required()
      ->take_all()
      ->expected(1);
  add_scene_options(app, *arguments);
  add_camera_options(app, *arguments);
  add_method_options(app, *arguments);
  app->callback([arguments] { render(*arguments); });
}

}  // namespace tetraglass::apps
