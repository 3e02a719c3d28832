#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh/rectilinear_grid.h"
#include "mesh/tet_mesh.h"
#include "preint/isosurfaces.h"
#include "preint/transfer_function.h"
#include "project/camera.h"
#include "project/clip.h"
#include "project/depth_cue.h"

namespace tetraglass::project {

enum class Mode { full, emission, absorption, mip, iso, thickness };
enum class MipOf { field, transfer };
enum class Shading { none, flat, smooth };

/// What is wanted: which mesh and field, seen how, from where. Says nothing of the way to draw it.
struct Scene {
  const mesh::TetMesh* mesh = nullptr;  ///< outlives the scene
  mesh::ScalarField field;
  /// The mesh as a grid, where it is one and its trilinear field is to be drawn.
  std::optional<mesh::RectilinearGrid> grid;
  mesh::Drawable drawable;  ///< the cells that can be drawn, for this field
  preint::TransferFunction transfer_function{{preint::ControlPoint{}}};
  Mode mode = Mode::full;
  MipOf mip_of = MipOf::field;
  std::vector<preint::Isosurface> isosurfaces;  ///< mode iso
  Shading shading = Shading::none;
  std::vector<ClipPlane> clip;        ///< what all of them keep is drawn
  std::optional<DepthCue> depth_cue;  ///< mode iso
  Camera camera;
  int width = 800;
  int height = 600;
  std::optional<Region> region;  ///< the part of the picture that is drawn; else all of it
  int samples = 1;               ///< each way: samples * samples rays share a pixel evenly
};

/// The rays of the scene's picture: a pixel for each sample.
[[nodiscard]] Frame make_frame(const Scene& scene);

[[nodiscard]] std::string to_string(Mode mode);
[[nodiscard]] std::string to_string(Shading shading);

/// Whether the picture does not depend on the order in which cells are drawn.
[[nodiscard]] bool is_commutative(const Scene& scene);

}  // namespace tetraglass::project
