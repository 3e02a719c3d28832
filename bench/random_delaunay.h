#pragma once

#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "mesh/mesh_data.h"
#include "mesh/tetrahedralize.h"

namespace tetraglass::bench {

inline constexpr double kCellsPerPoint = 6.7;

/// The Delaunay tetrahedra of random points in the unit cube, about kCellsPerPoint each, with the
/// field `wave`: slivers among them, and large flat ones on the hull.
inline mesh::TetMesh random_delaunay(int points) {
  std::mt19937 random;
  const auto coordinate = [&] { return random() * 0x1p-32; };
  mesh::MeshData data;
  std::vector<double> values;
  for (int i = 0; i < points; ++i) {
    const double x = coordinate();
    const double y = coordinate();
    const double z = coordinate();
    data.points.emplace_back(x, y, z);
    values.push_back(0.5 + 0.5 * std::sin(5 * x) * std::cos(4 * y + 2 * z));
  }
  data.fields.push_back({"wave", mesh::Location::point, 1, std::move(values)});
  std::vector<std::string> notes;
  return mesh::delaunay(data, notes);
}

}  // namespace tetraglass::bench
