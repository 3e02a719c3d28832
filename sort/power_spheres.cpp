#include "sort/power_spheres.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>

#include <CGAL/Exact_rational.h>
#include <CGAL/Interval_nt.h>
#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "mesh/predicates.h"

namespace tetraglass::sort {
namespace {

using Eigen::Vector3d;
using Interval = CGAL::Interval_nt<true>;
using Exact = CGAL::Exact_rational;
using Range = tbb::blocked_range<std::size_t>;

constexpr std::size_t kGrain = 1024;

double weight_of(std::span<const double> weights, std::uint32_t point) {
  return weights.empty() ? 0.0 : weights[point];
}

template <typename Number>
using Vector = std::array<Number, 3>;

template <typename Number>
Vector<Number> minus(const Vector3d& a, const Vector3d& b) {
  return {Number(a.x()) - Number(b.x()), Number(a.y()) - Number(b.y()),
          Number(a.z()) - Number(b.z())};
}
template <typename Number>
Number dot(const Vector<Number>& a, const Vector<Number>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <typename Number>
Vector<Number> cross(const Vector<Number>& a, const Vector<Number>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <typename Number>
struct Sphere {
  Vector<Number> center;
  Number constant;
};

// With d_i the edges from the first vertex p and w_i the weights, the center p + q has
// 2 q . d_i = |d_i|^2 - (w_i - w_0).
template <typename Number>
Sphere<Number> solve(const mesh::TetMesh& mesh, const mesh::Cell& cell,
                     std::span<const double> weights, const Vector3d& middle) {
  const Vector3d& first = mesh.points[cell[0]];
  std::array<Vector<Number>, 3> d;
  Vector<Number> s;
  for (std::size_t i = 0; i < 3; ++i) {
    d[i] = minus<Number>(mesh.points[cell[i + 1]], first);
    s[i] = dot(d[i], d[i]) -
           (Number(weight_of(weights, cell[i + 1])) - Number(weight_of(weights, cell[0])));
  }
  const Vector<Number> yz = cross(d[1], d[2]);
  const Vector<Number> zx = cross(d[2], d[0]);
  const Vector<Number> xy = cross(d[0], d[1]);
  const Number twice = Number(2) * dot(d[0], yz);
  const Vector<Number> p = minus<Number>(first, middle);
  Sphere<Number> sphere;
  Vector<Number> q;
  for (std::size_t k = 0; k < 3; ++k) {
    q[k] = (s[0] * yz[k] + s[1] * zx[k] + s[2] * xy[k]) / twice;
    sphere.center[k] = p[k] + q[k];
  }
  sphere.constant = dot(p, p) + Number(2) * dot(q, p) + Number(weight_of(weights, cell[0]));
  return sphere;
}

double middle_of(const Interval& i) {
  return 0.5 * i.inf() + 0.5 * i.sup();
}
// More than the distance from the middle to either end, with its rounding.
double half_width(const Interval& i) {
  return (i.sup() - i.inf()) * (0.5 + 0x1p-20) + 0x1p-52 * std::abs(middle_of(i));
}

PowerSphere within_bounds(const Sphere<Interval>& sphere) {
  PowerSphere result;
  for (std::size_t k = 0; k < 3; ++k) {
    result.center[static_cast<int>(k)] = middle_of(sphere.center[k]);
    result.center_error = std::max(result.center_error, half_width(sphere.center[k]));
  }
  result.constant = middle_of(sphere.constant);
  result.constant_error = half_width(sphere.constant);
  return result;
}

// The points that cells use, halved again and again, with boxes: to find those beyond a face.
class PointTree {
 public:
  PointTree(const mesh::TetMesh& mesh, const CellLinks& links, std::span<const double> weights)
      : mesh_(mesh) {
    std::vector<bool> used(mesh.points.size(), false);
    for (const std::uint32_t cell : links.cells) {
      for (const std::uint32_t v : mesh.cells[cell]) used[v] = true;
    }
    for (std::uint32_t i = 0; i < mesh.points.size(); ++i) {
      if (used[i]) points_.push_back(i);
      if (used[i]) largest_weight_ = std::max(largest_weight_, weight_of(weights, i));
    }
    std::size_t leaves = 1;
    while (leaves * kLeaf < points_.size()) leaves *= 2;
    boxes_.resize(2 * leaves);
    if (!points_.empty()) build(1, 0, points_.size());
  }

  [[nodiscard]] double largest_weight() const { return largest_weight_; }

  // Whether test(point) holds for a point in a box for which may_hold(box) does.
  template <typename MayHold, typename Test>
  [[nodiscard]] bool any(const MayHold& may_hold, const Test& test) const {
    return !points_.empty() && any(1, 0, points_.size(), may_hold, test);
  }

 private:
  static constexpr std::size_t kLeaf = 8;

  void build(std::size_t node, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) boxes_[node].extend(mesh_.points[points_[i]]);
    if (2 * node >= boxes_.size()) return;
    int axis = 0;
    boxes_[node].sizes().maxCoeff(&axis);
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) { return points_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
      return mesh_.points[a][axis] < mesh_.points[b][axis];
    });
    build(2 * node, begin, middle);
    build(2 * node + 1, middle, end);
  }

