#pragma once

#include <optional>
#include <span>

#include "mesh/volume.h"

namespace tetraglass::mesh {

/// The regular grid that the points of `data` lie on, first axis fastest, as files of images and
/// volumes have them, with the values of one field (of its cells: then the grid is that of their
/// centres). The field is the one called `name`, or the first scalar if that is empty; of several
/// components the first counts. Throws InputError where the points are not such a grid (each within
/// the rounding of single precision of its place) and where there is no such field.
[[nodiscard]] Volume regular_grid(const MeshData& data, const std::string& name);

/// The linear interpolation of the values at the eight points around a place; outside of the grid,
/// at the nearest place in it. `values` has `components` for each point.
void interpolate(const Volume& grid, std::span<const double> values, int components,
                 const Eigen::Vector3d& place, std::span<double> result);

}  // namespace tetraglass::mesh
