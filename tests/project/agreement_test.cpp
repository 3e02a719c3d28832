// Every projector gives the picture of the reference: a table of the largest and RMS errors per
// channel, and a bound for each row.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "mesh/import.h"
#include "mesh/samples.h"
#include "preint/transfer_function.h"
#include "project/compare.h"
#include "project/reference/reference.h"
#include "project/render.h"
#include "tests/support/data.h"
#include "tests/support/scenes.h"

namespace tetraglass::project {
namespace {

constexpr int kSize = 64;  // pixels each way

struct View {
  std::string name;
  Camera camera;
};

std::vector<View> views(const mesh::Box& box) {
  const Camera outside = frame_camera(box, {1, 0.8, 0.6}, Eigen::Vector3d::UnitZ(), 30, 1);
  Camera parallel = outside;
  parallel.parallel = true;
  Camera inside = outside;
  inside.eye = box.center() + 0.1 * box.diagonal();
  inside.fov_degrees = 90;
  return {{"parallel", parallel}, {"perspective", outside}, {"eye inside", inside}};
}

struct Case {
  Mode mode;
  Integrator integrator;
  Shading shading;
  double max_bound;  // per channel; thickness: relative to the diagonal
};

// Exact in its integrals, gl differs from the reference by its floats alone; the bounds leave room
// for a ray that grazes an edge. `full` adds the order of the centroids, which is wrong at about a
// fifth of the faces; tables add what lies between their entries.
const std::vector<Case> kCases = {
    {Mode::thickness, Integrator::exact, Shading::none, 5e-5},
    {Mode::emission, Integrator::exact, Shading::none, 2e-4},
    {Mode::emission, Integrator::table2d, Shading::none, 1e-3},
    {Mode::absorption, Integrator::exact, Shading::none, 2e-4},
    {Mode::mip, Integrator::exact, Shading::none, 2e-4},
    {Mode::full, Integrator::exact, Shading::none, 5e-3},
    {Mode::full, Integrator::table3d, Shading::none, 5e-3},
};

class Agreement : public testing::Test {
 protected:
  static Image draw(const Scene& scene, const Case& what, bool reference) {
    Request request;
    request.projector = reference ? Projector::reference : Projector::gl;
    if (!reference && what.integrator != Integrator::exact) request.integrator = what.integrator;
    Stats stats;
    return render(scene, plan(scene, request), stats);
  }

  static void compare_all(const std::string& name, const mesh::TetMesh& mesh,
                          const std::string& field) {
    const mesh::Box box = mesh::bounds(mesh);
    const double diagonal = box.diagonal().norm();
    const mesh::ScalarField values = mesh::select_scalar(mesh, field);
    const preint::TransferFunction tf = preint::preset("viridis", values.min, values.max, diagonal);
    fmt::print("{:<10} {:<12} {:<11} {:<9} {:>10} {:>10}\n", "data", "view", "mode", "integral",
               "largest", "RMS");
    for (const View& view : views(box)) {
      Image reference;
      for (const Case& what : kCases) {
        Scene scene = tests::make_scene(mesh, what.mode, tf, kSize, field);
        scene.camera = view.camera;
        if (what.integrator == Integrator::exact) reference = draw(scene, what, true);
        const Image image = draw(scene, what, false);
        Difference difference = compare(image, reference);
        if (what.mode == Mode::thickness) {
          difference.max /= diagonal;
          difference.rms /= diagonal;
        }
        fmt::print("{:<10} {:<12} {:<11} {:<9} {:>10.2e} {:>10.2e}\n", name, view.name,
                   to_string(what.mode), to_string(what.integrator), difference.max,
                   difference.rms);
        EXPECT_LE(difference.max, what.max_bound)
            << name << ", " << view.name << ", " << to_string(what.mode) << ", "
            << to_string(what.integrator) << " at (" << difference.worst_x << ", "
            << difference.worst_y << ")";
      }
      compare_isosurfaces(name, view, mesh, tf, field);
    }
  }

  /// Surfaces have edges: a pixel whose ray grazes one may see it in one picture only. The share of
  /// pixels that differ by more than rounding is bounded instead of the largest difference.
  static void compare_isosurfaces(const std::string& name, const View& view,
                                  const mesh::TetMesh& mesh, const preint::TransferFunction& tf,
                                  const std::string& field) {
    for (const Shading shading : {Shading::none, Shading::flat, Shading::smooth}) {
      for (const double opacity : {1.0, 0.5}) {
        Scene scene = tests::make_scene(mesh, Mode::iso, tf, kSize, field);
        scene.camera = view.camera;
        scene.shading = shading;
        for (const double t : {0.3, 0.6}) {
          const double value = scene.field.min + t * (scene.field.max - scene.field.min);
          scene.isosurfaces.push_back({value, tf.at(value).color, opacity});
        }
        const Image reference = draw(scene, {Mode::iso, Integrator::exact, shading, 0}, true);
        const Image image = draw(scene, {Mode::iso, Integrator::exact, shading, 0}, false);
        std::size_t different = 0;
        for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
          double d = 0;
          for (std::size_t c = 0; c < 4; ++c)
            d = std::max<double>(d, std::abs(image.rgba[i + c] - reference.rgba[i + c]));
          if (d > 0.01) ++different;
        }
        const Difference difference = compare(image, reference);
        fmt::print(
            "{:<10} {:<12} iso {:<6} a={:<6} {:>10.2e} {:>10.2e}   {} pixels off by more than "
            "0.01\n",
            name, view.name, to_string(shading), opacity, difference.max, difference.rms,
            different);
        EXPECT_LE(different, difference.pixels / 200)
            << name << ", " << view.name << ", " << to_string(shading) << ", " << opacity;
      }
    }
  }
};

TEST_F(Agreement, Sphere) {
  compare_all("sphere", mesh::make_sample("sphere"), "");
}

TEST_F(Agreement, BluntFin) {
  SKIP_WITHOUT_DATA();
  const mesh::Import fin =
      mesh::import_mesh((tests::data_folder() / "classics" / "bluntfinxyz.bin").string());
  compare_all("blunt fin", fin.mesh, "");
}

TEST_F(Agreement, RoomFire) {
  SKIP_WITHOUT_DATA();
  const mesh::Import fire =
      mesh::import_mesh((tests::data_folder() / "mixed" / "fire_ug.vtu").string());
  compare_all("fire_ug", fire.mesh, "t");
}

}  // namespace
}  // namespace tetraglass::project
