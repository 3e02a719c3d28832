// Grids by slices: how the error falls with the distance of the slices, what few bits cost
// (wilson1994), frame rates beside those of meissner2002, and slices against tetrahedra of the same
// grid. Prints Markdown.
//   slices_study [convergence] [rounding] [frames|frames-64x64x64 ...] [cells [PLOT.svg]]
//   [osmesa|egl]

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/errors.h"
#include "base/stopwatch.h"
#include "bench/log_plot.h"
#include "bench/voxel_tetrahedra.h"
#include "mesh/import.h"
#include "project/compare.h"
#include "project/cpu/cell_projector.h"
#include "project/reference/grid_reference.h"
#include "project/slices/slice_projector.h"

namespace {

using namespace tetraglass;
using project::Classify;
using project::Mode;
using project::SlicesRequest;
using project::Stack;
using project::TexelBits;

constexpr int kFrames = 4;

project::ContextKind context_kind = project::ContextKind::osmesa;

/// A grid with a scene of it; not moved after it was made.
struct Data {
  std::string name;
  mesh::TetMesh mesh;
  project::Scene scene;
};

enum class Medium {
  smooth,  ///< nowhere 0
  peaks,   ///< five narrow ones with nothing between them
  core     ///< the largest values alone
};

/// Opacities relative to the diagonal.
preint::TransferFunction medium(Medium kind, const project::Scene& scene) {
  const double diagonal = mesh::bounds(*scene.mesh).diagonal().norm();
  const auto point = [&](double t, double extinction) {
    return preint::ControlPoint{scene.field.min + t * (scene.field.max - scene.field.min),
                                preint::Color(t, 1 - t, 0.5), extinction / diagonal};
  };
  std::vector<preint::ControlPoint> points;
  if (kind == Medium::smooth) {
    for (int i = 0; i <= 16; ++i) points.push_back(point(i / 16.0, 1.5 + std::sin(11 * i / 16.0)));
  } else if (kind == Medium::peaks) {
    for (int i = 0; i < 5; ++i) {
      const double t = 0.1 + 0.2 * i;
      for (const int side : {-1, 0, 1})
        points.push_back(point(t + 0.02 * side, side == 0 ? 60 : 0));
    }
  } else {
    points = {point(0.6, 0), point(1, 60)};
  }
  return preint::TransferFunction(points);
}

void look_at(Data& data, int size) {
  project::Scene& scene = data.scene;
  scene.mesh = &data.mesh;
  scene.field = mesh::select_scalar(data.mesh, "");
  scene.camera = project::frame_camera(mesh::bounds(data.mesh), Eigen::Vector3d(1, 0.8, 0.6),
                                       Eigen::Vector3d::UnitZ(), 30, 1);
  scene.width = scene.height = size;
}

/// Blobs on a grid of these points over [-1, 1]^3: only the corners are points of the mesh, the
/// grid knows the others.
void make_blobs(Data& data, const std::array<int, 3>& size, int pixels) {
  for (int i = 0; i < 8; ++i) {
    data.mesh.points.emplace_back(2 * (i & 1) - 1, (i & 2) - 1, (i & 4) / 2 - 1);
  }
  data.mesh.cells = {{0, 1, 2, 4}, {7, 3, 5, 6}};  // for its bounds
  mesh::Field field{"blobs", mesh::Location::point, 1, std::vector<double>(8, 0.0)};
  data.mesh.fields.push_back(field);
  look_at(data, pixels);
  mesh::RectilinearGrid grid;
  grid.origin = {-1, -1, -1};
  for (std::size_t k = 0; k < 3; ++k) {
    grid.even[k] = true;
    for (int i = 0; i < size[k]; ++i) grid.coordinates[k].push_back(i);
    grid.axes.col(static_cast<Eigen::Index>(k)) *= 2.0 / (size[k] - 1);
  }
  std::vector<double>& values = data.scene.field.values;
  values.clear();
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        const Eigen::Vector3d p = grid.origin + grid.axes * Eigen::Vector3d(i, j, k);
        const double blobs = std::sin(5 * p.x()) * std::sin(4 * p.y() + 1) * std::sin(6 * p.z());
        values.push_back(std::max(0.0, blobs) * std::exp(-p.squaredNorm()));
      }
    }
  }
  data.scene.field.min = 0;
  data.scene.field.max = *std::ranges::max_element(values);
  data.scene.grid = std::move(grid);
  data.scene.transfer_function = medium(Medium::smooth, data.scene);
}

