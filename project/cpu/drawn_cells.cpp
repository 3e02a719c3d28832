#include "project/cpu/drawn_cells.h"

#include <utility>

#include "base/parallel.h"
#include "project/modulation.h"
#include "project/shown_cells.h"

namespace tetraglass::project::cpu {
namespace {

constexpr std::size_t kGrain = 4096;  // some 50 us of work

/// Sorts the four and tells whether that took an odd number of exchanges.
bool sort_vertices(mesh::Cell& cell) {
  bool odd = false;
  const auto order = [&](std::size_t i, std::size_t j) {
    if (cell[j] < cell[i]) {
      std::swap(cell[i], cell[j]);
      odd = !odd;
    }
  };
  order(0, 1);
  order(2, 3);
  order(0, 2);
  order(1, 3);
  order(1, 2);
  return odd;
}

}  // namespace

DrawnCells::DrawnCells(const Scene& scene) : scale(scene.field) {
  numbers = shown_cells(scene, scale);
  const std::vector<double>& values = scene.field.values;
  const bool of_cells = scene.field.location == mesh::Location::cell;
  cells.resize(numbers.size());
  if (of_cells) cell_values.resize(numbers.size());
  base::parallel_ranges(numbers.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      cells[i].vertices = scene.mesh->cells[numbers[i]];
      cells[i].mirrored = sort_vertices(cells[i].vertices);
      if (of_cells) cell_values[i] = scale.scaled(values[numbers[i]]);
    }
  });
  if (scene.modulation) {
    const std::vector<double> all = cell_densities(scene);
    for (const std::uint32_t cell : numbers) densities.push_back(static_cast<float>(all[cell]));
  }
  if (of_cells) return;
  point_values.resize(values.size());
  base::parallel_ranges(values.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) point_values[i] = scale.scaled(values[i]);
  });
}

}  // namespace tetraglass::project::cpu
