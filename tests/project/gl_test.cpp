#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "preint/segment_integral.h"
#include "project/gl/cell_projector.h"
#include "project/gl/gl_projector.h"
#include "project/gl/program.h"
#include "project/light/phong.h"
#include "tests/support/chord.h"
#include "tests/support/covered_once.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace tetraglass::project {
namespace {

using preint::Color;
using tests::box;
using tests::chord;
using tests::constant_medium;
using tests::down_z;
using tests::make_scene;

const Eigen::AlignedBox3d kBox(Eigen::Vector3d(-1, -0.5, -2), Eigen::Vector3d(1, 0.75, 2));

// Floats hold a length in units of the mesh's half diagonal (2.2 here) to 2^-24; a ray adds up
// some 20.
constexpr double kLength = 1e-5;

mesh::TetMesh box_mesh(const tests::FieldFunction& f, int n = 3) {
  return box(kBox.min(), kBox.max(), n, n, n, f);
}

double zero(const Eigen::Vector3d&) {
  return 0;
}

Plan gl_plan(const Scene& scene, Request request = {}) {
  request.projector = Projector::gl;
  return plan(scene, request);
}

Image draw(const Scene& scene, const Request& request = {}, Stats* stats = nullptr) {
  Stats own;
  return render_gl(scene, gl_plan(scene, request), stats != nullptr ? *stats : own);
}

Image draw_table(const Scene& scene, Integrator integrator, int n, int m = 0) {
  Request request;
  request.integrator = integrator;
  request.table_n = n;
  request.table_m = m;
  return draw(scene, request);
}

struct View {
  const char* name;
  Camera camera;
};

std::vector<View> views() {
  const Camera outside = frame_camera(kBox, {1, 0.8, 0.6}, Eigen::Vector3d::UnitZ(), 30, 1);
  Camera inside = outside;
  inside.eye = {0.1, 0.2, 0.3};
  inside.fov_degrees = 120;
  Camera on_vertex = inside;
  on_vertex.eye = {-1.0 / 3, -0.5 + 1.25 / 3, -2.0 / 3};
  Camera parallel = outside;
  parallel.parallel = true;
  Camera far = outside;
  far.eye *= 1000;
  far.fov_degrees /= 1000;
  Camera along_axis = down_z(5);
  return {{"outside", outside},   {"eye inside", inside}, {"eye on a vertex", on_vertex},
          {"parallel", parallel}, {"far away", far},      {"along an axis", along_axis}};
}

TEST(Gl, ThicknessIsTheChord) {
  const mesh::TetMesh mesh = box_mesh(zero);
  Scene scene = make_scene(mesh, Mode::thickness, constant_medium({1, 1, 1}, 1), 96);
  for (const View& view : views()) {
    scene.camera = view.camera;
    const Frame frame(view.camera, scene.width, scene.height);
    const Image image = draw(scene);
    for (int y = 0; y < scene.height; ++y) {
      for (int x = 0; x < scene.width; ++x) {
        const double expected = chord(kBox, frame, x, y);
        ASSERT_NEAR(image.pixel(x, y)[0], expected, kLength) << view.name << ' ' << x << ' ' << y;
        ASSERT_EQ(image.pixel(x, y)[2], image.pixel(x, y)[0]);
        ASSERT_EQ(image.pixel(x, y)[3], image.pixel(x, y)[0] > 0 ? 1 : 0);
      }
    }
  }
}

TEST(Gl, RaysThroughEdgesMeetEachCellOnce) {
  tests::expect_edges_covered_once([](const Scene& scene) { return draw(scene); });
}

// The central ray runs along the diagonals of the bricks, where six cells meet, from outside and
// from inside.
TEST(Gl, RaysAlongEdgesMeetTheMeshOnce) {
  const mesh::TetMesh mesh = box({-1, -1, -1}, {1, 1, 1}, 6, 6, 6, zero);
  const Eigen::AlignedBox3d cube(Eigen::Vector3d::Constant(-1), Eigen::Vector3d::Constant(1));
  Scene scene = make_scene(mesh, Mode::thickness, constant_medium({1, 1, 1}, 1), 33);
  for (const Eigen::Vector3d& direction :
       {Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(1, 1, 0), Eigen::Vector3d(0, 0, 1)}) {
    for (const bool parallel : {false, true}) {
      for (const double distance : {4.0, 0.0, 0.5}) {
        scene.camera = frame_camera(cube, direction, {0.1, 0.9, -0.2}, 40, 1);
        scene.camera.eye = direction.normalized() * distance;
        scene.camera.target = scene.camera.eye - direction;
        scene.camera.parallel = parallel;
        const Frame frame(scene.camera, scene.width, scene.height);
        const Image image = draw(scene);
        for (int y = 0; y < scene.height; ++y) {
          for (int x = 0; x < scene.width; ++x) {
            ASSERT_NEAR(image.pixel(x, y)[0], chord(cube, frame, x, y), kLength)
                << direction.transpose() << " parallel " << parallel << " distance " << distance
                << " pixel " << x << ' ' << y;
          }
        }
      }
    }
  }
}

TEST(Gl, SingleTetrahedronInAllOrientations) {
  mesh::TetMesh mesh = tests::unit_tetrahedron();
  mesh.points = {{0, 0, 0}, {1, 0.1, 0.2}, {0.2, 1, -0.1}, {-0.1, 0.3, 1}};
  std::array<std::uint32_t, 4> order = {0, 1, 2, 3};
  Image first;
  do {
    mesh.cells = {order};
    Scene scene = make_scene(mesh, Mode::thickness, constant_medium({1, 1, 1}, 1), 48);
    scene.drawable.cells = {0};
    Stats stats;
    const Image image = draw(scene, {}, &stats);
    if (first.rgba.empty()) {
      first = image;
      EXPECT_GT(stats.fragments, 200U);
    }
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
      ASSERT_EQ(image.rgba[i], first.rgba[i]) << order[0] << order[1] << order[2] << order[3];
    }
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(Gl, VolumeOfOneTetrahedronIsTheSumOfItsChords) {
  // Parallel rays at equal distances integrate the volume.
  const mesh::TetMesh mesh = tests::unit_tetrahedron();
  Scene scene = make_scene(mesh, Mode::thickness, constant_medium({1, 1, 1}, 1), 512);
  for (const Eigen::Vector3d& direction :
       {Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(-1, 2, 0.3), Eigen::Vector3d(0.2, -1, -2)}) {
    scene.camera = frame_camera(mesh::bounds(mesh), direction, Eigen::Vector3d::UnitZ(), 30, 1);
    scene.camera.parallel = true;
    scene.camera.ortho_height = 2;
    const Image image = draw(scene);
    double sum = 0;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) sum += image.rgba[i];
    EXPECT_NEAR(sum * (2.0 / 512) * (2.0 / 512), 1.0 / 6, 1e-4) << direction.transpose();
  }
}

TEST(Gl, ConstantMediumFollowsTheExponential) {
  const mesh::TetMesh mesh = box_mesh([](const auto&) { return 0.5; });
  for (const double kappa : {0.01, 0.7, 40.0, 1e6}) {
    Scene scene = make_scene(mesh, Mode::full, constant_medium({0.2, 0.5, 1}, kappa), 48);
    for (const View& view : views()) {
      scene.camera = view.camera;
      const Frame frame(view.camera, scene.width, scene.height);
      scene.mode = Mode::full;
      const Image full = draw(scene);
      scene.mode = Mode::absorption;
      const Image absorption = draw(scene);
      scene.mode = Mode::emission;
      const Image emission = draw(scene);
      for (int y = 0; y < scene.height; ++y) {
        for (int x = 0; x < scene.width; ++x) {
          const double depth = kappa * chord(kBox, frame, x, y);
          const double alpha = 1 - std::exp(-depth);
          const double tolerance = 1e-6 + kLength * kappa * std::exp(-depth);
          ASSERT_NEAR(full.pixel(x, y)[3], alpha, tolerance) << view.name << " kappa " << kappa;
          ASSERT_NEAR(full.pixel(x, y)[1], 0.5 * alpha, tolerance);
          ASSERT_NEAR(absorption.pixel(x, y)[3], alpha, tolerance);
          ASSERT_EQ(absorption.pixel(x, y)[0], 0);
          ASSERT_NEAR(emission.pixel(x, y)[1], 0.5 * depth, kLength * kappa);
          ASSERT_EQ(emission.pixel(x, y)[3], 0);
        }
      }
    }
  }
}

// The integral of a linear field along z, which many control points and a jump cut into pieces.
TEST(Gl, PiecewiseMediumFollowsItsClosedForm) {
  const preint::TransferFunction tf({{-2, {1, 0, 0.5}, 0.1},
                                     {-1.2, {0, 1, 0.5}, 3},
                                     {-1.2, {0, 0, 1}, 0},
                                     {0.3, {0.2, 0.4, 0.6}, 0.5},
                                     {0.31, {1, 1, 1}, 60},
                                     {0.32, {0, 0, 1}, 0.2},
                                     {2, {0.7, 0.1, 0}, 0.9}});
  for (const double sign : {-1.0, 1.0}) {
    const mesh::TetMesh mesh = box_mesh([&](const auto& p) { return sign * p.z(); });
    Scene scene = make_scene(mesh, Mode::full, tf, 16);
    scene.camera = down_z(1);
    const preint::Segment whole{sign * 2, -sign * 2, 4};
    const preint::Radiance full = integrate_full(tf, whole);
    const Color emission = integrate_emission(tf, whole);
    const Image drawn = draw(scene);
    scene.mode = Mode::absorption;
    const Image absorbed = draw(scene);
    scene.mode = Mode::emission;
    const Image emitted = draw(scene);
    for (int i = 0; i < 16; ++i) {
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(drawn.pixel(i, 5)[c], full.color[c], 1e-5) << "channel " << c;
        EXPECT_NEAR(emitted.pixel(i, 5)[c], emission[c], 1e-5) << "channel " << c;
      }
      EXPECT_NEAR(drawn.pixel(i, 5)[3], 1 - full.transmittance, 1e-5);
      EXPECT_NEAR(absorbed.pixel(i, 5)[3], 1 - full.transmittance, 1e-5);
    }
  }
}