/// The grid of the study: neghip where it is.
void make_protein(Data& data, int pixels) {
  const char* folder = std::getenv("TETRAGLASS_DATA");
  const std::filesystem::path file =
      std::filesystem::path(folder != nullptr ? folder : "../shared/data") /
      "volumes/neghip_64x64x64_uint8.raw";
  if (!std::filesystem::exists(file)) {
    fmt::print(stderr, "no {}: blobs take its place (TETRAGLASS_DATA names its folder)\n",
               file.string());
    data.name = "blobs, 64^3";
    make_blobs(data, {64, 64, 64}, pixels);
    return;
  }
  data.name = "neghip, 64^3";
  mesh::ImportOptions options;
  options.raw = "64x64x64:uint8";
  data.mesh = mesh::import_mesh(file.string(), options).mesh;
  look_at(data, pixels);
  data.scene.grid = mesh::rectilinear_grid(data.mesh);
  data.scene.transfer_function = medium(Medium::smooth, data.scene);
}

/// Of the cube maps of lit slices, as meissner2002 has it.
constexpr int kLightMap = 64;

project::Plan plan_of(const project::Scene& scene, const SlicesRequest& slices, int table = 0) {
  project::Request request;
  request.projector = project::Projector::slices;
  request.context = context_kind;
  request.slices = slices;
  if (scene.lights) request.light_map = kLightMap;
  if (table > 0) {
    request.integrator = project::Integrator::table2d;
    request.table_n = table;
  }
  return project::plan(scene, request);
}

struct Drawn {
  project::Image image;
  double ms = 0;  ///< the fastest of some frames, without making textures, tables and shaders
  std::uint64_t fragments = 0;
  std::size_t bytes = 0;
};

template <class Projector>
Drawn draw_frames(Projector& projector, const project::Frame& frame, int frames) {
  Drawn drawn;
  for (int i = 0; i <= frames; ++i) {
    project::Stats stats;
    const base::Stopwatch clock;
    drawn.image = projector.draw(frame, stats);
    const double ms = clock.milliseconds();
    if (i == 1 || (i > 1 && ms < drawn.ms)) drawn.ms = ms;
    drawn.fragments = stats.fragments;
  }
  return drawn;
}

Drawn draw(const project::gl::Context& context, const project::Scene& scene,
           const SlicesRequest& slices, int table = 0, int frames = 0) {
  project::Stats stats;
  project::slices::SliceProjector projector(context, scene, plan_of(scene, slices, table), stats);
  Drawn drawn = draw_frames(projector, project::make_frame(scene), frames);
  drawn.bytes = projector.bytes();
  return drawn;
}

void print_convergence(const project::gl::Context& context) {
  Data data;
  make_protein(data, 128);
  fmt::print(
      "## Error against the grid's reference, {}, 128 x 128 pixels\n\n"
      "RMS of all channels; the order is that from one row to the next.\n\n",
      data.name);
  for (const bool peaks : {false, true}) {
    data.scene.transfer_function = medium(peaks ? Medium::peaks : Medium::smooth, data.scene);
    project::Stats stats;
    const project::Image exact = render_grid_reference(data.scene, stats);
    fmt::print(
        "| {}: slices | post | order | integrated | order | table, 256 | order | 2d, "
        "integrated | order | nearest |\n|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n",
        peaks ? "narrow peaks" : "smooth");
    std::vector<double> last;
    for (const int n : {32, 64, 128, 256, 512, 1024, 2048}) {
      std::vector<double> errors;
      const auto add = [&](Classify classify, Stack stack, int table, project::Filter filter) {
        SlicesRequest request;
        request.classify = classify;
        request.stack = stack;
        request.slices = n;
        request.filter = filter;
        errors.push_back(compare(draw(context, data.scene, request, table).image, exact).rms);
      };
      add(Classify::post, Stack::planes, 0, project::Filter::linear);
      add(Classify::integrated, Stack::planes, 0, project::Filter::linear);
      add(Classify::integrated, Stack::planes, 256, project::Filter::linear);
      add(Classify::integrated, Stack::textures, 0, project::Filter::linear);
      add(Classify::post, Stack::planes, 0, project::Filter::nearest);
      std::string line = fmt::format("| {}", n);
      for (std::size_t i = 0; i < errors.size(); ++i) {
        line += fmt::format(" | {:.1e}", errors[i]);
        if (i + 1 == errors.size()) continue;
        line += last.empty() ? " | " : fmt::format(" | {:.1f}", std::log2(last[i] / errors[i]));
      }
      fmt::print("{} |\n", line);
      last = errors;
    }
    fmt::print("\n");
  }
}

