#include "mesh/self_intersection.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <Eigen/Geometry>

namespace tetraglass::mesh {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangle = std::array<std::uint32_t, 3>;

class FaultFinder {
 public:
  explicit FaultFinder(const TriangleSurface& surface) : surface_(surface) {
    points_.reserve(surface.points.size());
    for (const Eigen::Vector3d& p : surface.points) points_.emplace_back(p.x(), p.y(), p.z());
    boxes_.reserve(surface.triangles.size());
    for (const Triangle& t : surface.triangles) {
      Eigen::AlignedBox3d box;
      for (const std::uint32_t i : t) box.extend(surface.points[i]);
      boxes_.push_back(box);
      all_.extend(box);
    }
  }

  SurfaceFaults find() {
    flat_.resize(surface_.triangles.size(), false);
    for (std::size_t i = 0; i < surface_.triangles.size(); ++i) {
      const Triangle& t = surface_.triangles[i];
      if (!CGAL::collinear(points_[t[0]], points_[t[1]], points_[t[2]])) continue;
      flat_[i] = true;  // the tests of pairs are of true triangles
      ++faults_.flat;
      if (faults_.first_flat.size() < kFew) faults_.first_flat.push_back(i);
    }
    sweep();
    return faults_;
  }

 private:
  static constexpr std::size_t kFew = 3;

  void sweep() {
    if (boxes_.empty()) return;
    Eigen::Index axis = 0;
    all_.sizes().maxCoeff(&axis);
    std::vector<std::size_t> order(boxes_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return boxes_[i].min()[axis]; });
    for (std::size_t a = 0; a < order.size(); ++a) {
      const std::size_t i = order[a];
      for (std::size_t b = a + 1; b < order.size(); ++b) {
        const std::size_t j = order[b];
        if (boxes_[j].min()[axis] > boxes_[i].max()[axis]) break;
        if (flat_[i] || flat_[j] || !boxes_[i].intersects(boxes_[j])) continue;
        if (!meet(surface_.triangles[i], surface_.triangles[j])) continue;
        ++faults_.crossings;
        if (faults_.first_crossings.size() < kFew) {
          faults_.first_crossings.emplace_back(std::min(i, j), std::max(i, j));
        }
      }
    }
  }

  [[nodiscard]] Kernel::Triangle_3 triangle(const Triangle& t) const {
    return {points_[t[0]], points_[t[1]], points_[t[2]]};
  }

  /// Whether they meet elsewhere than in the corners that they share.
  [[nodiscard]] bool meet(const Triangle& s, const Triangle& t) const {
    // The corners, those that are shared first.
    Triangle a = s;
    Triangle b = t;
    std::size_t shared = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = shared; j < 3; ++j) {
        if (a[i] != b[j]) continue;
        std::swap(a[i], a[shared]);  // what stood there is not shared
        std::swap(b[j], b[shared]);
        ++shared;
        break;
      }
    }

    if (shared == 0) return CGAL::do_intersect(triangle(s), triangle(t));
    if (shared == 1) {
      // Two planes meet in a line through the common corner, so if the triangles share more of it,
      // the far edge of one reaches the other.
      return CGAL::do_intersect(edge(a), triangle(t)) || CGAL::do_intersect(edge(b), triangle(s));
    }
    if (shared == 2) {
      // They lie on each other only if they are in one plane, on the same side of the edge.
      return CGAL::coplanar(points_[a[0]], points_[a[1]], points_[a[2]], points_[b[2]]) &&
             CGAL::coplanar_orientation(points_[a[0]], points_[a[1]], points_[a[2]],
                                        points_[b[2]]) == CGAL::POSITIVE;
    }
    return true;  // one and the same
  }

  [[nodiscard]] Kernel::Segment_3 edge(const Triangle& t) const {
    return {points_[t[1]], points_[t[2]]};
  }

  const TriangleSurface& surface_;
  std::vector<Point> points_;
  std::vector<Eigen::AlignedBox3d> boxes_;
  Eigen::AlignedBox3d all_;
  std::vector<bool> flat_;
  SurfaceFaults faults_;
};

}  // namespace

SurfaceFaults find_faults(const TriangleSurface& surface) {
  return FaultFinder(surface).find();
}

}  // namespace tetraglass::mesh
