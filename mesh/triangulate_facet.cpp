#include "mesh/triangulate_facet.h"

#include "base/errors.h"

#ifdef TETRAGLASS_WITH_CGAL

#include <map>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <Eigen/Geometry>

namespace tetraglass::mesh {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
/// Of each triangle, whether it is no part of the facet.
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<bool, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
    CGAL::No_constraint_intersection_requiring_constructions_tag>;

/// Twice the area of a polygon along its normal. Source: Newell's method.
Eigen::Vector3d area_vector(std::span<const Eigen::Vector3d> points,
                            std::span<const std::uint32_t> polygon) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const Eigen::Vector3d& origin = points[polygon[0]];
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    sum += (points[polygon[i]] - origin).cross(points[polygon[i + 1]] - origin);
  }
  return sum;
}

/// Two of the coordinates, so that the facet is seen counter-clockwise.
class Projection {
 public:
  explicit Projection(const Eigen::Vector3d& normal) {
    normal.cwiseAbs().maxCoeff(&axis_);
    first_ = (axis_ + 1) % 3;
    second_ = (axis_ + 2) % 3;
    if (normal[axis_] < 0) std::swap(first_, second_);
  }
  [[nodiscard]] Kernel::Point_2 operator()(const Eigen::Vector3d& p) const {
    return {p[first_], p[second_]};
  }

 private:
  Eigen::Index axis_ = 0;
  Eigen::Index first_ = 0;
  Eigen::Index second_ = 0;
};

/// Marks all triangles that can be reached without passing a segment.
void mark_outside(Triangulation::Face_handle start) {
  std::vector<Triangulation::Face_handle> left = {start};
  start->info() = true;
  while (!left.empty()) {
    const Triangulation::Face_handle face = left.back();
    left.pop_back();
    for (int i = 0; i < 3; ++i) {
      const Triangulation::Face_handle next = face->neighbor(i);
      if (next->info() || face->is_constrained(i)) continue;
      next->info() = true;
      left.push_back(next);
    }
  }
}

void insert(Triangulation& triangulation, std::span<const Eigen::Vector3d> points,
            const std::vector<std::vector<std::uint32_t>>& polygons, const Projection& project) {
  std::map<std::uint32_t, Triangulation::Vertex_handle> vertices;
  const auto vertex = [&](std::uint32_t i) {
    const auto [entry, is_new] = vertices.try_emplace(i);
    if (is_new) {
      const std::size_t before = triangulation.number_of_vertices();
      entry->second = triangulation.insert(project(points[i]));
      if (triangulation.number_of_vertices() > before) {
        entry->second->info() = i;
      } else if (points[entry->second->info()] != points[i]) {
        throw base::InputError("the facet is not plane: two of its points lie above each other");
      }
    }
    return entry->second;
  };
  for (const auto& polygon : polygons) {
    for (const std::uint32_t i : polygon) vertex(i);
  }
  for (const auto& polygon : polygons) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const auto a = vertex(polygon[i]);
      const auto b = vertex(polygon[(i + 1) % polygon.size()]);
      if (a != b) triangulation.insert_constraint(a, b);
    }
  }
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate_facet(
    std::span<const Eigen::Vector3d> points,
    const std::vector<std::vector<std::uint32_t>>& polygons,
    std::span<const Eigen::Vector3d> holes) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (const auto& polygon : polygons) {
    if (polygon.size() >= 3 && normal.isZero(0)) normal = area_vector(points, polygon);
    for (const std::uint32_t i : polygon) {
      if (!points[i].allFinite())
        throw base::InputError("the facet has a point that is not finite");
    }
  }
  if (!(normal.allFinite() && !normal.isZero(0))) {
    throw base::InputError("the facet encloses nothing");
  }
  const Projection project(normal);
  Triangulation triangulation;
  try {
    insert(triangulation, points, polygons, project);
  } catch (const Triangulation::Intersection_of_constraints_exception&) {
    throw base::InputError("two segments of the facet cross");
  }
  if (triangulation.dimension() < 2) throw base::InputError("the facet encloses nothing");
  for (const auto face : triangulation.all_face_handles()) face->info() = false;
  mark_outside(triangulation.infinite_face());
  for (const Eigen::Vector3d& hole : holes) {
    if (hole.allFinite()) mark_outside(triangulation.locate(project(hole)));
  }
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const auto face : triangulation.finite_face_handles()) {
    if (face->info()) continue;
    triangles.push_back(
        {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  }
  if (triangles.empty()) throw base::InputError("the facet encloses nothing");
  return triangles;
}

}  // namespace tetraglass::mesh

#else

namespace tetraglass::mesh {

std::vector<std::array<std::uint32_t, 3>> triangulate_facet(
    std::span<const Eigen::Vector3d> /*points*/,
    const std::vector<std::vector<std::uint32_t>>& /*polygons*/,
    std::span<const Eigen::Vector3d> /*holes*/) {
  throw base::UnavailableError(
      "facets of more than four points need CGAL, which this build lacks (TETRAGLASS_WITH_CGAL)");
}

}  // namespace tetraglass::mesh

#endif