TEST(Gl, TablesComeNearTheExactIntegral) {
  const mesh::TetMesh mesh = box_mesh([](const auto& p) { return p.norm(); }, 5);
  const preint::TransferFunction tf({{0, {1, 0, 0}, 0}, {1, {0, 1, 0}, 0.5}, {2.5, {0, 0, 1}, 2}});
  Scene scene = make_scene(mesh, Mode::full, tf, 40);
  const auto largest_difference = [](const Image& a, const Image& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) {
      largest = std::max<double>(largest, std::abs(a.rgba[i] - b.rgba[i]));
    }
    return largest;
  };
  EXPECT_LT(largest_difference(draw(scene), draw_table(scene, Integrator::table3d, 64, 64)), 5e-3);
  for (const Mode mode : {Mode::emission, Mode::absorption}) {
    scene.mode = mode;
    EXPECT_LT(largest_difference(draw(scene), draw_table(scene, Integrator::table2d, 256)), 2e-3)
        << to_string(mode);
  }
  scene.mode = Mode::mip;
  scene.mip_of = MipOf::transfer;
  EXPECT_LT(largest_difference(draw(scene), draw_table(scene, Integrator::table2d, 256)), 1e-2);
  scene.mode = Mode::iso;
  // Where the two surfaces lie, the table knows to one of its 1024 steps.
  scene.isosurfaces = {{0.7, {1, 0, 0}, 0.5}, {1.4, {0, 1, 0}, 0.5}};
  scene.shading = Shading::flat;
  const Image exact = draw(scene);
  const Image table = draw_table(scene, Integrator::table2d, 1024);
  int different = 0;
  for (std::size_t i = 0; i < exact.rgba.size(); ++i) {
    if (std::abs(exact.rgba[i] - table.rgba[i]) > 0.05) ++different;
  }
  EXPECT_LT(different, 60);
}

