#include "sort/power.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "base/errors.h"
#include "mesh/check.h"
#include "sort/eye_side.h"
#include "sort/hiding_graph.h"

namespace tetraglass::sort {
namespace {

using Eigen::Vector3d;
using Range = tbb::blocked_range<std::size_t>;

constexpr std::size_t kGrain = 4096;

// Adds to the errors of a sphere what evaluating a power costs: the eye relative to the middle is
// rounded (1), so are the four products (1 each), the two sums of three of them and the last one
// (at most 4 in a row), and this bound itself: less than 16 u of the absolute values of the terms.
PowerSphere with_roundings(PowerSphere sphere) {
  constexpr double kRoundings = 0x1p-49;
  sphere.constant_error += kRoundings * std::abs(sphere.constant);
  sphere.center_error += kRoundings * sphere.center.cwiseAbs().maxCoeff();
  return sphere;
}

}  // namespace

PowerSorter::PowerSorter(const mesh::TetMesh& mesh, std::span<const std::uint32_t> cells,
                         std::span<const double> weights)
    : mesh_(mesh), weights_(weights), links_(link_cells(mesh, cells)), middle_(Vector3d::Zero()) {
  mesh::Box box;
  for (const std::uint32_t cell : links_.cells) {
    for (const std::uint32_t v : mesh.cells[cell]) box.extend(mesh.points[v]);
  }
  if (!box.isEmpty()) {
    middle_ = box.center();
    radius_ = 0.5 * box.diagonal().norm();
  }
  std::vector<PowerSphere> spheres(links_.cells.size());
  tbb::parallel_for(Range(0, spheres.size(), kGrain), [&](const Range& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      spheres[i] = power_sphere(mesh, links_.cells[i], weights, middle_);
    }
  });
  const Regularity regularity = check_regularity(mesh, links_, weights, spheres, middle_);
  if (!regularity.fault.empty()) {
    throw base::InputError("the order 'power' is for Delaunay meshes, and this is none: " +
                           regularity.fault + "; use 'mpvo'");
  }
  convex_ = links_.cells.size() == mesh.cells.size() && mesh::check(mesh).convex;
  groups_.emplace(mesh, links_, regularity.ties, middle_);
  spheres_.reserve(groups_->size());
  for (std::size_t group = 0; group < groups_->size(); ++group) {
    const auto first =
        std::lower_bound(links_.cells.begin(), links_.cells.end(), groups_->cells(group).front());
    spheres_.push_back(
        with_roundings(spheres[static_cast<std::size_t>(first - links_.cells.begin())]));
  }
  std::vector<std::uint32_t> items = links_.cells;
  if (groups_->has_ties()) {
    items.resize(groups_->size());
    std::iota(items.begin(), items.end(), 0U);
  }
  double largest_weight = 0;
  for (const double weight : weights) largest_weight = std::max(largest_weight, std::abs(weight));
  keyed_ = KeyedSpheres(spheres_, radius_, largest_weight, std::move(items));
  order_.method = "power";
}

// An entry for each group, and the runs of those whose order is uncertain.
PowerSorter::Entries PowerSorter::sort_groups(Frame& frame) {
  const auto write = [&](std::size_t begin, std::size_t count, KeyedItem* target) {
    keyed_.write(frame.keys, begin, count, target);
    key_far_spheres(begin, count, target, frame);
  };
  const Entries entries = sorter_.sort(keyed_.size(), write, [&](Entries some, std::size_t begin) {
    take_sorted(some, begin, frame);
  });
  find_runs(entries, frame);
  return entries;
}

void PowerSorter::key_far_spheres(std::size_t begin, std::size_t count, KeyedItem* target,
                                  Frame& frame) const {
  const auto& far = keyed_.far();
  for (auto i = std::lower_bound(far.begin(), far.end(), begin);
       i != far.end() && *i < begin + count; ++i) {
    const PowerSphere& sphere = spheres_[*i];
    const KeyRange range =
        doubtful_range(frame.keys, frame.power.of(sphere), frame.power.doubt(sphere));
    target[*i - begin] = keyed(range.low + (range.high - range.low) / 2, keyed_.item(*i));
    const std::lock_guard lock(frame.mutex);
    frame.doubtful.push_back(range);
  }
}

// Of sorted entries that are still in the cache, the first one being of number `begin`. Where each
// group is one cell these are written right away.
void PowerSorter::take_sorted(Entries entries, std::size_t begin, Frame& frame) {
  if (entries.empty()) return;
  if (!groups_->has_ties()) {
    std::transform(entries.begin(), entries.end(),
                   order_.cells.begin() + static_cast<std::ptrdiff_t>(links_.flat.size() + begin),
                   item_of);
  }
  std::vector<Run> runs;
  // Whether the last entry before is certain to be farther is seen in the end.
  if (begin > 0) runs.push_back({begin - 1, begin + 1});
  for (std::size_t i = 1; i < entries.size(); ++i) {
    if (!is_cut(frame.keys, key_of(entries[i - 1]), key_of(entries[i]))) {
      runs.push_back({begin + i - 1, begin + i + 1});
    }
  }
  if (runs.empty()) return;
  const std::lock_guard lock(frame.mutex);
  frame.runs.insert(frame.runs.end(), runs.begin(), runs.end());
}

