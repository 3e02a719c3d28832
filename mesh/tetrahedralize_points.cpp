#include <algorithm>

#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/tetrahedralize.h"

#ifdef TETRAGLASS_WITH_CGAL

#include <limits>
#include <utility>

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

namespace tetraglass::mesh {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>;
using CellBase = CGAL::Delaunay_triangulation_cell_base_3<Kernel>;
using Structure = CGAL::Triangulation_data_structure_3<VertexBase, CellBase>;
using Delaunay = CGAL::Delaunay_triangulation_3<Kernel, Structure>;

/// The points with their numbers; inserting in this order keeps the first of equal points, whatever
/// order CGAL inserts them in.
std::vector<std::pair<Kernel::Point_3, std::uint32_t>> distinct_points(const MeshData& data) {
  std::vector<std::pair<Kernel::Point_3, std::uint32_t>> points;
  points.reserve(data.points.size());
  for (std::uint32_t i = 0; i < data.points.size(); ++i) {
    const Eigen::Vector3d& p = data.points[i];
    if (!p.allFinite()) {
      throw base::InputError(fmt::format("the coordinates of point {} are not finite", i));
    }
    points.emplace_back(Kernel::Point_3(p.x(), p.y(), p.z()), i);
  }
  std::ranges::sort(points);
  const auto doubled =
      std::ranges::unique(points, [](const auto& a, const auto& b) { return a.first == b.first; });
  points.erase(doubled.begin(), doubled.end());
  return points;
}

}  // namespace

TetMesh delaunay(const MeshData& data, std::vector<std::string>& notes) {
  const auto points = distinct_points(data);
  const Delaunay triangulation(points.begin(), points.end());
  if (triangulation.dimension() < 3) {
    throw base::InputError(fmt::format("its {} distinct points {} and make no tetrahedra",
                                       points.size(),
                                       points.size() < 4 ? "are too few" : "lie in one plane"));
  }
  TetMesh mesh;
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(data.points.size(), kUnused);
  for (const auto& [point, i] : points) number[i] = 0;
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < number.size(); ++i) {
    if (number[i] == kUnused) continue;
    number[i] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(i);
    mesh.points.push_back(data.points[i]);
  }
  mesh.cells.reserve(triangulation.number_of_finite_cells());
  for (const auto cell : triangulation.finite_cell_handles()) {  // positively oriented
    Cell tetrahedron{};
    for (int k = 0; k < 4; ++k) {
      tetrahedron[static_cast<std::size_t>(k)] = number[cell->vertex(k)->info()];
    }
    mesh.cells.push_back(tetrahedron);
  }
  for (const Field& field : data.fields) {
    if (field.location != Location::point) continue;
    const auto n = static_cast<std::size_t>(field.components);
    Field out{field.name, Location::point, field.components, {}};
    for (const std::uint32_t i : kept) {
      const auto first = field.values.begin() + static_cast<std::ptrdiff_t>(i * n);
      out.values.insert(out.values.end(), first, first + field.components);
    }
    mesh.fields.push_back(std::move(out));
  }
  notes.push_back(fmt::format("Delaunay tetrahedra of {} points by CGAL", kept.size()));
  if (kept.size() < data.points.size()) {
    notes.push_back(
        fmt::format("{} points equal others and are left out", data.points.size() - kept.size()));
  }
  return mesh;
}

}  // namespace tetraglass::mesh

#else

namespace tetraglass::mesh {

TetMesh delaunay(const MeshData& /*data*/, std::vector<std::string>& /*notes*/) {
  throw base::UnavailableError(
      "points alone need CGAL's triangulations, which this build lacks (TETRAGLASS_WITH_CGAL)");
}

}  // namespace tetraglass::mesh

#endif
