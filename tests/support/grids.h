#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "project/reference/grid_reference.h"
#include "project/slices/slices_projector.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

/// Grids and views of them, for the tests of the slices.
namespace tetraglass::tests {

using project::Camera;
using project::Image;
using project::Scene;

inline const Eigen::AlignedBox3d kGridBox(Eigen::Vector3d(-1, -0.5, -2),
                                          Eigen::Vector3d(1, 0.75, 2));

// Floats hold a place in the grid to 2^-24 of its size; a ray adds up some 100 slabs.
inline constexpr double kSliceRounding = 2e-5;

inline double bent(const Eigen::Vector3d& p) {
  return std::sin(2 * p.x() + 0.3) * std::cos(3 * p.y()) + 0.5 * p.z() - 0.2 * p.z() * p.z();
}

inline mesh::TetMesh grid_mesh(const FieldFunction& f, bool even = true) {
  mesh::TetMesh mesh =
      box(kGridBox.min(), kGridBox.max(), 7, 5, 11, [](const auto&) { return 0.0; });
  for (Eigen::Vector3d& p : mesh.points) {
    // Keeps the ends at -2 and 2.
    if (!even) p.z() = p.z() * (0.5 + p.z() * p.z() / 8);
  }
  mesh.fields.clear();
  add_point_field(mesh, "s", f);
  return mesh;
}

inline Scene grid_scene(const mesh::TetMesh& mesh, project::Mode mode,
                        const preint::TransferFunction& tf, int size = 32) {
  Scene scene = make_scene(mesh, mode, tf, size);
  scene.grid = mesh::rectilinear_grid(mesh);
  return scene;
}

inline Image draw_slices(const Scene& scene, const project::SlicesRequest& slices = {},
                         project::Stats* stats = nullptr,
                         project::Integrator integrator = project::Integrator::exact) {
  project::Request request;
  request.projector = project::Projector::slices;
  request.slices = slices;
  if (integrator != project::Integrator::exact) request.integrator = integrator;
  project::Stats own;
  return render_slices(scene, project::plan(scene, request), stats != nullptr ? *stats : own);
}

inline Image expected_grid(const Scene& scene) {
  project::Stats stats;
  return render_grid_reference(scene, stats);
}

struct Error {
  double largest = 0;
  double rms = 0;
};

inline Error difference(const Image& a, const Image& b) {
  Error error;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) {
    const double d = std::abs(static_cast<double>(a.rgba[i]) - b.rgba[i]);
    error.largest = std::max(error.largest, d);
    error.rms += d * d / static_cast<double>(a.rgba.size());
  }
  error.rms = std::sqrt(error.rms);
  return error;
}

struct View {
  const char* name;
  Camera camera;
};

inline std::vector<View> grid_views() {
  const Camera outside =
      project::frame_camera(kGridBox, {1, 0.8, 0.6}, Eigen::Vector3d::UnitZ(), 30, 1);
  Camera inside = outside;
  inside.eye = {0.1, 0.2, 0.3};
  inside.fov_degrees = 120;
  Camera parallel = outside;
  parallel.parallel = true;
  Camera far = outside;
  far.eye *= 1000;
  far.fov_degrees /= 1000;
  Camera close = outside;  // beside a face, which the eye's plane cuts
  close.eye = {1.05, 0, 0.5};
  close.target = {0, 0, -1};
  close.fov_degrees = 80;
  return {{"outside", outside}, {"eye inside", inside},       {"parallel", parallel},
          {"far away", far},    {"along an axis", down_z(5)}, {"close", close}};
}

inline const std::vector<project::Stack> kStacks = {project::Stack::planes, project::Stack::shells,
                                                    project::Stack::textures};

inline preint::TransferFunction smooth_medium() {
  return preint::TransferFunction(
      {{-2, {1, 0.2, 0}, 0}, {-0.3, {0, 1, 0.5}, 1}, {0.6, {0.2, 0, 1}, 0.3}, {2, {1, 1, 1}, 3}});
}

}  // namespace tetraglass::tests