void PowerSorter::find_runs(Entries entries, Frame& frame) const {
  std::erase_if(frame.runs, [&](const Run& pair) {
    return is_cut(frame.keys, key_of(entries[pair.begin]), key_of(entries[pair.begin + 1]));
  });
  join_overlapping(frame.doubtful);
  for (const KeyRange& range : frame.doubtful) {
    const auto first = std::partition_point(
        entries.begin(), entries.end(), [&](KeyedItem entry) { return key_of(entry) < range.low; });
    const auto last = std::partition_point(
        first, entries.end(), [&](KeyedItem entry) { return key_of(entry) <= range.high; });
    frame.runs.push_back({static_cast<std::size_t>(first - entries.begin()),
                          static_cast<std::size_t>(last - entries.begin())});
  }
  join_overlapping(frame.runs);
}

std::uint32_t PowerSorter::group_of(KeyedItem entry) const {
  // Most meshes leave no cell out.
  if (groups_->has_ties() || links_.cells.size() == mesh_.cells.size()) return item_of(entry);
  const auto place = std::lower_bound(links_.cells.begin(), links_.cells.end(), item_of(entry));
  return static_cast<std::uint32_t>(place - links_.cells.begin());
}

void PowerSorter::write_group(std::uint32_t group, std::size_t place, Frame& frame) {
  std::uint32_t* target = order_.cells.data() + place;
  if (!groups_->has_ties()) {
    *target = links_.cells[group];
    return;
  }
  if (groups_->write_order(group, frame.view, frame.sides, target)) return;
  const auto cells = groups_->cells(group);
  const std::lock_guard lock(frame.mutex);
  ++order_.cycles;
  order_.cyclic_cells.insert(order_.cyclic_cells.end(), cells.begin(), cells.end());
}

// Writes the groups, and the runs of uncertain order, that begin within a chunk of the entries, of
// which the first one has its cells at `place`.
void PowerSorter::write_chunk(Entries entries, std::size_t begin, std::size_t end,
                              std::size_t place, Frame& frame) {
  auto run = std::partition_point(frame.runs.begin(), frame.runs.end(),
                                  [&](const Run& r) { return r.end <= begin; });
  if (run != frame.runs.end() && run->begin < begin) {
    for (; begin < std::min(end, run->end); ++begin)
      place += groups_->size(item_of(entries[begin]));
    ++run;
  }
  while (begin < end) {
    const std::size_t group = item_of(entries[begin]);
    if (run == frame.runs.end() || run->begin != begin) {
      write_group(static_cast<std::uint32_t>(group), place, frame);
      place += groups_->size(group);
      ++begin;
      continue;
    }
    write_run(entries.subspan(begin, run->end - begin), place, frame);
    for (; begin < run->end; ++begin) place += groups_->size(item_of(entries[begin]));
    ++run;
  }
}

// All cells of all groups.
void PowerSorter::write_groups(Entries entries, Frame& frame) {
  const Chunks chunks(entries.size());
  std::vector<std::size_t> places(chunks.count + 1, links_.flat.size());
  chunks.for_each([&](std::size_t chunk) {
    std::size_t cells = 0;
    for (std::size_t i = chunks.begin(chunk); i < chunks.end(chunk); ++i) {
      cells += groups_->size(item_of(entries[i]));
    }
    places[chunk + 1] = cells;
  });
  for (std::size_t i = 0; i < chunks.count; ++i) places[i + 1] += places[i];
  chunks.for_each([&](std::size_t chunk) {
    write_chunk(entries, chunks.begin(chunk), chunks.end(chunk), places[chunk], frame);
  });
}

// By powers in double, cut wherever all before are certain to be farther than all after.
void PowerSorter::write_run(Entries run, std::size_t place, Frame& frame) {
  struct Bounded {
    double low;
    double high;
    std::uint32_t group;
  };
  std::vector<Bounded> groups;
  groups.reserve(run.size());
  for (const KeyedItem entry : run) {
    const std::uint32_t group = group_of(entry);
    const PowerSphere& sphere = spheres_[group];
    const double power = frame.power.of(sphere);
    const double doubt = frame.power.doubt(sphere);
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const bool is_known = std::isfinite(power) && std::isfinite(doubt);
    groups.push_back(
        {is_known ? power - doubt : -kInfinity, is_known ? power + doubt : kInfinity, group});
  }
  std::sort(groups.begin(), groups.end(), [](const Bounded& a, const Bounded& b) {
    return a.high != b.high ? a.high > b.high : a.group < b.group;
  });
  std::vector<std::uint32_t> tied;
  for (std::size_t begin = 0; begin < groups.size();) {
    double lowest = std::numeric_limits<double>::infinity();
    std::size_t cells = 0;
    std::size_t end = begin;
    while (end < groups.size() && (end == begin || groups[end].high >= lowest)) {
      lowest = std::min(lowest, groups[end].low);
      cells += groups_->has_ties() ? groups_->size(groups[end].group) : 1;
      ++end;
    }
    if (end == begin + 1) {
      write_group(groups[begin].group, place, frame);
    } else {
      tied.clear();
      for (std::size_t i = begin; i < end; ++i) tied.push_back(groups[i].group);
      write_by_faces(tied, place, frame);
    }
    begin = end;
    place += cells;
  }
}