// Partial pre-integration knows nothing of the transfer function, so its error does not depend on
// peaks and falls with the square of the table's size; from the ends of a segment alone a peak is
// missed.
TEST(Gl, PsiIsAccurateWhereTheEndsOfASegmentAreNotEnough) {
  const mesh::TetMesh mesh = box_mesh([](const auto& p) { return p.norm(); }, 5);
  const preint::TransferFunction peaks({{0, {1, 0, 0}, 0.1},
                                        {1.0, {1, 0, 0}, 0.1},
                                        {1.02, {1, 1, 1}, 8},
                                        {1.04, {0, 0, 1}, 0.1},
                                        {2.5, {0, 0, 1}, 1}});
  Scene scene = make_scene(mesh, Mode::full, peaks, 40);
  const Image exact = draw(scene);
  const auto error = [&](const Image& image) {
    double squares = 0;
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
      const double e = double{image.rgba[i]} - exact.rgba[i];
      squares += e * e;
    }
    return std::sqrt(squares / static_cast<double>(image.rgba.size()));
  };
  const double coarse = error(draw_table(scene, Integrator::psi, 65));
  const double fine = error(draw_table(scene, Integrator::psi, 257));
  EXPECT_LT(fine, 1e-4);
  EXPECT_GT(coarse, 8 * fine) << "expected 16 times";
  Request ends;
  ends.integrator = Integrator::linear;
  EXPECT_GT(error(draw(scene, ends)), 100 * fine);
}

