#include "mesh/triangle_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include <tbb/parallel_invoke.h>

namespace tetraglass::mesh {
namespace {

using Eigen::Vector3d;

double squared_distance_to_segment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d ab = b - a;
  const double length = ab.squaredNorm();
  const double t = length > 0 ? std::clamp((p - a).dot(ab) / length, 0.0, 1.0) : 0;
  return (p - (a + t * ab)).squaredNorm();
}

// The foot of the perpendicular if it lies inside, else the nearest point of the sides. The three
// sides are tried alike: it takes a little longer than to sort out the regions first, and it is
// right for triangles of no area as well.
double squared_distance(const Vector3d& p, const TriangleTree::Triangle& t) {
  const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double area = normal.squaredNorm();
  const auto inside = [&](const Vector3d& from, const Vector3d& to) {
    return (to - from).cross(p - from).dot(normal) >= 0;
  };
  if (area > 0 && inside(t[0], t[1]) && inside(t[1], t[2]) && inside(t[2], t[0])) {
    const double height = (p - t[0]).dot(normal);
    return height * height / area;
  }
  return std::min({squared_distance_to_segment(p, t[0], t[1]),
                   squared_distance_to_segment(p, t[1], t[2]),
                   squared_distance_to_segment(p, t[2], t[0])});
}

}  // namespace

TriangleTree::TriangleTree(std::vector<Triangle> triangles)
    : numbers_(triangles.size()), nodes_(2 * triangles.size()) {
  // The subtree of n triangles takes 2 n - 1 nodes at most: its root, then the left half's, then
  // the right half's, so that both halves are built at once in place.
  std::iota(numbers_.begin(), numbers_.end(), 0U);
  if (!triangles.empty()) build(0, 0, triangles.size(), triangles);
  triangles_.reserve(triangles.size());
  for (const std::uint32_t i : numbers_) triangles_.push_back(triangles[i]);
}

double TriangleTree::squared_distance_to(const Vector3d& p, std::uint32_t& nearest) const {
  struct Waiting {
    std::uint32_t node;
    double distance;
  };
  std::array<Waiting, 64> stack;  // the tree halves: its depth is at most 32
  std::size_t height = 0;
  double best = squared_distance(p, triangles_[nearest]);
  stack[height++] = {0, nodes_[0].box.squaredExteriorDistance(p)};
  while (height > 0) {
    const Waiting next = stack[--height];
    if (next.distance >= best) continue;
    const Node& node = nodes_[next.node];
    if (node.right == 0) {
      for (std::uint32_t i = node.begin; i < node.end; ++i) {
        const double distance = squared_distance(p, triangles_[i]);
        if (distance < best) nearest = i;
        best = std::min(best, distance);
      }
      continue;
    }
    Waiting near{next.node + 1, nodes_[next.node + 1].box.squaredExteriorDistance(p)};
    Waiting far{node.right, nodes_[node.right].box.squaredExteriorDistance(p)};
    if (far.distance < near.distance) std::swap(near, far);
    if (far.distance < best) stack[height++] = far;
    if (near.distance < best) stack[height++] = near;
  }
  return best;
}

void TriangleTree::build(std::size_t index, std::size_t begin, std::size_t end,
                         const std::vector<Triangle>& triangles) {
  Node& node = nodes_[index];
  node.begin = static_cast<std::uint32_t>(begin);
  node.end = static_cast<std::uint32_t>(end);
  for (std::size_t i = begin; i < end; ++i) {
    for (const Vector3d& p : triangles[numbers_[i]]) node.box.extend(p);
  }
  if (end - begin <= kLeaf) return;
  Eigen::Index axis = 0;
  node.box.sizes().maxCoeff(&axis);
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return numbers_.begin() + static_cast<std::ptrdiff_t>(i); };
  const auto key = [&](std::uint32_t i) {
    const Triangle& t = triangles[i];
    return t[0][axis] + t[1][axis] + t[2][axis];
  };
  std::nth_element(at(begin), at(middle), at(end),
                   [&](std::uint32_t s, std::uint32_t t) { return key(s) < key(t); });
  const std::size_t right = index + 2 * (middle - begin);
  node.right = static_cast<std::uint32_t>(right);
  const auto left_half = [&] { build(index + 1, begin, middle, triangles); };
  const auto right_half = [&] { build(right, middle, end, triangles); };
  if (end - begin > kParallel) {
    tbb::parallel_invoke(left_half, right_half);
  } else {
    left_half();
    right_half();
  }
}

}  // namespace tetraglass::mesh
