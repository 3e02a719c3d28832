#include "project/cpu/drawn_cells.h"

#include <algorithm>
#include <array>
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

std::vector<std::uint32_t> highest_first(const DrawnCells& cells) {
  constexpr int kSteps = 64;
  std::vector<std::uint8_t> steps(cells.size());
  base::parallel_ranges(cells.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      float most = -1;
      if (!cells.cell_values.empty()) {
        most = cells.cell_values[i];
      } else {
        for (const std::uint32_t v : cells.cells[i].vertices) {
          most = std::max(most, cells.point_values[v]);
        }
      }
      const auto below = static_cast<int>(0.5F * (1 - most) * kSteps);
      steps[i] = static_cast<std::uint8_t>(std::clamp(below, 0, kSteps - 1));
    }
  });
  std::array<std::uint32_t, kSteps + 1> starts{};
  for (const std::uint8_t step : steps) ++starts[step + 1U];
  for (std::size_t step = 0; step < kSteps; ++step) starts[step + 1] += starts[step];
  std::vector<std::uint32_t> result(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    result[starts[steps[i]]++] = static_cast<std::uint32_t>(i);
  }
  return result;
}

DrawnCells::DrawnCells(const Scene& scene) : scale(scene.field) {
  update(scene);
}

void DrawnCells::update(const Scene& scene) {
  scale = ValueScale(scene.field);
  std::vector<std::uint32_t> shown = shown_cells(scene, scale);
  const bool same = shown == numbers;
  numbers = std::move(shown);
  const std::vector<double>& values = scene.field.values;
  const bool of_cells = scene.field.location == mesh::Location::cell;
  cells.resize(numbers.size());
  cell_values.resize(of_cells ? numbers.size() : 0);
  if (!same || of_cells) {
    base::parallel_ranges(numbers.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (of_cells) cell_values[i] = scale.scaled(values[numbers[i]]);
        if (same) continue;
        cells[i].vertices = scene.mesh->cells[numbers[i]];
        cells[i].mirrored = sort_vertices(cells[i].vertices);
      }
    });
  }
  densities.clear();
  if (scene.modulation) {
    const std::vector<double> all = cell_densities(scene);
    for (const std::uint32_t cell : numbers) densities.push_back(static_cast<float>(all[cell]));
  }
  point_values.resize(of_cells ? 0 : values.size());
  if (of_cells) return;
  base::parallel_ranges(values.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) point_values[i] = scale.scaled(values[i]);
  });
}

}  // namespace tetraglass::project::cpu
