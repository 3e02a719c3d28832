#pragma once

#include <utility>

#include "mesh/tet_mesh.h"
#include "project/scene.h"

namespace tetraglass::tests {

/// A scene of the mesh's field, seen from the direction (1, 0.8, 0.6), in `size` x `size` pixels.
inline project::Scene make_scene(const mesh::TetMesh& mesh, project::Mode mode,
                                 preint::TransferFunction tf, int size = 64,
                                 const std::string& field = "") {
  project::Scene scene;
  scene.mesh = &mesh;
  scene.field = mesh::select_scalar(mesh, field);
  scene.drawable = mesh::find_drawable(mesh, scene.field);
  scene.transfer_function = std::move(tf);
  scene.mode = mode;
  scene.camera = project::frame_camera(mesh::bounds(mesh), Eigen::Vector3d(1, 0.8, 0.6),
                                       Eigen::Vector3d::UnitZ(), 30, 1);
  scene.width = scene.height = size;
  return scene;
}

/// Looks along -z from z = 10, parallel, `height` world units high: x is right, y is up.
inline project::Camera down_z(double height, const Eigen::Vector2d& at = Eigen::Vector2d::Zero()) {
  project::Camera camera;
  camera.eye = {at.x(), at.y(), 10};
  camera.target = {at.x(), at.y(), 0};
  camera.parallel = true;
  camera.ortho_height = height;
  return camera;
}

/// A medium that is the same for every value.
inline preint::TransferFunction constant_medium(const preint::Color& color, double extinction) {
  return preint::TransferFunction({{0.0, color, extinction}});
}

}  // namespace tetraglass::tests
