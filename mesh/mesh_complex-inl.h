#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/errors.h"
#include "mesh/parcel.h"
#include "mesh/predicates.h"
#include "mesh/run_apart.h"
#include "mesh/tetrahedralize.h"

/// What the tetrahedralizers by CGAL's Mesh_3 have in common.
namespace tetraglass::mesh {

/// The lengths that Mesh_3's criteria take, for tetrahedra of a mean volume.
struct MeshCriteriaSizes {
  explicit MeshCriteriaSizes(double volume_of_cell)
      : edge(std::cbrt(volume_of_cell * 6 * std::numbers::sqrt2)) {}
  double edge;                                                 ///< of a regular tetrahedron
  double circumradius = kLargest * edge * std::sqrt(6.0) / 4;  ///< bound of cells and facets
  double distance = 0.1 * edge;  ///< of a facet's circumcentre from the surface
  /// Refinement halves what is too large: the mean comes out so much below the bound.
  static constexpr double kLargest = 1.35;
};

/// The tetrahedra of a complex in 3-complex form (CGAL's c3t3), with the index of their subdomains.
template <typename Complex>
std::string complex_parcel(const Complex& complex) {
  std::map<typename Complex::Vertex_handle, std::uint32_t> numbers;
  std::vector<double> coordinates;
  std::vector<std::uint32_t> corners;
  std::vector<std::int32_t> regions;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end();
       ++cell) {
    for (int k = 0; k < 4; ++k) {
      const auto vertex = cell->vertex(k);
      const auto [entry, is_new] =
          numbers.try_emplace(vertex, static_cast<std::uint32_t>(numbers.size()));
      if (is_new) {
        const auto& p = vertex->point();
        coordinates.insert(coordinates.end(), {p.x(), p.y(), p.z()});
      }
      corners.push_back(entry->second);
    }
    regions.push_back(static_cast<std::int32_t>(complex.subdomain_index(cell)));
  }
  const std::array<std::uint64_t, 2> sizes = {coordinates.size(), regions.size()};
  Parcel parcel;
  parcel.put(sizes.data(), sizes.size());
  parcel.put(coordinates.data(), coordinates.size());
  parcel.put(corners.data(), corners.size());
  parcel.put(regions.data(), regions.size());
  return std::move(parcel.bytes);
}

/// The mesh of such a parcel, with the cell field `region` where there are several subdomains or
/// `always` asks for it.
inline TetMesh mesh_of_parcel(const Apart& apart, bool always) {
  Parcel parcel(apart.result);
  if (!apart.ending.empty() || parcel.bytes.size() < 2 * sizeof(std::uint64_t)) {
    throw base::InputError("CGAL's Mesh_3 " + (apart.ending.empty() ? "failed" : apart.ending));
  }
  const auto sizes = parcel.take<std::uint64_t>(2);
  const auto coordinates = parcel.take<double>(sizes[0]);
  const auto corners = parcel.take<std::uint32_t>(4 * sizes[1]);
  const auto regions = parcel.take<std::int32_t>(sizes[1]);
  TetMesh mesh;
  for (std::size_t i = 0; i < coordinates.size(); i += 3) mesh.points.emplace_back(&coordinates[i]);
  for (std::size_t i = 0; i < corners.size(); i += 4) {
    Cell cell = {corners[i], corners[i + 1], corners[i + 2], corners[i + 3]};
    const auto& p = mesh.points;
    if (orientation(p[cell[0]], p[cell[1]], p[cell[2]], p[cell[3]]) < 0) {
      std::swap(cell[2], cell[3]);
    }
    mesh.cells.push_back(cell);
  }
  const bool several = std::ranges::any_of(regions, [&](auto r) { return r != regions[0]; });
  if (several || always) {
    mesh.fields.push_back({"region", Location::cell, 1, {regions.begin(), regions.end()}});
  }
  return mesh;
}

}  // namespace tetraglass::mesh
