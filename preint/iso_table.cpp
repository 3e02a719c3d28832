#include <algorithm>

#include <fmt/format.h>

#include "base/errors.h"
#include "base/parallel.h"
#include "preint/table.h"
#include "preint/table_axis.h"

namespace tetraglass::preint {
namespace {

/// Surfaces composited so far, from the nearest on.
struct Layers {
  Color color = Color::Zero();
  double transmittance = 1;

  void add_behind(const Isosurface& surface) {
    color += transmittance * surface.opacity * surface.color;
    transmittance *= 1 - surface.opacity;
  }

  void write(float* entry) const {
    for (int c = 0; c < 3; ++c) entry[c] = static_cast<float>(color[c]);
    entry[3] = static_cast<float>(1 - transmittance);
  }
};

/// Surfaces in the order in which a ray on which the field rises (falls) meets them, and which of
/// them a segment crosses.
struct Crossings {
  std::vector<Isosurface> rising;
  std::vector<Isosurface> falling;
  double thickening;

  [[nodiscard]] bool crossed(double front, double back, double isovalue) const {
    if (thickening == 0) return crosses(front, back, isovalue);
    return std::min(front, back) <= isovalue + thickening &&
           std::max(front, back) >= isovalue - thickening;
  }

  /// Of one entry, by asking each surface.
  [[nodiscard]] Layers all(double front, double back) const {
    Layers layers;
    for (const Isosurface& surface : front < back ? rising : falling) {
      if (crossed(front, back, surface.value)) layers.add_behind(surface);
    }
    return layers;
  }
};

}  // namespace

Table2D iso_table(const std::vector<Isosurface>& surfaces, double low, double high, int n,
                  double thickening, TableMethod method) {
  check_axis(low, high, n);
  if (!(thickening >= 0)) {
    throw base::UsageError(fmt::format("isosurfaces cannot be thickened by {}", thickening));
  }
  Crossings crossings{surfaces, surfaces, thickening};
  std::stable_sort(crossings.rising.begin(), crossings.rising.end(),
                   [](const auto& a, const auto& b) { return a.value < b.value; });
  std::stable_sort(crossings.falling.begin(), crossings.falling.end(),
                   [](const auto& a, const auto& b) { return a.value > b.value; });
  const auto size = static_cast<std::size_t>(n);
  Table2D table{n, low, high, Entries(4 * size * size), {}};
  const auto entry = [&](int front, int back) {
    return &table.rgba[4 *
                       (static_cast<std::size_t>(back) * size + static_cast<std::size_t>(front))];
  };
  const auto node = [&](int i) { return table_node(low, high, n, i); };
  // From one front, the back moves away: what it meets comes behind what was met before.
  const auto sweep = [&](int front, int first, int step, const std::vector<Isosurface>& order) {
    Layers layers;
    std::size_t next = 0;
    const auto met = [&](int back) {
      return crossings.crossed(node(front), node(back), order[next].value);
    };
    const int last = step > 0 ? n - 1 : 0;
    // Those before the front are never met.
    while (next < order.size() && !met(last)) ++next;
    for (int back = first; back >= 0 && back < n; back += step) {
      for (; next < order.size() && met(back); ++next) layers.add_behind(order[next]);
      layers.write(entry(front, back));
    }
  };
  base::parallel_ranges(size, 8, [&](std::size_t begin, std::size_t end) {
    for (int front = static_cast<int>(begin); front < static_cast<int>(end); ++front) {
      if (method == TableMethod::incremental) {
        sweep(front, front, -1, crossings.falling);
        sweep(front, front + 1, 1, crossings.rising);
        continue;
      }
      for (int back = 0; back < n; ++back) {
        crossings.all(node(front), node(back)).write(entry(front, back));
      }
    }
  });
  return table;
}

}  // namespace tetraglass::preint