  template <typename MayHold, typename Test>
  bool any(std::size_t node, std::size_t begin, std::size_t end, const MayHold& may_hold,
           const Test& test) const {
    if (!may_hold(boxes_[node])) return false;
    if (2 * node >= boxes_.size()) {
      return std::any_of(points_.begin() + static_cast<std::ptrdiff_t>(begin),
                         points_.begin() + static_cast<std::ptrdiff_t>(end), test);
    }
    const std::size_t middle = begin + (end - begin) / 2;
    return any(2 * node, begin, middle, may_hold, test) ||
           any(2 * node + 1, middle, end, may_hold, test);
  }

  const mesh::TetMesh& mesh_;
  std::vector<std::uint32_t> points_;
  std::vector<mesh::Box> boxes_;
  double largest_weight_ = 0;
};

// Examines the faces of one cell after the other.
class Examination {
 public:
  Examination(const mesh::TetMesh& mesh, const CellLinks& links, std::span<const double> weights,
              const std::vector<PowerSphere>& spheres, const Vector3d& middle)
      : mesh_(mesh),
        links_(links),
        weights_(weights),
        spheres_(spheres),
        middle_(middle),
        tree_(mesh, links, weights) {}

  // What is wrong with the i-th cell; empty if nothing. Sets the bits of the faces across which the
  // neighbour has its sphere.
  [[nodiscard]] std::string examine(std::size_t i, std::uint8_t& ties) const {
    const std::uint32_t cell = links_.cells[i];
    for (std::size_t face = 0; face < 4; ++face) {
      const std::uint32_t neighbor = links_.adjacency.neighbors[cell][face];
      if (neighbor == mesh::kNoCell) {
        if (has_conflict_beyond(i, face)) {
          return fmt::format("beyond a boundary face of cell {} its circumsphere holds a point",
                             cell);
        }
      } else if (neighbor > cell) {
        const int found = conflict(cell, far_vertex(cell, neighbor));
        if (found > 0) {
          return fmt::format("the circumsphere of cell {} holds a vertex of cell {}", cell,
                             neighbor);
        }
        if (found == 0) ties = static_cast<std::uint8_t>(ties | 1U << face);
      }
    }
    return {};
  }

 private:
  [[nodiscard]] std::uint32_t far_vertex(std::uint32_t cell, std::uint32_t neighbor) const {
    const mesh::Cell& mine = mesh_.cells[cell];
    const mesh::Cell& other = mesh_.cells[neighbor];
    return *std::find_if(other.begin(), other.end(), [&](std::uint32_t v) {
      return std::find(mine.begin(), mine.end(), v) == mine.end();
    });
  }

  [[nodiscard]] int conflict(std::uint32_t cell, std::uint32_t point) const {
    const mesh::Cell& c = mesh_.cells[cell];
    const auto& p = mesh_.points;
    if (weights_.empty()) return mesh::in_sphere(p[c[0]], p[c[1]], p[c[2]], p[c[3]], p[point]);
    const auto weighted = [&](std::uint32_t v) { return mesh::WeightedPoint{p[v], weights_[v]}; };
    return mesh::in_power_sphere(weighted(c[0]), weighted(c[1]), weighted(c[2]), weighted(c[3]),
                                 weighted(point));
  }

