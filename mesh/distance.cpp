#include "mesh/distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include "mesh/adjacency.h"

namespace tetraglass::mesh {
namespace {

using Eigen::Vector3d;

struct Triangle {
  Vector3d a, b, c;
  [[nodiscard]] Box box() const { return Box(a).extend(b).extend(c); }
};

double squared_distance_to_segment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d ab = b - a;
  const double length = ab.squaredNorm();
  const double t = length > 0 ? std::clamp((p - a).dot(ab) / length, 0.0, 1.0) : 0;
  return (p - (a + t * ab)).squaredNorm();
}

// The foot of the perpendicular if it lies inside, else the nearest point of the sides. The three
// sides are tried alike: it takes a little longer than to sort out the regions first, and it is
// right for triangles of no area as well.
double squared_distance(const Vector3d& p, const Triangle& t) {
  const Vector3d normal = (t.b - t.a).cross(t.c - t.a);
  const double area = normal.squaredNorm();
  const auto inside = [&](const Vector3d& from, const Vector3d& to) {
    return (to - from).cross(p - from).dot(normal) >= 0;
  };
  if (area > 0 && inside(t.a, t.b) && inside(t.b, t.c) && inside(t.c, t.a)) {
    const double height = (p - t.a).dot(normal);
    return height * height / area;
  }
  return std::min({squared_distance_to_segment(p, t.a, t.b),
                   squared_distance_to_segment(p, t.b, t.c),
                   squared_distance_to_segment(p, t.c, t.a)});
}

// A binary tree of boxes over triangles. The subtree of n triangles takes 2 n - 1 nodes at most:
// its root, then the left half's, then the right half's, so that both halves are built at once in
// place.
class Hierarchy {
 public:
  explicit Hierarchy(std::vector<Triangle> triangles)
      : triangles_(std::move(triangles)), nodes_(2 * triangles_.size()) {
    if (!triangles_.empty()) build(0, 0, triangles_.size());
  }

  // The squared distance of p to the nearest triangle. `nearest` is a guess, and then that
  // triangle.
  [[nodiscard]] double squared_distance_to(const Vector3d& p, std::uint32_t& nearest) const {
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

 private:
  static constexpr std::size_t kLeaf = 4;
  static constexpr std::size_t kParallel = 4096;

  struct Node {
    Box box;
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    std::uint32_t right = 0;  // 0 for a leaf; the left child follows its parent
  };

  void build(std::size_t index, std::size_t begin, std::size_t end) {
    Node& node = nodes_[index];
    node.begin = static_cast<std::uint32_t>(begin);
    node.end = static_cast<std::uint32_t>(end);
    for (std::size_t i = begin; i < end; ++i) node.box.extend(triangles_[i].box());
    if (end - begin <= kLeaf) return;
    Eigen::Index axis = 0;
    node.box.sizes().maxCoeff(&axis);
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) {
      return triangles_.begin() + static_cast<std::ptrdiff_t>(i);
    };
    std::nth_element(at(begin), at(middle), at(end), [&](const Triangle& s, const Triangle& t) {
      return s.a[axis] + s.b[axis] + s.c[axis] < t.a[axis] + t.b[axis] + t.c[axis];
    });
    const std::size_t right = index + 2 * (middle - begin);
    node.right = static_cast<std::uint32_t>(right);
    const auto left_half = [&] { build(index + 1, begin, middle); };
    const auto right_half = [&] { build(right, middle, end); };
    if (end - begin > kParallel) {
      tbb::parallel_invoke(left_half, right_half);
    } else {
      left_half();
      right_half();
    }
  }

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

enum class Place : std::uint8_t { unused, interior, boundary };

}  // namespace

std::vector<double> boundary_distance(const TetMesh& mesh) {
  const Adjacency adjacency = face_adjacency(mesh);
  std::vector<Place> places(mesh.points.size(), Place::unused);
  for (const Cell& cell : mesh.cells) {
    for (const std::uint32_t v : cell) {
      if (mesh.points[v].allFinite()) places[v] = Place::interior;
    }
  }
  std::vector<Triangle> triangles;
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell) {
    for (std::size_t face = 0; face < 4; ++face) {
      if (adjacency.neighbors[cell][face] != kNoCell) continue;
      std::array<Vector3d, 3> p;
      bool finite = true;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t v = mesh.cells[cell][static_cast<std::size_t>(kFaceVertices[face][i])];
        p[i] = mesh.points[v];
        finite = finite && p[i].allFinite();
        if (places[v] == Place::interior) places[v] = Place::boundary;
      }
      if (finite) triangles.push_back({p[0], p[1], p[2]});
    }
  }
  std::vector<double> distances(mesh.points.size(), 0);
  if (triangles.empty()) return distances;
  const Hierarchy hierarchy(std::move(triangles));
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, mesh.points.size(), 256), [&](const auto& range) {
        // Neighbouring indices are mostly neighbouring points: the last one's triangle is a good
        // guess.
        std::uint32_t nearest = 0;
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          if (places[i] != Place::interior) continue;
          distances[i] = std::sqrt(hierarchy.squared_distance_to(mesh.points[i], nearest));
        }
      });
  return distances;
}

}  // namespace tetraglass::mesh
