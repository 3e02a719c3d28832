#pragma once

#include <span>
#include <string>

#include "mesh/tet_mesh.h"
#include "project/camera.h"

namespace CLI {
class App;
}

namespace tetraglass::apps {

/// The camera's options as typed; empty where not given.
struct CameraArguments {
  std::string eye;
  std::string target;
  std::string up;
  std::string fov;
  std::string ortho;
  std::string view;
  std::string file;  ///< of --camera
};

void add_camera_options(CLI::App* app, CameraArguments& arguments);

/// The camera that the arguments ask for; without an eye it sees all of the mesh in a picture of
/// the given aspect (width / height). Throws UsageError.
[[nodiscard]] project::Camera make_camera(const CameraArguments& arguments,
                                          const mesh::TetMesh& mesh, double aspect);

/// The same, framed around these points instead of the mesh's; `middle`: what an eye without target
/// looks at.
[[nodiscard]] project::Camera make_camera(const CameraArguments& arguments,
                                          std::span<const Eigen::Vector3d> points,
                                          const Eigen::Vector3d& middle, double aspect);

/// Whether the camera is placed so that all is seen: no eye is given.
[[nodiscard]] bool is_framed(const CameraArguments& arguments);

}  // namespace tetraglass::apps