// On one linear piece the two agree to the order of the segments' length.
TEST(Gl, LinearIntegratorIsRightForThinSegments) {
  const preint::TransferFunction tf({{-2, {1, 0, 0.2}, 0.1}, {3, {0, 1, 0.4}, 0.6}});
  double last = 0;
  for (const int n : {4, 8, 16}) {
    const mesh::TetMesh mesh = box_mesh([](const auto& p) { return p.z(); }, n);
    Request ends;
    ends.integrator = Integrator::linear;
    double largest = 0;
    for (const Mode mode : {Mode::full, Mode::emission}) {
      const Scene scene = make_scene(mesh, mode, tf, 32);
      const Image exact = draw(scene);
      const Image image = draw(scene, ends);
      for (std::size_t i = 0; i < image.rgba.size(); ++i) {
        largest = std::max(largest, std::abs(double{image.rgba[i]} - exact.rgba[i]));
      }
    }
    if (last > 0) {
      EXPECT_LT(largest, last / 3) << "second order: a quarter for half the length";
    }
    last = largest;
  }
  EXPECT_LT(last, 1e-3);
}

TEST(Gl, MaximumIsThatOfTheRay) {
  const preint::TransferFunction tf(
      {{-2, {0, 1, 0}, 1}, {0, {0, 0.25, 0}, 1}, {2, {1, 0.5, 0}, 1}});
  // The largest value is at the near or at the far end of the ray.
  for (const double sign : {-1.0, 1.0}) {
    const mesh::TetMesh mesh = box_mesh([&](const auto& p) { return sign * p.z() + 0.01 * p.x(); });
    Scene scene = make_scene(mesh, Mode::mip, tf, 40);
    scene.camera = down_z(4.1);
    const Frame frame(scene.camera, 40, 40);
    Image image = draw(scene);
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 40; ++x) {
        const bool met = chord(kBox, frame, x, y) > 0;
        ASSERT_EQ(image.pixel(x, y)[3], met ? 1 : 0);
        const Color expected = tf.at(2 + 0.01 * frame.image_plane(x, y).x()).color;
        for (int c = 0; c < 3; ++c) {
          ASSERT_NEAR(image.pixel(x, y)[c], met ? expected[c] : 0, 1e-6) << x << ' ' << y;
        }
      }
    }
    scene.mip_of = MipOf::transfer;
    image = draw(scene);
    EXPECT_NEAR(image.pixel(20, 20)[0], 1, 1e-3);
    EXPECT_NEAR(image.pixel(20, 20)[1], 1, 3e-3);
    EXPECT_EQ(image.pixel(20, 20)[3], 1);
    EXPECT_EQ(image.pixel(20, 0)[3], 0);
  }
}

