#include "project/render.h"

#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <oneapi/tbb/global_control.h>

#include "apps/figure.h"
#include "apps/import_options.h"
#include "apps/mesh_input.h"
#include "apps/options.h"
#include "apps/picture_files.h"
#include "apps/render_arguments.h"
#include "apps/render_frames.h"
#include "apps/render_report.h"
#include "apps/scene_file.h"
#include "apps/subcommands.h"
#include "apps/transfer_function_input.h"
#include "base/output_file.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "project/effects.h"
#include "project/error_budget.h"

namespace tetraglass::apps {
namespace {

/// How the picture is drawn and what each effect is expected to cost.
void print_plan(const project::Scene& scene, const project::Plan& plan) {
  fmt::print("plan\n");
  for (const std::string& reason : plan.reasons) fmt::print("  {}\n", reason);
  fmt::print("{}",
             project::effects_table(project::planned_effects(scene, plan, base::thread_count())));
}

/// ... and what it took.
void print_costs(const project::Scene& scene, const project::Plan& plan,
                 const project::Stats& stats) {
  fmt::print(
      "what it took\n{}",
      project::effects_table(project::planned_effects(scene, plan, base::thread_count()), &stats));
}

void limit_threads(const RenderArguments& arguments, std::optional<tbb::global_control>& control) {
  if (arguments.threads.empty()) return;
  const int threads = parse_count(arguments.threads, "--threads", 1);
  control.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  // Mesa's software rasterizer reads this when the context is made; 0 there means: in the calling
  // thread.
  setenv("LP_NUM_THREADS", std::to_string(threads > 1 ? threads : 0).c_str(), 1);
}

void warn_of_plan(const project::Plan& plan) {
  if (plan.projector == project::Projector::gl &&
      plan.gl.position_rounding > project::kLargestPositionRounding) {
    warn(
        fmt::format("only a tiny part of the mesh is in the picture: there the gl projector holds "
                    "positions to {:.2g} pixels only; use --projector cpu",
                    plan.gl.position_rounding));
  }
}

struct Drawn {
  project::Plan plan;
  project::Image image;
};

// Random pixels that are checked where --max-error is given and --verify is not.
constexpr int kPixelsChecked = 500;

/// What is checked, and how far the picture may be off.
struct Checks {
  int pixels = 0;
  std::optional<double> max_error;
};

Checks parse_checks(const RenderArguments& arguments) {
  Checks checks;
  if (!arguments.max_error.empty()) {
    checks.max_error = parse_number(arguments.max_error, "--max-error");
    if (!(*checks.max_error > 0)) throw base::UsageError("--max-error needs an error above 0");
    checks.pixels = kPixelsChecked;
  }
  if (!arguments.verify.empty()) checks.pixels = parse_count(arguments.verify, "--verify", 1);
  return checks;
}

Drawn draw_within(const RenderArguments& arguments, const project::Scene& scene,
                  const project::Request& request, const Checks& checks, RenderReport& report) {
  project::VerifiedImage result =
      project::render_within(scene, request, *checks.max_error, checks.pixels);
  if (arguments.explain) print_plan(scene, result.plan);
  warn_of_plan(result.plan);
  report.stats = result.stats;
  report.verification = result.verification;
  if (!result.met) {
    warn(
        fmt::format("--max-error {} is not met: the picture errs by {:.3g}; allow other "
                    "projectors, orders and integrators, or ask for --projector reference",
                    arguments.max_error, result.verification.max_error));
  }
  return {std::move(result.plan), std::move(result.image)};
}

Drawn draw(const RenderArguments& arguments, const project::Scene& scene,
           const project::Request& request, const Checks& checks, RenderReport& report) {
  if (checks.max_error) return draw_within(arguments, scene, request, checks, report);
  Drawn drawn{project::plan(scene, request), {}};
  if (arguments.explain) print_plan(scene, drawn.plan);
  warn_of_plan(drawn.plan);
  drawn.image = project::render(scene, drawn.plan, report.stats);
  if (checks.pixels > 0) {
    report.verification = project::verify(scene, drawn.image, checks.pixels);
  }
  return drawn;
}

void write_stats(const RenderArguments& arguments, const project::Scene& scene,
                 const project::Plan& plan, const RenderReport& report) {
  if (arguments.stats.empty()) return;
  base::OutputFile stats(arguments.stats);
  stats.write(stats_json(scene, plan, report));
  stats.commit();
}

void warn_of_cells(const project::Scene& scene) {
  if (scene.grid || scene.drawable.degenerate + scene.drawable.nan == 0) return;
  warn(
      fmt::format("{} cells without volume and {} with values or coordinates that are not finite "
                  "are not drawn",
                  scene.drawable.degenerate, scene.drawable.nan));
}

/// --orbit and --time all.
void render_frames(const RenderArguments& arguments, const project::Request& request) {
  if (!arguments.max_error.empty() || !arguments.verify.empty()) {
    throw base::UsageError(
        "--max-error and --verify are of one picture: not with --orbit and --time all");
  }
  const bool times = draws_all_times(arguments);
  if (times && !arguments.orbit.empty()) {
    throw base::UsageError(
        "--orbit shows one time step: give --time T with it, or --time all alone");
  }
  (void)orbit_frames(arguments);
  mesh::ImportOptions options = arguments.import;
  options.grid_only = draws_grid(arguments);
  int steps = 1;
  std::optional<mesh::ScalarField> values;
  if (times) {
    steps = count_time_steps(arguments);
    values = values_of_all_times(arguments, steps);
    options.time = "index:0";
  }
  const mesh::Import imported = import_and_tell(arguments.input, options);
  project::Scene scene = make_scene(arguments, imported.mesh, values ? &*values : nullptr);
  warn_of_cells(scene);
  const project::Plan plan = project::plan(scene, request);
  if (arguments.explain) print_plan(scene, plan);
  warn_of_plan(plan);
  RenderReport report;
  report.import = imported.report;
  FramesDrawn drawn = times ? draw_times(arguments, steps, scene, plan, report)
                            : draw_orbit(arguments, scene, plan, report);
  report.frame_ms = std::move(drawn.frame_ms);
  if (arguments.explain) print_costs(scene, plan, report.stats);
  write_stats(arguments, scene, plan, report);
  fmt::print(stderr, "{}\n", stage_lines(report));
  fmt::print("{}\n", fmt::join(drawn.files, "\n"));
}

void render_picture(const RenderArguments& arguments, const project::Request& request) {
  const Checks checks = parse_checks(arguments);
  mesh::ImportOptions options = arguments.import;
  options.grid_only = draws_grid(arguments);
  const mesh::Import imported = import_and_tell(arguments.input, options);
  const project::Scene scene = make_scene(arguments, imported.mesh);
  warn_of_cells(scene);
  RenderReport report;
  report.import = imported.report;
  const Drawn drawn = draw(arguments, scene, request, checks, report);
  if (arguments.explain) print_costs(scene, drawn.plan, report.stats);
  if (report.verification) {
    fmt::print(
        stderr,
        "verified {} random pixels against the reference: largest error {:.3g}, RMS {:.3g}\n",
        report.verification->pixels, report.verification->max_error,
        report.verification->rms_error);
  }
  const base::Stopwatch clock;
  const auto [width, height] = parse_size(arguments.size, "--size");
  const Figure figure(arguments, scene, width, height);
  write_pictures(arguments, arguments.outputs, scene.mode,
                 figure.around(drawn.image, scene.camera));
  report.write_ms = clock.milliseconds();
  write_stats(arguments, scene, drawn.plan, report);
  fmt::print(stderr, "{}\n", stage_lines(report));
  fmt::print("{}\n", fmt::join(arguments.outputs, "\n"));
}

void render(const RenderArguments& arguments) {
  std::optional<tbb::global_control> control;
  limit_threads(arguments, control);
  const project::Request request = make_request(arguments);
  (void)parse_checks(arguments);
  check_outputs(arguments);
  if (!draws_frames(arguments)) {
    if (!arguments.fps.empty()) throw base::UsageError("--fps is for --orbit and --time all");
    render_picture(arguments, request);
  } else {
    render_frames(arguments, request);
  }
}

}  // namespace

void add_scene_options(CLI::App* app, RenderArguments& a) {
  app->add_option("--size", a.size, "Pixels, WxH")->capture_default_str();
  app->add_option("--region", a.region,
                  "X,Y,W,H: draw only these pixels of the picture, from its top left corner");
  app->add_option("--samples", a.samples,
                  "Rays that share a pixel evenly: 1 (default), 4, 9, 16 ... (smooth edges)");
  app->add_option("--field", a.field,
                  "Point or cell field; NAME:x|y|z|magnitude or NAME:INDEX of one with components. "
                  "Default: the first scalar; z where there is no field");
  add_import_options(*app, a.import);
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
                  "none | flat | smooth (default for mode iso) and, for mode full, whose medium is "
                  "then lit: single | weighted | interpolated | surface (see docs/lighting.md)");
  app->add_option("--lights", a.lights,
                  "FILE.json of directional, point and rectangle lights. Default: a headlight")
      ->type_name("FILE");
  app->add_option(
      "--gradient", a.gradient,
      "vertex (default: interpolated) | cell: the normals of --shading; of grids central "
      "(default: differences one point up and down) | sobel (smoothed)");
  app->add_option("--modulate", a.modulate,
                  "G: opacity times min(1, |gradient| / G), shows boundaries");
  app->add_option("--tf", a.transfer_function, transfer_function_help())
      ->type_name("NAME|FILE")
      ->capture_default_str();
  app->add_option(
      "--opacity", a.opacity,
      "auto (show rare values, hide common ones; default for presets) | given (as --tf has it)");
  app->add_option("--opacity-scale", a.opacity_scale, "All extinctions times this");
  app->add_flag("--log", a.logarithmic, "Spread --tf over the values logarithmically");
  app->add_option("--range", a.range,
                  "LO:HI, the values at the ends of a preset. Default: the field's range");
  app->add_option("--clip", a.clip,
                  "NX,NY,NZ,D: keep what lies where n.x <= D, cells are cut; repeatable")
      ->take_all()
      ->expected(1);
  app->add_option(
      "--depth-cue", a.depth_cue,
      "NEAR:FAR, isosurfaces fade to black between these distances along the view axis");
  app->add_option("--background", a.background,
                  "Linear R,G,B[,A] behind a .png. Default: black (white in mode absorption)");
}