// Across gaps of the mesh, by the exact powers of groups: cells of equal ones hide each other at
// faces only. Between cells of unlike powers stands a node of its own, so that the relations are
// not as many as pairs.
void PowerSorter::relate_across_gaps(std::span<const std::uint32_t> cells, const View& view,
                                     std::size_t& nodes, std::vector<Relation>& relations) const {
  std::vector<std::uint32_t> at_gaps;
  for (const std::uint32_t cell : cells) {
    const auto& neighbors = links_.adjacency.neighbors[cell];
    if (std::find(neighbors.begin(), neighbors.end(), mesh::kNoCell) != neighbors.end()) {
      at_gaps.push_back(cell);
    }
  }
  if (at_gaps.size() < 2) return;
  const auto number = [&](std::uint32_t cell) {
    return static_cast<std::uint32_t>(std::lower_bound(cells.begin(), cells.end(), cell) -
                                      cells.begin());
  };
  const auto levels = group_by_power(mesh_, at_gaps, weights_, view);
  for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
    const auto between = static_cast<std::uint32_t>(nodes++);
    for (const std::uint32_t cell : levels[i]) relations.push_back({between, number(cell)});
    for (const std::uint32_t cell : levels[i + 1]) relations.push_back({number(cell), between});
  }
}

// A cell that hides another one does so along a ray through cells of powers in between: they are
// among the groups too, so the relations across their faces, and across gaps, are enough.
void PowerSorter::write_by_faces(std::span<const std::uint32_t> groups, std::size_t place,
                                 Frame& frame) {
  std::vector<std::uint32_t> cells;
  for (const std::uint32_t group : groups) {
    const auto some = groups_->cells(group);
    cells.insert(cells.end(), some.begin(), some.end());
  }
  std::sort(cells.begin(), cells.end());
  std::vector<Relation> relations;
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    const mesh::Cell& c = mesh_.cells[cells[i]];
    for (std::size_t face = 0; face < 4; ++face) {
      const std::uint32_t neighbor = links_.adjacency.neighbors[cells[i]][face];
      if (neighbor == mesh::kNoCell || neighbor < cells[i]) continue;
      const auto found = std::lower_bound(cells.begin() + i, cells.end(), neighbor);
      if (found == cells.end() || *found != neighbor) continue;
      const auto vertex = [&](std::size_t k) -> const Vector3d& {
        return mesh_.points[c[static_cast<std::size_t>(mesh::kFaceVertices[face][k])]];
      };
      const int side = eye_side(frame.view, vertex(0), vertex(1), vertex(2));
      const auto j = static_cast<std::uint32_t>(found - cells.begin());
      if (side > 0) relations.push_back({j, i});
      if (side < 0) relations.push_back({i, j});
    }
  }
  std::size_t nodes = cells.size();
  if (!convex_) relate_across_gaps(cells, frame.view, nodes, relations);
  const ResolvedOrder resolved =
      resolve(make_graph(nodes, relations), std::vector<double>(nodes, 0.0));
  for (const std::uint32_t i : resolved.cells) {
    if (i < cells.size()) order_.cells[place++] = cells[i];
  }
  if (resolved.cycles == 0) return;
  const std::lock_guard lock(frame.mutex);
  order_.cycles += resolved.cycles;
  for (const std::uint32_t i : resolved.cyclic_cells) {
    if (i < cells.size()) order_.cyclic_cells.push_back(cells[i]);
  }
}

const Order& PowerSorter::sort(const View& view) {
  order_.cycles = 0;
  order_.cyclic_cells.clear();
  order_.cells.resize(links_.flat.size() + links_.cells.size());
  std::copy(links_.flat.begin(), links_.flat.end(), order_.cells.begin());
  const PowerOfEye power(view, middle_);
  Frame frame{view, power, keyed_.choose_keys(power), EyeSides(view, middle_, radius_), {}, {}, {}};
  const Entries entries = sort_groups(frame);
  if (groups_->has_ties()) {
    write_groups(entries, frame);
  } else {
    tbb::parallel_for(Range(0, frame.runs.size(), 64), [&](const Range& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        const auto [begin, end] = frame.runs[i];
        write_run(entries.subspan(begin, end - begin), links_.flat.size() + begin, frame);
      }
    });
  }
  std::sort(order_.cyclic_cells.begin(), order_.cyclic_cells.end());
  order_.exact = order_.cycles == 0;
  return order_;
}

}  // namespace tetraglass::sort