// s = z in bricks whose vertices lie at the isovalue too: the surface runs along faces there.
TEST(Gl, PlanesHaveNoHolesAndTheRightOrder) {
  const mesh::TetMesh mesh = box_mesh([](const auto& p) { return p.z(); }, 4);
  Scene scene = make_scene(mesh, Mode::iso, constant_medium({1, 1, 1}, 1), 64);
  scene.camera = down_z(1);
  scene.isosurfaces = {{-1.5, {1, 0, 0}, 0.5}, {0, {0, 1, 0}, 0.5}};
  const Image translucent = draw(scene);
  for (preint::Isosurface& surface : scene.isosurfaces) surface.opacity = 1;
  const Image opaque = draw(scene);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      ASSERT_NEAR(translucent.pixel(x, y)[1], 0.5, 1e-6);
      ASSERT_NEAR(translucent.pixel(x, y)[0], 0.25, 1e-6);
      ASSERT_NEAR(translucent.pixel(x, y)[3], 0.75, 1e-6);
      ASSERT_EQ(opaque.pixel(x, y)[1], 1);
      ASSERT_EQ(opaque.pixel(x, y)[0], 0);
      ASSERT_EQ(opaque.pixel(x, y)[3], 1);
    }
  }
}

// Every ray through the box meets the plane s = 0 where its ends lie on different sides.
TEST(Gl, ObliquePlaneIsMetWhereTheEndsOfTheRayDiffer) {
  const Eigen::Vector3d normal(0.3, -0.2, 0.5);
  const mesh::TetMesh mesh = box_mesh([&](const auto& p) { return normal.dot(p) - 0.05; }, 7);
  for (const View& view : views()) {
    Scene scene = make_scene(mesh, Mode::iso, constant_medium({1, 1, 1}, 1), 128);
    scene.camera = view.camera;
    scene.isosurfaces = {{0, {0.2, 0.5, 0.8}, 1}};
    const Frame frame(scene.camera, 128, 128);
    for (const Shading shading : {Shading::none, Shading::flat, Shading::smooth}) {
      scene.shading = shading;
      const Image image = draw(scene);
      int unsure = 0;
      for (int y = 0; y < 128; ++y) {
        for (int x = 0; x < 128; ++x) {
          const Eigen::Vector2d plane = frame.image_plane(x, y);
          const Eigen::Vector3d origin =
              frame.eye() + frame.axes().transpose() * frame.ray_origin(plane);
          const Eigen::Vector3d ray =
              (frame.axes().transpose() * frame.ray_direction(plane)).normalized();
          const double t = (0.05 - normal.dot(origin)) / normal.dot(ray);
          const Eigen::Vector3d hit = origin + t * ray;
          const bool in_front = frame.parallel() || t > 0;
          if (std::abs((kBox.max() - hit).cwiseMin(hit - kBox.min()).minCoeff()) < 1e-4) {
            ++unsure;  // on the rim
            continue;
          }
          const bool met = in_front && kBox.contains(hit);
          ASSERT_EQ(image.pixel(x, y)[3], met ? 1 : 0) << view.name << ' ' << x << ' ' << y;
          if (!met) continue;
          const Color expected = shading == Shading::none
                                     ? scene.isosurfaces[0].color
                                     : shade({}, scene.isosurfaces[0].color, {}, hit, normal, -ray);
          for (int c = 0; c < 3; ++c) {
            ASSERT_NEAR(image.pixel(x, y)[c], expected[c], 1e-4)
                << view.name << ' ' << to_string(shading) << ' ' << x << ' ' << y;
          }
        }
      }
      EXPECT_LT(unsure, 64) << view.name;
    }
  }
}

