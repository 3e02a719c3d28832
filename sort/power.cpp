#include "sort/power.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include "base/errors.h"
#include "mesh/check.h"
#include "sort/eye_side.h"
#include "sort/hiding_graph.h"

namespace tetraglass::sort {
namespace {

using Eigen::Vector3d;
using Range = tbb::blocked_range<std::size_t>;

constexpr std::size_t kGrain = 4096;

}  // namespace

PowerSorter::PowerSorter(const mesh::TetMesh& mesh, std::span<const std::uint32_t> cells,
                         std::span<const double> weights)
    : mesh_(mesh), weights_(weights), links_(link_cells(mesh, cells)), middle_(Vector3d::Zero()) {
  mesh::Box box;
  for (const std::uint32_t cell : links_.cells) {
    for (const std::uint32_t v : mesh.cells[cell]) box.extend(mesh.points[v]);
  }
  if (!box.isEmpty()) middle_ = box.center();
  spheres_.resize(links_.cells.size());
  tbb::parallel_for(Range(0, spheres_.size(), kGrain), [&](const Range& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      spheres_[i] = power_sphere(mesh, links_.cells[i], weights, middle_);
    }
  });
  const std::string reason = irregularity(mesh, links_, weights, spheres_, middle_);
  if (!reason.empty()) {
    throw base::InputError("the order 'power' is for Delaunay meshes, and this is none: " + reason +
                           "; use 'mpvo'");
  }
  convex_ = links_.cells.size() == mesh.cells.size() && mesh::check(mesh).convex;
}

// power = constant - 2 e . center, less |e|^2; in parallel views direction . center. With the
// errors E of the sphere, and the roundings of e (1), the three products (1 each), the two sums of
// them and the last one (at most 5 in a row): less than 8 u (|constant| + 2 sum |e_i center_i|)
// more.
void PowerSorter::write_powers(const View& view) {
  entries_.resize(links_.cells.size());
  const Vector3d e = view.parallel ? view.direction : Vector3d(view.eye - middle_);
  const double scale = view.parallel ? 1.0 : -2.0;
  const double constant_scale = view.parallel ? 0.0 : 1.0;
  const Vector3d size = e.cwiseAbs();
  constexpr double kRounding = 0x1p-50;
  tbb::parallel_for(Range(0, entries_.size(), kGrain), [&](const Range& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const PowerSphere& s = spheres_[i];
      const double power = constant_scale * s.constant + scale * e.dot(s.center);
      const double error =
          constant_scale * s.constant_error + 2 * size.sum() * s.center_error +
          kRounding * (constant_scale * std::abs(s.constant) + 2 * size.dot(s.center.cwiseAbs()));
      entries_[i] = {power - error, power + error, links_.cells[i]};
    }
  });
}

// Cuts the sorted entries wherever all before are certain to be farther than all after.
void PowerSorter::find_runs() {
  runs_.clear();
  // Sorted by the upper end, farthest first: a cut is certain where no lower end before it comes
  // below the next upper end.
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (i == 0 || lowest > entries_[i].high) runs_.push_back({i, i});
    runs_.back().end = i + 1;
    lowest = std::min(lowest, entries_[i].low);
  }
}

// A cell that hides another one does so along a ray through cells of powers in between: they are in
// the run too, so its relations across faces, and across gaps those of the exact powers, are
// enough.
void PowerSorter::order_run(const Run& run, const View& view, Order& order) const {
  const std::size_t n = run.end - run.begin;
  std::vector<std::uint32_t> cells(n);
  for (std::size_t i = 0; i < n; ++i) cells[i] = entries_[run.begin + i].cell;
  std::sort(cells.begin(), cells.end());
  const auto number = [&](std::uint32_t cell) {
    const auto place = std::lower_bound(cells.begin(), cells.end(), cell);
    return place != cells.end() && *place == cell ? static_cast<std::size_t>(place - cells.begin())
                                                  : n;
  };
  std::vector<std::vector<std::uint32_t>> fronts(n);
  std::vector<std::uint32_t> at_gaps;
  for (std::size_t i = 0; i < n; ++i) {
    const mesh::Cell& c = mesh_.cells[cells[i]];
    bool at_gap = false;
    for (std::size_t face = 0; face < 4; ++face) {
      const std::uint32_t neighbor = links_.adjacency.neighbors[cells[i]][face];
      at_gap = at_gap || neighbor == mesh::kNoCell;
      if (neighbor == mesh::kNoCell) continue;
      const std::size_t j = number(neighbor);
      if (j == n) continue;
      const auto vertex = [&](std::size_t k) -> const Vector3d& {
        return mesh_.points[c[static_cast<std::size_t>(mesh::kFaceVertices[face][k])]];
      };
      if (eye_side(view, vertex(0), vertex(1), vertex(2)) > 0) {
        fronts[i].push_back(static_cast<std::uint32_t>(j));
      }
    }
    if (at_gap && !convex_) at_gaps.push_back(cells[i]);
  }
  if (at_gaps.size() > 1) {
    // Between groups stands a node of its own, so that their relations are not as many as pairs.
    const auto groups = group_by_power(mesh_, at_gaps, weights_, view);
    for (std::size_t g = 0; g + 1 < groups.size(); ++g) {
      const auto between = static_cast<std::uint32_t>(fronts.size());
      for (const std::uint32_t cell : groups[g]) fronts[number(cell)].push_back(between);
      auto& next = fronts.emplace_back();
      for (const std::uint32_t cell : groups[g + 1]) {
        next.push_back(static_cast<std::uint32_t>(number(cell)));
      }
    }
  }
  HidingGraph graph;
  for (const auto& of_cell : fronts) {
    graph.fronts.insert(graph.fronts.end(), of_cell.begin(), of_cell.end());
    graph.offsets.push_back(static_cast<std::uint32_t>(graph.fronts.size()));
  }
  const ResolvedOrder resolved = resolve(graph, std::vector<double>(graph.size(), 0.0));
  std::size_t place = links_.flat.size() + run.begin;
  for (const std::uint32_t i : resolved.cells) {
    if (i < n) order.cells[place++] = cells[i];
  }
  if (resolved.cycles == 0) return;
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  order.cycles += resolved.cycles;
  for (const std::uint32_t i : resolved.cyclic_cells) {
    if (i < n) order.cyclic_cells.push_back(cells[i]);
  }
}

Order PowerSorter::sort(const View& view) {
  Order order;
  order.method = "power";
  order.cells = links_.flat;
  order.cells.resize(links_.flat.size() + links_.cells.size());
  write_powers(view);
  tbb::parallel_sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
    return a.high != b.high ? a.high > b.high : a.cell < b.cell;
  });
  find_runs();
  tbb::parallel_for(Range(0, runs_.size(), 64), [&](const Range& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Run& run = runs_[i];
      if (run.end - run.begin == 1) {
        order.cells[links_.flat.size() + run.begin] = entries_[run.begin].cell;
      } else {
        order_run(run, view, order);
      }
    }
  });
  std::sort(order.cyclic_cells.begin(), order.cyclic_cells.end());
  order.exact = order.cycles == 0;
  return order;
}

}  // namespace tetraglass::sort