void add_method_options(CLI::App* app, RenderArguments& a) {
  app->add_option("--projector", a.projector,
                  "auto | cpu | gl | reference (exact and slow); of uniform and "
                  "rectilinear grids, by their trilinear field instead of tetrahedra: "
                  "slices (textures) | grid-reference (exact and slow)")
      ->capture_default_str();
  app->add_option("--context", a.context,
                  "auto | osmesa | egl (a GPU without a display), for --projector gl and slices")
      ->capture_default_str();
  app->add_option("--sort", a.sort,
                  "auto | none | centroid | power | mpvo (of whole cells) | fragments (pixel by "
                  "pixel)")
      ->capture_default_str();
  app->add_option(
      "--opaque-at", a.opaque_at,
      "Opacity above 0, to 1, at which rays end, for --projector cpu. Default: 0.99998");
  app->add_option("--integrator", a.integrator,
                  "auto | exact (no table) | table2d (emission, absorption, mip, iso of gl) | "
                  "table3d "
                  "(full) | psi "
                  "(full) | linear (the ends of a segment only)")
      ->capture_default_str();
  app->add_option("--light-map", a.light_map,
                  "N: --lights looked up in cube maps of N x N texels instead of summed, for "
                  "--projector gl and slices");
  app->add_option("--table", a.table, "N[xM], values and lengths of the table");
  app->add_option("--layout", a.layout,
                  "auto | indexed | strip | faces12 | faces12-short (Weiler's 12 vertices a cell, "
                  "as floats or 16-bit numbers), for --projector gl")
      ->capture_default_str();
  app->add_option("--edge-fix", a.edge_fix, "on (default) | off, for --layout faces12");
  app->add_option("--minimum", a.minimum,
                  "shader (default) | texture8 | texture16: where faces12 finds the exit");
  app->add_option("--perspective", a.perspective,
                  "exact (default) | affine: what faces12 interpolates in perspective views");
  app->add_option("--target-format", a.target_format,
                  "rgba32f (default) | rgba16f | rgba8: what --projector gl accumulates in");
  app->add_option("--gpu-memory", a.gpu_memory,
                  "Most bytes of the mesh on the graphics card at once, such as 1e9; more of it is "
                  "drawn part after part, for --projector gl. Default: as many as OpenGL can hold");
  add_slices_options(*app, a.slices);
}