// Values equal to the isovalue over whole cells: the surface lies where the field leaves it,
// downwards.
TEST(Gl, PlateauHasOneSurface) {
  const auto field = [](const Eigen::Vector3d& p) {
    return std::abs(p.z()) <= 1 ? 5 : 5 - std::abs(p.z()) / 3;
  };
  const mesh::TetMesh mesh = box_mesh(field, 4);
  Scene scene = make_scene(mesh, Mode::iso, constant_medium({1, 1, 1}, 1), 64);
  scene.isosurfaces = {{5, {1, 1, 1}, 0.5}};
  scene.camera = down_z(1);
  const Image image = draw(scene);
  for (int i = 0; i < 64 * 64; ++i)
    ASSERT_NEAR(image.rgba[4 * static_cast<std::size_t>(i) + 3], 0.75, 1e-6);
}

TEST(Gl, SlabsAreComposedInOrderFromBothSides) {
  mesh::TetMesh mesh = box({0, 0, 0}, {1, 1, 2}, 1, 1, 2, zero);
  mesh::Field slab{"slab", mesh::Location::cell, 1, {}};
  for (const mesh::Cell& cell : mesh.cells) {
    double z = 0;
    for (const std::uint32_t i : cell) z += mesh.points[i].z() / 4;
    slab.values.push_back(z < 1 ? 0 : 1);
  }
  mesh.fields = {slab};
  const double low = 0.8;
  const double high = 2.5;
  const preint::TransferFunction tf({{0, {1, 0, 0}, low}, {1, {0, 1, 0}, high}});
  Scene scene = make_scene(mesh, Mode::full, tf, 8);
  scene.camera = down_z(0.5, {0.5, 0.5});
  Stats stats;
  const Image from_above = draw(scene, {}, &stats);
  EXPECT_EQ(stats.sort_method, "mpvo");
  EXPECT_TRUE(stats.sort_exact);
  scene.camera.eye.z() = -5;
  const Image from_below = draw(scene);
  const double a = 1 - std::exp(-low);
  const double b = 1 - std::exp(-high);
  EXPECT_NEAR(from_above.pixel(3, 4)[1], b, 1e-6);
  EXPECT_NEAR(from_above.pixel(3, 4)[0], (1 - b) * a, 1e-6);
  EXPECT_NEAR(from_below.pixel(3, 4)[0], a, 1e-6);
  EXPECT_NEAR(from_below.pixel(3, 4)[1], (1 - a) * b, 1e-6);

  scene.mode = Mode::mip;
  const Image largest = draw(scene);
  EXPECT_NEAR(largest.pixel(3, 4)[1], 1, 1e-6);
  EXPECT_NEAR(largest.pixel(3, 4)[0], 0, 1e-6);
}

