#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "project/image.h"
#include "project/scene.h"
#include "project/stats.h"

namespace tetraglass::project {

/// The judge of what draws grids by their trilinear field: double precision, one ray at a time. A
/// ray is split at the planes of the voxels, where the field (a cubic along the ray) turns and
/// where it meets control points of the transfer function; optical depths of the pieces are exact,
/// light is integrated by adaptive Gauss-Legendre quadrature to 1e-12 a piece; lit media are lit at
/// every point, modulated ones thinned at every point, and integrated to 1e-8. Normals are those of
/// grid_gradient. Of a scene with a grid and a point field of finite values. A pixel for each
/// sample.
[[nodiscard]] Image render_grid_reference(const Scene& scene, Stats& stats);

/// Single pixels (x, y) of the scene's picture: RGBA each, the mean of their samples.
[[nodiscard]] std::vector<Eigen::Array4d> grid_reference_pixels(
    const Scene& scene, std::span<const Eigen::Vector2i> pixels);

/// The gradient of the trilinear field at a place of the grid (RectilinearGrid::index_at), by
/// differences between the places one point up and one down along each axis, or the grid's end;
/// with GradientOf::sobel of values smoothed along the other two.
[[nodiscard]] Eigen::Vector3d grid_gradient(const Scene& scene, const Eigen::Vector3d& index);

}  // namespace tetraglass::project
