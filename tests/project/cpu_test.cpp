// The native projector against the reference and against what is known in closed form.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <oneapi/tbb/global_control.h>

#include "mesh/samples.h"
#include "project/compare.h"
#include "project/cpu/cell_projector.h"
#include "project/cpu/cpu_projector.h"
#include "project/reference/reference.h"
#include "tests/support/chord.h"
#include "tests/support/covered_once.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace tetraglass::project {
namespace {

using tests::box;
using tests::chord;
using tests::constant_medium;
using tests::down_z;
using tests::make_scene;

const Eigen::AlignedBox3d kBox(Eigen::Vector3d(-1, -0.5, -2), Eigen::Vector3d(1, 0.75, 2));

double zero(const Eigen::Vector3d&) {
  return 0;
}

Image draw(const Scene& scene, Stats* stats = nullptr) {
  Request request;
  request.projector = Projector::cpu;
  Stats own;
  return render_cpu(scene, plan(scene, request), stats != nullptr ? *stats : own);
}

Image draw_reference(const Scene& scene) {
  Stats stats;
  return render_reference(scene, stats);
}

struct View {
  std::string name;
  Camera camera;
};

std::vector<View> views(const mesh::Box& bounds) {
  const Camera outside = frame_camera(bounds, {1, 0.8, 0.6}, Eigen::Vector3d::UnitZ(), 30, 1);
  Camera parallel = outside;
  parallel.parallel = true;
  Camera inside = outside;
  inside.eye = bounds.center() + Eigen::Vector3d(0.07, 0.1, 0.13).cwiseProduct(bounds.sizes());
  inside.fov_degrees = 120;
  Camera far = outside;
  far.eye *= 1000;
  far.fov_degrees /= 1000;
  Camera along_z = frame_camera(bounds, {0, 0, 1}, Eigen::Vector3d::UnitY(), 30, 1);
  along_z.parallel = true;
  return {{"outside", outside},
          {"eye inside", inside},
          {"parallel", parallel},
          {"far away", far},
          {"along z", along_z}};
}

// Floats hold a depth in units of the mesh's half diagonal to 2^-24; only the first and the last of
// a ray's faces count.
constexpr double kLength = 3e-6;

TEST(Cpu, ThicknessIsTheChord) {
  const mesh::TetMesh mesh = box(kBox.min(), kBox.max(), 3, 3, 3, zero);
  std::vector<View> all = views(kBox);
  Camera on_vertex = all[1].camera;
  on_vertex.eye = {-1.0 / 3, -0.5 + 1.25 / 3, -2.0 / 3};
  all.push_back({"eye on a vertex", on_vertex});
  for (const View& view : all) {
    Scene scene = make_scene(mesh, Mode::thickness, constant_medium({1, 1, 1}, 1), 100);
    scene.camera = view.camera;
    const Frame frame(scene.camera, 100, 100);
    const Image image = draw(scene);
    for (int y = 0; y < 100; ++y) {
      for (int x = 0; x < 100; ++x) {
        const double expected = chord(kBox, frame, x, y);
        const double tolerance = kLength * kBox.diagonal().norm();
        EXPECT_NEAR(image.pixel(x, y)[0], expected, tolerance) << view.name << ' ' << x << ' ' << y;
        EXPECT_EQ(image.pixel(x, y)[3], image.pixel(x, y)[0] > 0 ? 1 : 0) << view.name;
      }
    }
  }
}

TEST(Cpu, RaysThroughEdgesMeetEachCellOnce) {
  tests::expect_edges_covered_once([](const Scene& scene) { return draw(scene); });
}

TEST(Cpu, MapCoordinatesLoseNothing) {
  // As in a national grid: some 5e6 metres from the origin, a part of 10 metres.
  const Eigen::Vector3d offset(3.5e6, 5.6e6, 200);
  const mesh::TetMesh near = box(kBox.min(), kBox.max(), 3, 3, 3, zero);
  mesh::TetMesh far = near;
  for (Eigen::Vector3d& point : far.points) point += offset;
  Scene scene = make_scene(near, Mode::thickness, constant_medium({1, 1, 1}, 1), 64);
  const Image expected = draw(scene);
  Scene moved = make_scene(far, Mode::thickness, constant_medium({1, 1, 1}, 1), 64);
  moved.camera = scene.camera;
  moved.camera.eye += offset;
  moved.camera.target += offset;
  EXPECT_LE(compare(draw(moved), expected).max, 2e-6 * kBox.diagonal().norm());
}

struct Case {
  std::string name;
  Mode mode;
  MipOf mip_of;
};

// The bounds of all. What is left are the roundings of floats, the largest where an extinction of
// hundreds over the diagonal rises within a hundredth of the range, and the 2e-5 behind opaque
// pixels.
constexpr double kLargest = 1e-4;
constexpr double kRms = 5e-6;

const std::vector<Case> kCases = {
    {"thickness", Mode::thickness, MipOf::field},   {"emission", Mode::emission, MipOf::field},
    {"absorption", Mode::absorption, MipOf::field}, {"mip", Mode::mip, MipOf::field},
    {"mip of tf", Mode::mip, MipOf::transfer},      {"full", Mode::full, MipOf::field},
};

/// Compares with the reference and prints a line of a table.
void expect_agreement(const Scene& scene, const std::string& name) {
  Image image = draw(scene);
  Image reference = draw_reference(scene);
  if (scene.mode == Mode::thickness) {  // whether a ray that grazes the mesh meets it is rounding
    const auto diagonal = static_cast<float>(mesh::bounds(*scene.mesh).diagonal().norm());
    for (Image* picture : {&image, &reference}) {
      for (std::size_t i = 0; i < picture->rgba.size(); ++i) {
        picture->rgba[i] = i % 4 == 3 ? 0 : picture->rgba[i] / diagonal;
      }
    }
  }
  const Difference difference = compare(image, reference);
  fmt::print("{:<44} {:>9.2e} {:>9.2e}\n", name, difference.max, difference.rms);
  EXPECT_LE(difference.max, kLargest)
      << name << " at (" << difference.worst_x << ", " << difference.worst_y << ")";
  EXPECT_LE(difference.rms, kRms) << name;
}

/// Narrow peaks with nothing in between, one of them with jumps on both sides.
preint::TransferFunction peaks(const mesh::ScalarField& field, double extinction) {
  const auto at = [&](double t) { return field.min + t * (field.max - field.min); };
  return preint::TransferFunction({{at(0.1), {1, 0, 0}, 0},
                                   {at(0.12), {1, 0.5, 0}, extinction},
                                   {at(0.15), {0, 1, 0}, 0},
                                   {at(0.4), {0, 0, 1}, 0},
                                   {at(0.4), {0, 0.2, 1}, extinction},
                                   {at(0.45), {1, 1, 1}, extinction / 2},
                                   {at(0.45), {1, 1, 1}, 0},
                                   {at(0.7), {0.2, 1, 1}, 0},
                                   {at(0.71), {0.2, 1, 0}, 3 * extinction},
                                   {at(0.72), {1, 0, 1}, 0}});
}

mesh::TetMesh sample(const std::string& name) {
  return mesh::make_sample(name, name == "cycle" ? 0 : 20000);
}

class CpuAgreement : public testing::TestWithParam<std::string> {};

TEST_P(CpuAgreement, WithTheReference) {
  const mesh::TetMesh mesh = sample(GetParam());
  const mesh::Box bounds = mesh::bounds(mesh);
  const mesh::ScalarField field = mesh::select_scalar(mesh, "");
  const auto tf = preint::preset("viridis", field.min, field.max, bounds.diagonal().norm());
  for (const Case& what : kCases) {
    for (const View& view : views(bounds)) {
      Scene scene = make_scene(mesh, what.mode, tf, 72);  // several tiles each way
      scene.camera = view.camera;
      scene.mip_of = what.mip_of;
      expect_agreement(scene, GetParam() + ", " + view.name + ", " + what.name);
    }
  }
}

TEST_P(CpuAgreement, OfPeaksAndDenseMedia) {
  const mesh::TetMesh mesh = sample(GetParam());
  const mesh::ScalarField field = mesh::select_scalar(mesh, "");
  for (const double extinction : {3.0, 300.0}) {
    for (const Case& what : kCases) {
      if (what.mode == Mode::thickness || (what.mode == Mode::emission && extinction > 3)) continue;
      Scene scene = make_scene(mesh, what.mode, peaks(field, extinction), 48);
      scene.mip_of = what.mip_of;
      expect_agreement(scene,
                       fmt::format("{}, peaks of {}, {}", GetParam(), extinction, what.name));
    }
  }
}

TEST_P(CpuAgreement, OfCellFields) {
  mesh::TetMesh mesh = sample(GetParam());
  mesh::Field of_cells{"cells", mesh::Location::cell, 1, {}};
  for (std::size_t i = 0; i < mesh.cells.size(); ++i) {
    of_cells.values.push_back(static_cast<double>(i * 7919 % 1000));
  }
  mesh.fields = {of_cells};
  const mesh::ScalarField field = mesh::select_scalar(mesh, "");
  for (const Case& what : kCases) {
    if (what.mode == Mode::thickness) continue;
    Scene scene = make_scene(mesh, what.mode, peaks(field, 3), 48);
    scene.mip_of = what.mip_of;
    expect_agreement(scene, GetParam() + ", cell field, " + what.name);
  }
}

/// Surfaces have edges: a ray that grazes one may meet it in one picture only. Few do; all others
/// differ by rounding alone.
TEST_P(CpuAgreement, OfIsosurfaces) {
  const mesh::TetMesh mesh = sample(GetParam());
  const mesh::ScalarField field = mesh::select_scalar(mesh, "");
  for (const Shading shading : {Shading::none, Shading::flat, Shading::smooth}) {
    for (const double opacity : {1.0, 0.5}) {
      for (const View& view : views(mesh::bounds(mesh))) {
        Scene scene = make_scene(mesh, Mode::iso, constant_medium({1, 1, 1}, 1), 60);
        scene.camera = view.camera;
        scene.shading = shading;
        for (const double t : {0.3, 0.5, 0.8}) {
          scene.isosurfaces.push_back(
              {field.min + t * (field.max - field.min), {t, 1 - t, 0.5}, opacity});
        }
        const Image image = draw(scene);
        const Image reference = draw_reference(scene);
        std::size_t shown = 0;
        std::size_t different = 0;
        for (std::size_t i = 0; i < image.rgba.size(); ++i) {
          if (std::abs(image.rgba[i] - reference.rgba[i]) > 1e-3F) ++different;
          if (reference.rgba[i] > 0) ++shown;
        }
        EXPECT_GT(shown, 100U) << view.name;
        EXPECT_LE(different, shown / 500)
            << view.name << ", " << to_string(shading) << ", " << opacity << ", largest "
            << compare(image, reference).max;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Samples, CpuAgreement,
                         testing::Values("sphere", "orbital", "shells", "cavity", "cycle",
                                         "needles"),
                         [](const auto& sample) { return sample.param; });

// Cells that overlap and leave holes, each reaching through much of the mesh, in no order at all:
// the window of the delay lines is too short.
TEST(Cpu, OverlappingCellsAreInExactOrder) {
  std::mt19937 random;  // the default seed
  const auto number = [&] { return static_cast<double>(random()) / 4294967296.0; };
  mesh::TetMesh mesh;
  mesh::Field field{"s", mesh::Location::point, 1, {}};
  for (std::uint32_t i = 0; i < 300; ++i) {
    for (int k = 0; k < 4; ++k) {
      mesh.points.emplace_back(number(), number(), number());
      field.values.push_back(number());
    }
    mesh.cells.push_back({4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3});
    if (tests::volume(mesh, mesh.cells.back()) < 0) {
      std::swap(mesh.cells.back()[0], mesh.cells.back()[1]);
    }
  }
  mesh.fields = {field};
  for (const double extinction : {1.0, 20.0}) {
    Scene scene =
        make_scene(mesh, Mode::full,
                   preint::TransferFunction(
                       {{0, {1, 0, 0}, 0}, {0.5, {0, 1, 0}, extinction}, {1, {0, 0, 1}, 0}}));
    for (const View& view : views(mesh::bounds(mesh))) {
      scene.camera = view.camera;
      expect_agreement(scene, fmt::format("overlaps of {}, {}", extinction, view.name));
    }
  }
}

TEST(Cpu, ThreadsDoNotChangeThePicture) {
  const mesh::TetMesh mesh = mesh::make_sample("orbital", 20000);
  const auto tf = preint::preset("viridis", 0, 1, 3);
  for (const Case& what : kCases) {
    Scene scene = make_scene(mesh, what.mode, tf, 200);
    scene.mip_of = what.mip_of;
    const Image several = draw(scene);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(draw(scene).rgba, several.rgba) << what.name;
  }
}

TEST(Cpu, ProjectorDrawsManyViews) {
  const mesh::TetMesh mesh =
      box(kBox.min(), kBox.max(), 3, 3, 3, [](const auto& p) { return p.x(); });
  for (const Case& what : kCases) {
    Scene scene = make_scene(mesh, what.mode, preint::preset("viridis", -1, 1, 4), 72);
    Request request;
    request.projector = Projector::cpu;
    cpu::CellProjector projector(scene, plan(scene, request));
    for (const View& view : views(kBox)) {
      scene.camera = view.camera;
      Stats stats;
      EXPECT_EQ(projector.draw(Frame(view.camera, 72, 72), stats).rgba, draw(scene).rgba)
          << what.name << ' ' << view.name;
      EXPECT_GT(stats.fragments, 0U);
    }
  }
}

/// Cells that hold no more than what all rays of a block have met are passed over.
TEST(Cpu, LargestValuesHideTheRest) {
  const mesh::TetMesh mesh = mesh::make_sample("orbital", 50000);
  Scene scene = make_scene(mesh, Mode::thickness, preint::preset("viridis", 0, 1, 4), 200);
  Stats all;
  (void)draw(scene, &all);
  scene.mode = Mode::mip;
  Stats largest;
  (void)draw(scene, &largest);
  EXPECT_GT(largest.fragments, 1000U);
  EXPECT_LT(2 * largest.fragments, all.fragments);
}

/// Besides the mesh: in all modes at most 64 bytes a cell, but for what orders fragments, which
/// does not grow with the mesh but for a few numbers of each cell of the tiles in work.
TEST(Cpu, HoldsLittleOfEachCell) {
  const mesh::TetMesh mesh = mesh::make_sample("orbital", 150000);
  const mesh::ScalarField field = mesh::select_scalar(mesh, "");
  for (const Case& what : kCases) {
    Scene scene =
        make_scene(mesh, what.mode, preint::preset("viridis", field.min, field.max, 4), 512);
    scene.mip_of = what.mip_of;
    Stats stats;
    (void)draw(scene, &stats);
    std::size_t bytes = 0;
    for (const auto& [effect, work] : stats.work) bytes += effect == Effect::order ? 0 : work.bytes;
    EXPECT_LE(bytes, 64 * mesh.cells.size()) << what.name;
    EXPECT_GT(bytes, 40 * mesh.cells.size()) << what.name;
    if (stats.work.count(Effect::order) == 0) continue;
    const std::size_t threads = static_cast<std::size_t>(stats.threads);
    EXPECT_LE(stats.work.at(Effect::order).bytes, threads * 3000000) << what.name;
  }
}

/// A projector that is told of other values, colors and surfaces draws what a new one would.
TEST(Cpu, UpdatesDrawWhatANewProjectorDraws) {
  const mesh::TetMesh mesh =
      box(kBox.min(), kBox.max(), 5, 5, 5, [](const auto& p) { return p.x(); });
  const auto check = [&](Scene scene, SortMethod sort) {
    Request request;
    request.projector = Projector::cpu;
    request.sort = sort;
    cpu::CellProjector projector(scene, plan(scene, request));
    const auto expect_same = [&](const std::string& what) {
      projector.update();
      cpu::CellProjector fresh(scene, plan(scene, request));
      Stats stats;
      const Frame frame = make_frame(scene);
      EXPECT_EQ(projector.draw(frame, stats).rgba, fresh.draw(frame, stats).rgba)
          << to_string(scene.mode) << ", " << to_string(sort) << ": " << what;
      EXPECT_GT(stats.fragments, 0U);
    };
    Stats stats;
    (void)projector.draw(make_frame(scene), stats);
    scene.transfer_function = peaks(scene.field, 5);
    for (preint::Isosurface& surface : scene.isosurfaces) surface.value += 0.3;
    expect_same("fewer cells shown");
    for (double& value : scene.field.values) value = -0.5 * value * value;
    scene.field.min = *std::min_element(scene.field.values.begin(), scene.field.values.end());
    scene.field.max = 0;
    for (preint::Isosurface& surface : scene.isosurfaces) surface.value = -0.1;
    expect_same("other values");
    scene.transfer_function = preint::preset("viridis", scene.field.min, 0, 4);
    expect_same("all cells shown");
    scene.drawable.cells.resize(scene.drawable.cells.size() / 2);
    expect_same("half of the cells drawable");
  };
  for (const Case& what : kCases) {
    Scene scene = make_scene(mesh, what.mode, preint::preset("viridis", -1, 1, 4), 72);
    scene.mip_of = what.mip_of;
    const SortMethod exact = what.mode == Mode::full ? SortMethod::fragments : SortMethod::none;
    check(scene, exact);
    if (what.mode != Mode::full) continue;
    check(scene, SortMethod::mpvo);
    scene.shading = Shading::smooth;
    check(scene, exact);
    scene.shading = Shading::none;
    scene.modulation = 1;
    check(scene, exact);
  }
  Scene surfaces = make_scene(mesh, Mode::iso, preint::preset("viridis", -1, 1, 4), 72);
  surfaces.isosurfaces = {{-0.3, {1, 0, 0}, 0.5}, {0.1, {0, 1, 0}, 0.5}};
  check(surfaces, SortMethod::fragments);
}

/// Every instruction set that the machine has draws what the widest one does.
TEST(Cpu, InstructionSetsAgree) {
  const mesh::TetMesh mesh = mesh::make_sample("orbital", 3000);
  const mesh::ScalarField field = mesh::select_scalar(mesh, "");
  const double diagonal = mesh::bounds(mesh).diagonal().norm();
  const auto tf = preint::preset("viridis", field.min, field.max, diagonal);
  struct InstructionSet {
    std::string name;
    std::int64_t target;
  };
  for (const InstructionSet& set :
       {InstructionSet{"AVX2", HWY_AVX2}, {"SSE4", HWY_SSE4}, {"NEON", HWY_NEON}, {"none", 0}}) {
    if ((hwy::SupportedTargets() & set.target) != set.target) {
      fmt::print("{}: not on this machine\n", set.name);
      continue;
    }
    double most = 0;
    for (const Case& what : kCases) {
      for (const View& view : views(mesh::bounds(mesh))) {
        Scene scene = make_scene(mesh, what.mode, tf, 40);
        scene.camera = view.camera;
        scene.mip_of = what.mip_of;
        const Image widest = draw(scene);
        hwy::GetChosenTarget().Update(set.target);
        const Image image = draw(scene);
        hwy::GetChosenTarget().DeInit();
        const double unit = what.mode == Mode::thickness ? diagonal : 1;
        const double difference = compare(image, widest).max / unit;
        EXPECT_LE(difference, 1e-6) << set.name << ", " << view.name << ", " << what.name;
        most = std::max(most, difference);
      }
    }
    fmt::print("{}: {:.1e}\n", set.name, most);
  }
}

TEST(Cpu, NothingDrawableGivesAnEmptyPicture) {
  mesh::TetMesh flat = tests::unit_tetrahedron();
  flat.points[3] = {1, 1, 0};
  for (const mesh::TetMesh& mesh : {flat, mesh::TetMesh{{}, {}, {flat.fields[0]}}}) {
    Scene scene = make_scene(flat, Mode::thickness, constant_medium({1, 1, 1}, 1), 8);
    scene.mesh = &mesh;
    scene.drawable.cells.clear();
    for (const float channel : draw(scene).rgba) EXPECT_EQ(channel, 0);
  }
}

}  // namespace
}  // namespace tetraglass::project
