#include "sort/verify.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include <CGAL/Exact_rational.h>
#include <CGAL/Interval_nt.h>
#include <tbb/blocked_range.h>
#include <tbb/combinable.h>
#include <tbb/parallel_for.h>

#include "sort/eye_side.h"
#include "sort/fragments.h"

namespace tetraglass::sort {
namespace {

using Eigen::Vector3d;
using Range = tbb::blocked_range<std::size_t>;

constexpr std::uint32_t kNoPlace = 0xffffffffU;

// The place of each cell of the mesh in the order.
std::vector<std::uint32_t> places_of(const mesh::TetMesh& mesh,
                                     std::span<const std::uint32_t> order) {
  std::vector<std::uint32_t> places(mesh.cells.size(), kNoPlace);
  for (std::size_t i = 0; i < order.size(); ++i) places[order[i]] = static_cast<std::uint32_t>(i);
  return places;
}

bool has_volume(const mesh::TetMesh& mesh, std::uint32_t cell) {
  const mesh::Cell& c = mesh.cells[cell];
  for (const std::uint32_t v : c) {
    if (!mesh.points[v].allFinite()) return false;
  }
  return mesh::orientation(mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]],
                           mesh.points[c[3]]) > 0;
}

struct Ray {
  Vector3d origin;
  Vector3d direction;  // not of unit length
};

// The depth, along a ray, of where it crosses the plane of a face, and whether it enters there.
template <typename Number>
struct Crossing {
  Number above;  // the origin's height over the plane, outwards, not normalized
  Number climb;  // what the height gains per direction
};

