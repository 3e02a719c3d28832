#include "project/shown_cells.h"

#include <algorithm>

#include "base/parallel.h"

namespace tetraglass::project {
namespace {

constexpr std::size_t kGrain = 4096;  // some 50 us of work

struct Range {
  double low;
  double high;
};

Range range_of(const Scene& scene, std::uint32_t cell) {
  const std::vector<double>& values = scene.field.values;
  if (scene.field.location == mesh::Location::cell) return {values[cell], values[cell]};
  const mesh::Cell& c = scene.mesh->cells[cell];
  const auto [low, high] = std::minmax({values[c[0]], values[c[1]], values[c[2]], values[c[3]]});
  return {low, high};
}

/// Those drawable cells that `shows(Range)` holds for.
template <class F>
std::vector<std::uint32_t> select(const Scene& scene, const F& shows) {
  const std::vector<std::uint32_t>& cells = scene.drawable.cells;
  std::vector<std::uint8_t> drawn(cells.size());
  base::parallel_ranges(cells.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      drawn[i] = shows(range_of(scene, cells[i])) ? 1 : 0;
    }
  });
  std::vector<std::uint32_t> result;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (drawn[i] != 0) result.push_back(cells[i]);
  }
  return result;
}

std::vector<std::uint32_t> crossed_cells(const Scene& scene, const ValueScale& scale) {
  std::vector<float> isovalues;
  for (const preint::Isosurface& surface : scene.isosurfaces) {
    isovalues.push_back(scale.isovalue_threshold(surface.value));
  }
  std::sort(isovalues.begin(), isovalues.end());
  return select(scene, [&](const Range& range) {
    // Half open: low < isovalue <= high (preint::crosses).
    const auto first =
        std::upper_bound(isovalues.begin(), isovalues.end(), scale.scaled(range.low));
    return first != isovalues.end() && *first <= scale.scaled(range.high);
  });
}

}  // namespace

std::vector<std::uint32_t> shown_cells(const Scene& scene, const ValueScale& scale) {
  const preint::TransferFunction& tf = scene.transfer_function;
  switch (scene.mode) {
    case Mode::iso:
      return crossed_cells(scene, scale);
    case Mode::full:
    case Mode::emission:
    case Mode::absorption: {
      const bool clear = std::any_of(tf.points().begin(), tf.points().end(),
                                     [](const auto& point) { return point.extinction == 0; });
      if (!clear) break;
      return select(scene, [&](const Range& range) {
        return range.low == range.high ? tf.at(range.low).extinction > 0
                                       : tf.max_extinction(range.low, range.high) > 0;
      });
    }
    case Mode::mip:
    case Mode::thickness:
      break;
  }
  return scene.drawable.cells;
}

}  // namespace tetraglass::project