  [[nodiscard]] bool has_conflict_beyond(std::size_t i, std::size_t face) const {
    const std::uint32_t cell = links_.cells[i];
    const mesh::Cell& c = mesh_.cells[cell];
    const auto vertex = [&](std::size_t k) -> const Vector3d& {
      return mesh_.points[c[static_cast<std::size_t>(mesh::kFaceVertices[face][k])]];
    };
    const Vector3d a = vertex(0);
    const Vector3d normal = (vertex(1) - a).cross(vertex(2) - a);
    const PowerSphere& sphere = spheres_[i];
    const double radius2 =
        std::max(0.0, sphere.center.squaredNorm() - sphere.constant) + tree_.largest_weight();
    // Far more than the roundings of the distances; a box too many costs time only.
    const double slack = 0x1p-30 * (sphere.center.norm() + std::sqrt(radius2)) +
                         4 * sphere.center_error + std::sqrt(4 * sphere.constant_error);
    const double reach = std::sqrt(radius2) + slack;
    const double length = normal.norm();
    const auto may_hold = [&](const mesh::Box& box) {
      const Vector3d half = 0.5 * box.sizes();
      const Vector3d center = box.center();
      const double height = normal.dot(center - a);
      const double room = normal.cwiseAbs().dot(half);
      const double doubt = 0x1p-40 * length * ((center - a).norm() + half.norm());
      if (height + room < -doubt) return false;
      return box.exteriorDistance(sphere.center + middle_) <= reach;
    };
    return tree_.any(may_hold, [&](std::uint32_t point) {
      return mesh::orientation(vertex(0), vertex(1), vertex(2), mesh_.points[point]) > 0 &&
             conflict(cell, point) >= 0;
    });
  }

  const mesh::TetMesh& mesh_;
  const CellLinks& links_;
  std::span<const double> weights_;
  const std::vector<PowerSphere>& spheres_;
  Vector3d middle_;
  PointTree tree_;
};

}  // namespace

PowerSphere power_sphere(const mesh::TetMesh& mesh, std::uint32_t cell,
                         std::span<const double> weights, const Vector3d& middle) {
  const mesh::Cell& c = mesh.cells[cell];
  PowerSphere sphere = within_bounds(solve<Interval>(mesh, c, weights, middle));
  double size = 0;
  for (const std::uint32_t v : c) size = std::max(size, (mesh.points[v] - middle).norm());
  // Good enough for the order of all but cells of nearly the same power.
  constexpr double kGoodEnough = 0x1p-40;
  if (sphere.center_error <= kGoodEnough * size &&
      sphere.constant_error <= kGoodEnough * size * size) {
    return sphere;
  }
  const Sphere<Exact> exact = solve<Exact>(mesh, c, weights, middle);
  const auto bounds = [](const Exact& x) { return Interval(CGAL::to_interval(x)); };
  return within_bounds({{bounds(exact.center[0]), bounds(exact.center[1]), bounds(exact.center[2])},
                        bounds(exact.constant)});
}

std::vector<std::vector<std::uint32_t>> group_by_power(const mesh::TetMesh& mesh,
                                                       std::span<const std::uint32_t> cells,
                                                       std::span<const double> weights,
                                                       const View& view) {
  std::vector<Exact> powers(cells.size());
  tbb::parallel_for(Range(0, cells.size(), 64), [&](const Range& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Vector3d origin = Vector3d::Zero();
      const Sphere<Exact> sphere = solve<Exact>(mesh, mesh.cells[cells[i]], weights, origin);
      if (view.parallel) {
        powers[i] = dot(sphere.center, minus<Exact>(view.direction, origin));
      } else {
        powers[i] = sphere.constant - Exact(2) * dot(sphere.center, minus<Exact>(view.eye, origin));
      }
    }
  });
  std::vector<std::size_t> order(cells.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return powers[a] > powers[b]; });
  std::vector<std::vector<std::uint32_t>> groups;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || powers[order[i]] != powers[order[i - 1]]) groups.emplace_back();
    groups.back().push_back(cells[order[i]]);
  }
  return groups;
}

Regularity check_regularity(const mesh::TetMesh& mesh, const CellLinks& links,
                            std::span<const double> weights,
                            const std::vector<PowerSphere>& spheres, const Vector3d& middle) {
  const Examination examination(mesh, links, weights, spheres, middle);
  std::mutex mutex;
  std::atomic<std::size_t> first = std::numeric_limits<std::size_t>::max();
  Regularity result;
  result.ties.assign(links.cells.size(), 0);
  tbb::parallel_for(Range(0, links.cells.size(), kGrain), [&](const Range& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      if (first.load(std::memory_order_relaxed) < i) return;
      const std::string found = examination.examine(i, result.ties[i]);
      if (found.empty()) continue;
      const std::lock_guard lock(mutex);
      if (i < first) {
        first = i;
        result.fault = found;
      }
      return;
    }
  });
  return result;
}

}  // namespace tetraglass::sort
