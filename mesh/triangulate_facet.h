#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace tetraglass::mesh {

/// The triangles of a plane facet: of what `polygons` enclose (closed outlines; those of one or two
/// points are points and segments that the triangles have to keep), without the parts that the
/// places `holes` lie in. They name all points of the polygons and no others, and turn as the first
/// polygon of three points or more does. By CGAL's constrained Delaunay triangulation of the
/// projection along the largest coordinate of the facet's normal.
///
/// Throws InputError where two segments cross, two points lie above each other, or nothing is
/// enclosed; UnavailableError in a build without CGAL.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> triangulate_facet(
    std::span<const Eigen::Vector3d> points,
    const std::vector<std::vector<std::uint32_t>>& polygons,
    std::span<const Eigen::Vector3d> holes);

}  // namespace tetraglass::mesh