TEST(Gl, NothingDrawableGivesAnEmptyPicture) {
  const mesh::TetMesh mesh = box_mesh(zero);
  for (const Mode mode : {Mode::full, Mode::mip, Mode::thickness, Mode::iso}) {
    Scene scene = make_scene(mesh, mode, constant_medium({1, 1, 1}, 1), 8);
    scene.isosurfaces = {{1, {1, 1, 1}, 1}};
    scene.drawable.cells.clear();
    EXPECT_EQ(draw(scene).rgba, Image(8, 8).rgba) << to_string(mode);
  }
  // Neither a surface nowhere, nor a medium that is clear, nor a mesh behind the eye.
  Scene scene = make_scene(mesh, Mode::iso, constant_medium({1, 1, 1}, 1), 8);
  scene.isosurfaces = {{1, {1, 1, 1}, 1}};
  EXPECT_EQ(draw(scene).rgba, Image(8, 8).rgba);
  scene = make_scene(mesh, Mode::full, constant_medium({1, 1, 1}, 0), 8);
  EXPECT_EQ(draw(scene).rgba, Image(8, 8).rgba);
  scene = make_scene(mesh, Mode::mip, constant_medium({1, 1, 1}, 1), 8);
  scene.camera.target = 2 * scene.camera.eye;
  EXPECT_EQ(draw(scene).rgba, Image(8, 8).rgba);
}

TEST(Gl, OnlyDrawableCellsAreDrawn) {
  mesh::TetMesh mesh = box({0, 0, 0}, {1, 1, 2}, 1, 1, 2, zero);
  Scene scene = make_scene(mesh, Mode::thickness, constant_medium({1, 1, 1}, 1), 8);
  scene.camera = down_z(0.5, {0.5, 0.5});
  scene.drawable.cells.resize(6);  // the lower brick
  Stats stats;
  EXPECT_NEAR(draw(scene, {}, &stats).pixel(2, 3)[0], 1, 1e-6);
  EXPECT_GE(stats.fragments, 2 * 64U);
  EXPECT_EQ(stats.sort_method, "none");
  EXPECT_EQ(stats.context.substr(0, 8), "osmesa: ");
}

// Cells that floats cannot tell from flat or that are needles: numbers stay finite and lengths
// right.
TEST(Gl, SliversStayWithinTheirRange) {
  mesh::TetMesh mesh = box_mesh([](const auto& p) { return p.x(); }, 2);
  // A vertex moved to a millionth of its cells' faces.
  for (Eigen::Vector3d& p : mesh.points) {
    if ((p - Eigen::Vector3d(0, 0.125, 0)).norm() < 1e-9) p = {0.999999, 0.749999, 1.999998};
  }
  mesh.fields.clear();
  tests::add_point_field(mesh, "s", [](const auto& p) { return p.x(); });
  Scene scene = make_scene(mesh, Mode::thickness, constant_medium({1, 1, 1}, 1), 128);
  for (const View& view : views()) {
    scene.camera = view.camera;
    const Frame frame(view.camera, scene.width, scene.height);
    scene.mode = Mode::thickness;
    const Image image = draw(scene);
    scene.mode = Mode::mip;
    scene.transfer_function = preint::TransferFunction({{-2, {0, 0, 0}, 1}, {2, {1, 1, 1}, 1}});
    const Image largest = draw(scene);
    for (int y = 0; y < 128; ++y) {
      for (int x = 0; x < 128; ++x) {
        ASSERT_NEAR(image.pixel(x, y)[0], chord(kBox, frame, x, y), 1e-4)
            << view.name << ' ' << x << ' ' << y;
        ASSERT_LE(largest.pixel(x, y)[0], 0.75 + 1e-6);
      }
    }
  }
}

// Large numbers anywhere: coordinates, values, extinction.
TEST(Gl, NumbersStayFinite) {
  const auto field = [](const Eigen::Vector3d& p) { return p.x() * 1e300; };
  mesh::TetMesh mesh = box_mesh(field);
  for (Eigen::Vector3d& p : mesh.points) p *= 1e140;
  const preint::TransferFunction tf({{-1e307, {1e300, 0, 0}, 1e300}, {1e307, {0, 1, 0}, 0}});
  for (const Mode mode :
       {Mode::full, Mode::emission, Mode::absorption, Mode::mip, Mode::thickness}) {
    const Image image = draw(make_scene(mesh, mode, tf, 32));
    for (const float value : image.rgba) ASSERT_TRUE(std::isfinite(value)) << to_string(mode);
  }
}