namespace {

void add_report_options(CLI::App* app, RenderArguments& a) {
  app->add_option("--threads", a.threads, "Most threads to use. Default: all");
  app->add_flag("--explain", a.explain,
                "Print how the picture is drawn, and why, before drawing it");
  app->add_option("--stats", a.stats, "Write times, counts and the plan to this JSON file")
      ->type_name("FILE");
  app->add_option("--max-error", a.max_error,
                  "Largest error per channel: draw as cheaply as that allows, check random pixels "
                  "against the reference (500, or as many as --verify says), step up if need be");
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
      ->type_name("FILE");
  app->add_option("-o,--output", arguments->outputs,
                  ".png (8 bit sRGB over the background), .exr or .npy (linear premultiplied float "
                  "RGBA); repeatable. Of --orbit and --time all numbered: NAME-0000.png, or where "
                  "%04d is; or .mp4, .webm, .gif through ffmpeg")
      ->type_name("FILE")
      ->take_all()
      ->expected(1);
  add_scene_options(app, *arguments);
  add_figure_options(app, arguments->figure);
  add_camera_options(app, *arguments);
  app->add_option("--orbit", arguments->orbit,
                  "N frames, once around the up direction; numbered, or a film");
  app->add_option("--fps", arguments->fps, "Frames per second of films. Default: 25");
  add_method_options(app, *arguments);
  add_report_options(app, *arguments);
  app->add_option("--scene", arguments->scene,
                  "FILE.json of options by their names; what is typed counts before it")
      ->type_name("FILE");
  app->add_option("--save-scene", arguments->save_scene,
                  "Write all options that are given to a file for --scene")
      ->type_name("FILE");
  app->callback([arguments, app] {
    if (!arguments->scene.empty()) apply_scene_file(*app, arguments->scene);
    if (arguments->input.empty()) throw base::UsageError("INPUT is required");
    if (arguments->outputs.empty()) throw base::UsageError("--output is required");
    render(*arguments);
    if (!arguments->save_scene.empty()) save_scene_file(*app, arguments->save_scene);
  });
}

}  // namespace tetraglass::apps
