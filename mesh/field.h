#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace tetraglass::mesh {

enum class Location { point, cell };

/// Named values at the points or in the cells of a mesh.
struct Field {
  std::string name;
  Location location = Location::point;
  int components = 1;
  std::vector<double> values;  ///< `components` values for each point or cell, interleaved

  [[nodiscard]] std::size_t tuples() const {
    return values.size() / static_cast<std::size_t>(components);
  }
};

/// One number per point (linear in each tetrahedron) or per cell (constant in each tetrahedron).
struct ScalarField {
  std::string name;  ///< as asked for: "Temp", "V:magnitude"
  Location location = Location::point;
  std::vector<double> values;
  double min = 0;  ///< over the finite values; 0 where there are none
  double max = 0;
};

}  // namespace tetraglass::mesh