void print_rounding(const project::gl::Context& context) {
  Data data;
  make_protein(data, 200);
  fmt::print(
      "## What bits and slices cost, {}, 200 x 200 pixels\n\n"
      "Largest and RMS difference to the same picture with floats; milliseconds a frame.\n\n"
      "| colors first (pre): slices | 8 bits | ms | 12 bits | ms | 16 bits | ms | floats, ms | 8 "
      "bits, nearest, ms |\n|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n",
      data.name);
  for (const Classify classify : {Classify::pre, Classify::post}) {
    if (classify == Classify::post) {
      fmt::print(
          "\n| values (post): slices | 8 bits | ms | 12 bits | ms | 16 bits | ms | floats, ms | 8 "
          "bits, nearest, ms |\n|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    }
    for (const int n : {60, 120, 240, 480, 960, 1920}) {
      SlicesRequest request;
      request.classify = classify;
      request.slices = n;
      request.skip_empty = false;
      const Drawn floats = draw(context, data.scene, request, 0, kFrames);
      std::string line = fmt::format("| {}", n);
      for (const TexelBits bits : {TexelBits::bits8, TexelBits::bits12, TexelBits::bits16}) {
        request.texels = bits;
        const Drawn drawn = draw(context, data.scene, request, 0, kFrames);
        const project::Difference d = compare(drawn.image, floats.image);
        line += fmt::format(" | {:.1e} / {:.1e} | {:.0f}", d.max, d.rms, drawn.ms);
      }
      request.texels = TexelBits::bits8;
      request.filter = project::Filter::nearest;
      fmt::print("{} | {:.0f} | {:.0f} |\n", line, floats.ms,
                 draw(context, data.scene, request, 0, kFrames).ms);
    }
  }
  fmt::print("\n");
}

struct Published {
  std::array<int, 3> size;
  std::array<const char*, 2> no_light;  // frames a second at 200 x 200, 400 x 400
  std::array<const char*, 2> cube_map;
};

// Tables 1 and 2 of meissner2002, Radeon 8500. Their column of compression has lighting too.
const std::vector<Published> kPublished = {{{64, 64, 64}, {"82.8", "37.3"}, {"36.1", "12.7"}},
                                           {{128, 128, 128}, {"18.4", "11.4"}, {"12.8", "5.5"}},
                                           {{256, 256, 128}, {"8.2", "5.0"}, {"4.6", "2.5"}},
                                           {{256, 256, 256}, {"3.6", "2.3"}, {"-", "-"}}};

void print_frames_head() {
  fmt::print(
      "## Frames per second beside meissner2002 (Tables 1 and 2, Radeon 8500)\n\n"
      "Slices one point apart, values of 8 bits; 2d: one slice at each plane.\n\n"
      "| data | pixels | paper, no light | table of 256 | integrated | post | post, core alone | "
      "the same, empty blocks passed over | 2d, post | 2d, compressed | paper, cube maps | post, "
      "cube maps | MB 3d | MB 2d, compressed |\n"
      "|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
}

void print_frames(const project::gl::Context& context, const Published& row) {
  Data data;
  make_blobs(data, row.size, 200);
  for (std::size_t i = 0; i < 2; ++i) {
    data.scene.width = data.scene.height = i == 0 ? 200 : 400;
    SlicesRequest request;
    request.distance = 2.0 / (row.size[0] - 1);
    request.texels = TexelBits::bits8;
    request.skip_empty = false;
    const auto rate = [&](int table = 0) {
      return draw(context, data.scene, request, table, kFrames);
    };
    const Drawn table = rate(256);
    const Drawn exact = rate();
    request.classify = Classify::post;
    const Drawn post = rate();
    project::Lights light;
    light.lights.emplace_back(project::DirectionalLight{{-1, -0.3, -0.8}, {1, 0.95, 0.9}});
    data.scene.lights = light;
    data.scene.shading = project::Shading::single;
    const Drawn lit = rate();
    data.scene.lights.reset();
    data.scene.shading = project::Shading::none;
    data.scene.transfer_function = medium(Medium::core, data.scene);
    const Drawn whole = rate();
    request.skip_empty = true;
    const Drawn skipped = rate();
    data.scene.transfer_function = medium(Medium::smooth, data.scene);
    request.skip_empty = false;
    request.distance.reset();
    request.stack = Stack::textures;
    const Drawn textures = rate();
    request.compress = true;
    const Drawn compressed = rate();
    fmt::print(
        "| {} x {} x {} | {} | {} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} "
        "| {} | {:.1f} | {:.1f} | {:.1f} |\n",
        row.size[0], row.size[1], row.size[2], data.scene.width, row.no_light[i], 1000 / table.ms,
        1000 / exact.ms, 1000 / post.ms, 1000 / whole.ms, 1000 / skipped.ms, 1000 / textures.ms,
        1000 / compressed.ms, row.cube_map[i], 1000 / lit.ms, double(exact.bytes) / 1e6,
        double(compressed.bytes) / 1e6);
  }
}

/// What a mesh takes: points, cells, values.
std::size_t mesh_bytes(const mesh::TetMesh& mesh) {
  return mesh.points.size() * sizeof(mesh.points[0]) + mesh.cells.size() * sizeof(mesh.cells[0]) +
         mesh.fields[0].values.size() * sizeof(double);
}

void print_cells(const project::gl::Context& context, const std::string& plot_file) {
  fmt::print(
      "## Slices against tetrahedra of the same grid, 400 x 400 pixels\n\n"
      "RMS error against the reference of the trilinear field; cells by the projector cpu.\n\n"
      "| points | drawn as | cells | ms | RMS error | MB |\n|---|---|---:|---:|---:|---:|\n");
  bench::LogPlot plot("milliseconds a frame", "RMS error");
  for (const int n : {16, 32, 64}) {
    Data data;
    make_blobs(data, {n, n, n}, 400);
    project::Stats stats;
    const project::Image exact = render_grid_reference(data.scene, stats);
    const auto print = [&](const std::string& name, std::size_t cells, const Drawn& drawn,
                           std::size_t bytes) {
      const double rms = compare(drawn.image, exact).rms;
      fmt::print("| {0} x {0} x {0} | {1} | {2} | {3:.0f} | {4:.1e} | {5:.2f} |\n", n, name, cells,
                 drawn.ms, rms, double(bytes) / 1e6);
      plot.add(name, drawn.ms, rms, std::to_string(n));
    };
    for (const double apart : {1.0, 0.5, 0.25}) {
      SlicesRequest request;
      request.distance = apart * 2.0 / (n - 1);
      const Drawn drawn = draw(context, data.scene, request, 0, kFrames);
      print(fmt::format("slices, {} points apart", apart), 0, drawn, drawn.bytes);
    }
    for (const int per_voxel : {5, 6, 24}) {
      mesh::TetMesh mesh = bench::VoxelTetrahedra(n, data.scene.field.values, per_voxel).take();
      project::Scene scene = data.scene;
      scene.mesh = &mesh;
      scene.field = mesh::select_scalar(mesh, "");
      scene.drawable = mesh::find_drawable(mesh, scene.field);
      scene.grid.reset();
      project::Request request;
      request.projector = project::Projector::cpu;
      project::cpu::CellProjector projector(scene, project::plan(scene, request));
      print(fmt::format("{} cells a voxel", per_voxel), mesh.cells.size(),
            draw_frames(projector, project::make_frame(scene), 2), mesh_bytes(mesh));
    }
  }
  if (!plot_file.empty()) plot.write(plot_file);
  fmt::print("\n");
}

}  // namespace

int main(int argc, char** argv) {
  std::set<std::string> parts;
  std::string plot_file;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "egl") {
      context_kind = project::ContextKind::egl;
    } else if (argument.ends_with(".svg")) {
      plot_file = argument;
    } else if (argument != "osmesa") {
      parts.insert(argument);
    }
  }
  const auto wants = [&](const char* part) { return parts.empty() || parts.count(part) > 0; };
  try {
    const auto context = project::gl::Context::create(context_kind);
    fmt::print("{}, fastest of {} frames\n\n", context->description(), kFrames);
    if (wants("convergence")) print_convergence(*context);
    if (wants("rounding")) print_rounding(*context);
    if (wants("frames")) print_frames_head();
    for (const Published& row : kPublished) {
      if (wants("frames") || wants(fmt::format("frames-{}", fmt::join(row.size, "x")).c_str())) {
        print_frames(*context, row);
      }
    }
    if (wants("cells")) print_cells(*context, plot_file);
  } catch (const base::Error& error) {
    fmt::print(stderr, "slices_study: error: {}\n", error.what());
    return 1;
  }
  return 0;
}