TEST(Gl, TilesFitTogether) {
  const mesh::TetMesh mesh = box_mesh([](const auto& p) { return p.norm(); }, 5);
  const preint::TransferFunction tf({{0, {1, 0, 0}, 0.1}, {2, {0, 0, 1}, 2}});
  for (const Mode mode : {Mode::thickness, Mode::full, Mode::mip}) {
    for (const View& view : views()) {
      Scene scene = make_scene(mesh, mode, tf, 100);
      scene.camera = view.camera;
      scene.height = 70;
      const Plan how = gl_plan(scene);
      const auto context = gl::Context::create(ContextKind::osmesa);
      const Frame frame(scene.camera, scene.width, scene.height);
      Stats whole_stats;
      Stats tiled_stats;
      const Image whole =
          gl::CellProjector(*context, scene, how, whole_stats).draw(frame, whole_stats);
      const Image tiled =
          gl::CellProjector(*context, scene, how, tiled_stats, 33).draw(frame, tiled_stats);
      EXPECT_EQ(whole.rgba, tiled.rgba) << to_string(mode) << ' ' << view.name;
      EXPECT_EQ(whole_stats.fragments, tiled_stats.fragments);
    }
  }
}

TEST(Gl, ProjectorDrawsManyViews) {
  const mesh::TetMesh mesh = box_mesh([](const auto& p) { return p.norm(); }, 4);
  const preint::TransferFunction tf({{0, {1, 0, 0}, 0.1}, {2, {0, 0, 1}, 2}});
  const Scene scene = make_scene(mesh, Mode::full, tf, 64);
  const Plan how = gl_plan(scene);
  const auto context = gl::Context::create(ContextKind::osmesa);
  Stats stats;
  gl::CellProjector projector(*context, scene, how, stats);
  for (const View& view : views()) {
    Scene alone = scene;
    alone.camera = view.camera;
    const Image image = projector.draw(Frame(view.camera, 64, 64), stats);
    EXPECT_EQ(image.rgba, draw(alone).rgba) << view.name;
  }
}

TEST(Gl, TwoContextsAtOnce) {
  const mesh::TetMesh mesh = box_mesh(zero);
  const Scene scene = make_scene(mesh, Mode::thickness, constant_medium({1, 1, 1}, 1), 32);
  const Plan how = gl_plan(scene);
  const Frame frame(scene.camera, 32, 32);
  Stats stats;
  const auto first = gl::Context::create(ContextKind::osmesa);
  auto second = gl::Context::create(ContextKind::osmesa);
  gl::CellProjector a(*first, scene, how, stats);
  const Image expected = a.draw(frame, stats);
  {
    gl::CellProjector b(*second, scene, how, stats);
    EXPECT_EQ(b.draw(frame, stats).rgba, expected.rgba);
    EXPECT_EQ(a.draw(frame, stats).rgba, expected.rgba);
    EXPECT_EQ(b.draw(frame, stats).rgba, expected.rgba);
  }
  second.reset();
  EXPECT_EQ(a.draw(frame, stats).rgba, expected.rgba);
}

TEST(GlProgram, CompileErrorsCarryTheLog) {
  const auto context = gl::Context::create(ContextKind::osmesa);
  try {
    const gl::Program program(*context, "#version 450 core\nvoid main() { nonsense; }\n",
                              "#version 450 core\nvoid main() {}\n");
    FAIL() << "compiled";
  } catch (const base::Error& error) {
    EXPECT_NE(std::string(error.what()).find("nonsense"), std::string::npos) << error.what();
  }
}

TEST(GlProgram, SourcesAreEmbedded) {
  EXPECT_NE(gl::shader_source("cell.vert.glsl", {"PARALLEL"}).find("face_planes"),
            std::string::npos);
  EXPECT_THROW((void)gl::shader_source("absent.glsl", {}), base::Error);
}

}  // namespace
}  // namespace tetraglass::project