template <typename Number>
Crossing<Number> crossing(const mesh::TetMesh& mesh, const mesh::Cell& cell,
                          const std::array<int, 3>& face, const Ray& ray) {
  const auto number = [](const Vector3d& v) {
    return std::array<Number, 3>{Number(v.x()), Number(v.y()), Number(v.z())};
  };
  const auto minus = [](const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
    return std::array<Number, 3>{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  };
  const auto dot = [](const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
    return Number(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
  };
  const auto vertex = [&](int i) {
    return number(mesh.points[cell[static_cast<std::size_t>(face[static_cast<std::size_t>(i)])]]);
  };
  const auto a = vertex(0);
  const auto u = minus(vertex(1), a);
  const auto v = minus(vertex(2), a);
  const std::array<Number, 3> normal = {Number(u[1] * v[2] - u[2] * v[1]),
                                        Number(u[2] * v[0] - u[0] * v[2]),
                                        Number(u[0] * v[1] - u[1] * v[0])};
  return {dot(normal, minus(number(ray.origin), a)), dot(normal, number(ray.direction))};
}

template <typename Number>
struct Piece {
  Number entry;
  Number exit;
};

// The piece of the ray in the cell, from the origin on unless the view is parallel; none if it has
// no length. With intervals the comparisons throw where they are undecided.
template <typename Number>
std::optional<Piece<Number>> clip(const mesh::TetMesh& mesh, const mesh::Cell& cell, const Ray& ray,
                                  bool from_origin) {
  std::optional<Number> entry;
  std::optional<Number> exit;
  if (from_origin) entry = Number(0);
  for (const auto& face : mesh::kFaceVertices) {
    const Crossing<Number> c = crossing<Number>(mesh, cell, face, ray);
    if (c.climb == Number(0)) {
      if (c.above >= Number(0)) return std::nullopt;
      continue;
    }
    const Number depth = -c.above / c.climb;
    if (c.climb > Number(0)) {
      if (!exit || depth < *exit) exit = depth;
    } else {
      if (!entry || depth > *entry) entry = depth;
    }
  }
  if (!entry || !exit || !(*entry < *exit)) return std::nullopt;
  return Piece<Number>{*entry, *exit};
}

using Interval = CGAL::Interval_nt<true>;
using Exact = CGAL::Exact_rational;

// Bounds of a piece of positive length: entry and exit lie in these intervals.
struct Met {
  std::uint32_t cell;
  std::uint32_t place;
  Piece<Interval> piece;
};

std::optional<Piece<Interval>> clip_within_bounds(const mesh::TetMesh& mesh, const mesh::Cell& cell,
                                                  const Ray& ray, bool from_origin) {
  try {
    return clip<Interval>(mesh, cell, ray, from_origin);
  } catch (const CGAL::Uncertain_conversion_exception&) {
    const auto exact = clip<Exact>(mesh, cell, ray, from_origin);
    if (!exact) return std::nullopt;
    return Piece<Interval>{Interval(CGAL::to_interval(exact->entry)),
                           Interval(CGAL::to_interval(exact->exit))};
  }
}

enum class Relation { first_is_nearer, second_is_nearer, overlap };

Relation relate_exactly(const mesh::TetMesh& mesh, const Met& a, const Met& b, const Ray& ray,
                        bool from_origin) {
  const auto exact_a = clip<Exact>(mesh, mesh.cells[a.cell], ray, from_origin);
  const auto exact_b = clip<Exact>(mesh, mesh.cells[b.cell], ray, from_origin);
  if (exact_a->exit <= exact_b->entry) return Relation::first_is_nearer;
  if (exact_b->exit <= exact_a->entry) return Relation::second_is_nearer;
  return Relation::overlap;
}

// Whether of two cells the nearer one is drawn first, or whether they overlap. If it is certain
// that `a` starts before `b` ends, `b` is not the nearer one, or they overlap: whichever it is,
// drawing `b` first is right. Only what may be wrong is decided exactly.
enum class Verdict { right, wrong, overlap };

Verdict judge(const mesh::TetMesh& mesh, const Met& a, const Met& b, const Ray& ray,
              bool from_origin) {
  const bool a_before_end = a.piece.entry.sup() < b.piece.exit.inf();
  const bool b_before_end = b.piece.entry.sup() < a.piece.exit.inf();
  if (a_before_end && b_before_end) return Verdict::overlap;
  const bool a_is_drawn_first = a.place < b.place;
  if (a_is_drawn_first ? b_before_end : a_before_end) return Verdict::right;
  const Relation relation = relate_exactly(mesh, a, b, ray, from_origin);
  if (relation == Relation::overlap) return Verdict::overlap;
  return (relation == Relation::first_is_nearer) == a_is_drawn_first ? Verdict::wrong
                                                                     : Verdict::right;
}

// Balls around cells, for the first look at a ray. In float, enlarged by more than the roundings.
class Balls {
 public:
  Balls(const mesh::TetMesh& mesh, std::span<const std::uint32_t> cells)
      : origin_(mesh::bounds(mesh).center()) {
    const std::size_t n = cells.size();
    for (auto* numbers : {&x_, &y_, &z_, &radius_}) numbers->resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      const mesh::Cell& c = mesh.cells[cells[i]];
      Vector3d center = Vector3d::Zero();
      for (const std::uint32_t v : c) center += 0.25 * (mesh.points[v] - origin_);
      double radius = 0;
      for (const std::uint32_t v : c) {
        radius = std::max(radius, (mesh.points[v] - origin_ - center).norm());
      }
      x_[i] = static_cast<float>(center.x());
      y_[i] = static_cast<float>(center.y());
      z_[i] = static_cast<float>(center.z());
      // Each float coordinate is off by 2^-24 of itself at most; the distance from the line is
      // computed below from some ten such roundings of lengths up to |center| + |nearest|, of which
      // the caller adds the second part.
      radius_[i] = static_cast<float>(radius * (1 + 0x1p-20) + 0x1p-19 * center.norm());
    }
  }

  // Calls f(i) for each ball that the line may meet.
  template <typename F>
  void for_each_near(const Ray& ray, const F& f) const {
    const Vector3d direction = ray.direction.normalized();
    const Vector3d start = ray.origin - origin_;
    // The line's point nearest to the middle of the mesh keeps the numbers as small as can be. A
    // far origin leaves it off by some roundings of its own distance.
    const Vector3d nearest = start - start.dot(direction) * direction;
    const auto slack = static_cast<float>(0x1p-19 * nearest.norm() + 0x1p-49 * start.norm());
    const Eigen::Vector3f d = direction.cast<float>();
    const Eigen::Vector3f p = nearest.cast<float>();
    constexpr std::size_t kBlock = 256;
    std::array<unsigned char, kBlock> near{};
    for (std::size_t begin = 0; begin < x_.size(); begin += kBlock) {
      const std::size_t count = std::min(kBlock, x_.size() - begin);
      unsigned char any = 0;
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t i = begin + k;
        const float x = x_[i] - p.x();
        const float y = y_[i] - p.y();
        const float z = z_[i] - p.z();
        const float cx = y * d.z() - z * d.y();
        const float cy = z * d.x() - x * d.z();
        const float cz = x * d.y() - y * d.x();
        const float reach = radius_[i] + slack;
        near[k] = static_cast<unsigned char>(!(cx * cx + cy * cy + cz * cz > reach * reach));
        any |= near[k];
      }
      if (any == 0) continue;
      for (std::size_t k = 0; k < count; ++k) {
        if (near[k] != 0) f(begin + k);
      }
    }
  }

 private:
  Vector3d origin_;
  std::vector<float> x_;
  std::vector<float> y_;
  std::vector<float> z_;
  std::vector<float> radius_;
};

std::vector<Ray> random_rays(const mesh::TetMesh& mesh, std::span<const std::uint32_t> cells,
                             const View& view, std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  // Not the library's distributions: their values differ between implementations.
  const auto unit = [&] { return (random() + 0.5) * 0x1p-32; };
  std::vector<Ray> rays;
  rays.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const mesh::Cell& cell = mesh.cells[cells[random() % cells.size()]];
    Eigen::Vector4d weights;
    for (int k = 0; k < 4; ++k) weights[k] = -std::log(unit());
    weights /= weights.sum();
    Vector3d target = Vector3d::Zero();
    for (int k = 0; k < 4; ++k)
      target += weights[k] * mesh.points[cell[static_cast<std::size_t>(k)]];
    rays.push_back(view.parallel ? Ray{target, view.direction} : Ray{view.eye, target - view.eye});
    if (rays.back().direction.isZero(0)) rays.back().direction = Vector3d(unit(), unit(), unit());
  }
  return rays;
}

}  // namespace

