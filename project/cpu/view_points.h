#pragma once

#include <span>
#include <vector>

#include "project/camera.h"
#include "project/clip.h"
#include "project/cpu/drawn_cells.h"
#include "project/opaque_layers.h"

namespace tetraglass::project::cpu {

/// How a view takes camera space to pixels. Lengths and depths are in units of `radius`.
struct Projection {
  /// `radius` > 0: half the diagonal of the mesh; `middle`: a point at which the depths of parallel
  /// views start.
  Projection(const Frame& frame, double radius, const Eigen::Vector3d& middle);

  bool perspective;
  double radius;
  double focal;     ///< pixels per unit of the image plane
  double center_x;  ///< the pixel (fractional, centres at whole numbers) on the camera's axis
  double center_y;
  Eigen::Matrix3d axes;  ///< of the camera (see Frame)
  double depth_offset;   ///< of parallel views
  /// Depth at which the depths of perspective views, 1 - middle_depth / z, are 0 (and finest): that
  /// of `middle` or more.
  double middle_depth;
};

/// A vertex in homogeneous pixels, relative to the camera's axis: in perspective (X z, Y z, z), in
/// parallel views (X, Y, z). Y points down, z away: what was positively oriented stays so.
struct alignas(32) ViewPoint {
  double x = 0;
  double y = 0;
  double z = 0;
  double value = 0;  ///< scaled, a float
};

/// Where a vertex lies in the picture; in perspective without meaning where it is not in front.
struct ScreenPoint {
  float x = 0;
  float y = 0;
  float distance = 0;  ///< grows with the distance from the eye, to order cells by
  float in_front = 1;  ///< 0 behind the plane of the eye (perspective) and on it
};

/// The points of a mesh, as one view has them. Keeps its memory from view to view.
struct ViewPoints {
  std::vector<ViewPoint> exact;
  std::vector<ScreenPoint> screen;

  /// In parallel over the points of the mesh.
  void project(const mesh::TetMesh& mesh, const DrawnCells& cells, const Frame& frame,
               const Projection& projection);
};

/// The part of the rays through pixels that clip planes keep, and that lies in front of the rays'
/// ends where there are some, in the depths of FaceBatch: of the pixel (x, y). Nothing where near
/// >= far.
struct ClippedDepths {
  float near;
  float far;
};
[[nodiscard]] ClippedDepths clipped_depths(std::span<const ClipPlane> planes, RayEnds ends,
                                           const Frame& frame, const Projection& projection, int x,
                                           int y);

/// The field at the eye of a perspective view, inside the cell of these vertices.
[[nodiscard]] double value_at_eye(const mesh::Cell& cell, const ViewPoints& points);

}  // namespace tetraglass::project::cpu
