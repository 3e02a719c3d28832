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
#include "project/light/lights.h"
#include "project/opaque_geometry.h"

namespace tetraglass::project {

enum class Mode { full, emission, absorption, mip, iso, thickness };
enum class MipOf { field, transfer };
/// How light falls on what is drawn. Isosurfaces have flat and smooth. Mode full has all of them: a
/// medium whose color is lit at every point, by the field's gradient there, and ways to do with
/// less.
enum class Shading {
  none,
  flat,          ///< by the gradient of each cell
  smooth,        ///< by gradients at the vertices, linear in between and normalized there
  single,        ///< one normal a segment, the mean of those at its ends
  weighted,      ///< one normal a segment, where most of its light comes from (meissner2002)
  interpolated,  ///< the light at the ends of a segment, linear in between (lum2004)
  surface        ///< one normal a segment, that at the value of largest extinction
};

/// Where the gradients of the field are taken: of cells, those of each, or interpolated between the
/// vertices; of the trilinear field of a grid (any but `sobel`: central) by differences between the
/// places one point up and down.
enum class GradientOf {
  vertex,
  cell,
  central,
  sobel  ///< ... smoothed by (1, 2, 1) / 4 along the other two axes (meissner2002 section 2.1)
};

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
  GradientOf gradient = GradientOf::vertex;  ///< of shadings other than flat and smooth
  std::optional<Lights> lights;              ///< none: a headlight
  /// > 0: extinctions are those of the transfer function times min(1, |gradient| / modulation),
  /// with the gradient of each cell.
  std::optional<double> modulation;
  std::vector<ClipPlane> clip;        ///< what all of them keep is drawn
  std::optional<DepthCue> depth_cue;  ///< mode iso
  OpaqueGeometry opaque;              ///< drawn at its depth in the volume
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

/// Whether normals are those of the cells, not interpolated between vertices.
[[nodiscard]] constexpr bool has_cell_normals(const Scene& scene) {
  return scene.shading == Shading::flat ||
         (scene.shading != Shading::smooth && scene.gradient == GradientOf::cell);
}

/// Whether the largest value of each ray is sought, not the largest color.
[[nodiscard]] constexpr bool is_field_maximum(const Scene& scene) {
  return scene.mode == Mode::mip && scene.mip_of == MipOf::field;
}

/// Whether a medium is lit.
[[nodiscard]] constexpr bool is_lit_medium(const Scene& scene) {
  return scene.mode == Mode::full && scene.shading != Shading::none;
}

/// Whether the picture does not depend on the order in which cells are drawn.
[[nodiscard]] bool is_commutative(const Scene& scene);

}  // namespace tetraglass::project