FaceCheck check_faces(const mesh::TetMesh& mesh, const CellLinks& links,
                      std::span<const std::uint32_t> order, const View& view) {
  const std::vector<std::uint32_t> places = places_of(mesh, order);
  std::atomic<std::size_t> faces = 0;
  std::atomic<std::size_t> wrong = 0;
  tbb::parallel_for(Range(0, links.cells.size(), 4096), [&](const Range& range) {
    std::size_t my_faces = 0;
    std::size_t my_wrong = 0;
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const std::uint32_t cell = links.cells[i];
      if (places[cell] == kNoPlace) continue;
      for (std::size_t face = 0; face < 4; ++face) {
        const std::uint32_t neighbor = links.adjacency.neighbors[cell][face];
        if (neighbor == mesh::kNoCell || neighbor < cell || places[neighbor] == kNoPlace) continue;
        const auto vertex = [&](std::size_t k) -> const Vector3d& {
          return mesh
              .points[mesh.cells[cell][static_cast<std::size_t>(mesh::kFaceVertices[face][k])]];
        };
        const int side = eye_side(view, vertex(0), vertex(1), vertex(2));
        if (side == 0) continue;
        ++my_faces;
        // Outside of this face, the eye is on the neighbour's side: this cell is the farther one.
        if ((side > 0) != (places[cell] < places[neighbor])) ++my_wrong;
      }
    }
    faces += my_faces;
    wrong += my_wrong;
  });
  return {faces, wrong};
}

namespace {

// Checks random rays; `number(met)` gives each cell that a ray meets its place in the order.
template <typename NumberPlaces>
RayCheck check_random_rays(const mesh::TetMesh& mesh, std::vector<std::uint32_t> cells,
                           const View& view, std::size_t count, std::uint32_t seed,
                           const NumberPlaces& number) {
  RayCheck check;
  std::erase_if(cells, [&](std::uint32_t cell) { return !has_volume(mesh, cell); });
  if (cells.empty()) return check;
  // In the order of the mesh: which rays are drawn must not depend on the order to check.
  std::sort(cells.begin(), cells.end());
  const Balls balls(mesh, cells);
  const std::vector<Ray> rays = random_rays(mesh, cells, view, count, seed);
  tbb::combinable<RayCheck> sums;
  tbb::parallel_for(Range(0, rays.size(), 1), [&](const Range& range) {
    RayCheck& mine = sums.local();
    std::vector<Met> met;
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Ray& ray = rays[i];
      met.clear();
      balls.for_each_near(ray, [&](std::size_t k) {
        const auto piece = clip_within_bounds(mesh, mesh.cells[cells[k]], ray, !view.parallel);
        if (piece) met.push_back({cells[k], 0, *piece});
      });
      number(met);
      bool wrong = false;
      bool overlapping = false;
      for (std::size_t a = 0; a < met.size(); ++a) {
        for (std::size_t b = a + 1; b < met.size(); ++b) {
          const Verdict verdict = judge(mesh, met[a], met[b], ray, !view.parallel);
          wrong |= verdict == Verdict::wrong;
          overlapping |= verdict == Verdict::overlap;
        }
      }
      ++mine.rays;
      mine.pieces += met.size();
      if (wrong) ++mine.wrong;
      if (overlapping) ++mine.overlapping;
    }
  });
  sums.combine_each([&](const RayCheck& part) {
    check.rays += part.rays;
    check.wrong += part.wrong;
    check.overlapping += part.overlapping;
    check.pieces += part.pieces;
  });
  return check;
}

}  // namespace

RayCheck check_rays(const mesh::TetMesh& mesh, std::span<const std::uint32_t> order,
                    const View& view, std::size_t count, std::uint32_t seed) {
  const std::vector<std::uint32_t> places = places_of(mesh, order);
  return check_random_rays(mesh, {order.begin(), order.end()}, view, count, seed,
                           [&](std::vector<Met>& met) {
                             for (Met& m : met) m.place = places[m.cell];
                           });
}

RayCheck check_fragments(const mesh::TetMesh& mesh, std::span<const std::uint32_t> cells,
                         const View& view, std::size_t count, std::uint32_t seed) {
  return check_random_rays(
      mesh, {cells.begin(), cells.end()}, view, count, seed, [](std::vector<Met>& met) {
        const auto middle = [](const Interval& i) { return 0.5 * (i.inf() + i.sup()); };
        std::vector<Met> spare = met;
        sort_fragments(std::span(met), std::span(spare),
                       [&](const Met& m) { return middle(m.piece.entry) + middle(m.piece.exit); });
        // Nearest first; places count from the farthest.
        for (std::size_t i = 0; i < met.size(); ++i) {
          met[i].place = static_cast<std::uint32_t>(met.size() - i);
        }
      });
}

}  // namespace tetraglass::sort
