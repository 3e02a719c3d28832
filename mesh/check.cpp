#include "mesh/check.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <tbb/parallel_sort.h>

#include "mesh/adjacency.h"
#include "mesh/predicates.h"

namespace tetraglass::mesh {
namespace {

using Eigen::Vector3d;
using Range = tbb::blocked_range<std::size_t>;

constexpr std::size_t kGrain = 4096;

std::size_t count_not_finite(const double* values, std::size_t count) {
  return tbb::parallel_reduce(
      Range(0, count, kGrain), std::size_t{0},
      [&](const Range& range, std::size_t bad) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          bad += std::isfinite(values[i]) ? 0 : 1;
        }
        return bad;
      },
      std::plus<>());
}

std::size_t count_not_finite(const TetMesh& mesh) {
  static_assert(sizeof(Vector3d) == 3 * sizeof(double));
  std::size_t bad =
      mesh.points.empty() ? 0 : count_not_finite(mesh.points[0].data(), 3 * mesh.points.size());
  for (const Field& field : mesh.fields) {
    bad += count_not_finite(field.values.data(), field.values.size());
  }
  return bad;
}

// Disjoint sets that several threads unite at once (Anderson and Woll 1991, "Wait-free parallel
// algorithms for the union-find problem"): roots point to themselves, and only ever to smaller
// ones.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parents_(count) {
    tbb::parallel_for(Range(0, count, kGrain), [&](const Range& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        parents_[i].store(static_cast<std::uint32_t>(i), std::memory_order_relaxed);
      }
    });
  }

  void unite(std::uint32_t a, std::uint32_t b) {
    for (;;) {
      a = find(a);
      b = find(b);
      if (a == b) return;
      if (a < b) std::swap(a, b);
      std::uint32_t expected = a;
      if (parents_[a].compare_exchange_strong(expected, b)) return;
    }
  }

  [[nodiscard]] std::size_t count() const {
    return tbb::parallel_reduce(
        Range(0, parents_.size(), kGrain), std::size_t{0},
        [&](const Range& range, std::size_t roots) {
          for (std::size_t i = range.begin(); i != range.end(); ++i) {
            roots += parents_[i].load(std::memory_order_relaxed) == i ? 1 : 0;
          }
          return roots;
        },
        std::plus<>());
  }

 private:
  std::uint32_t find(std::uint32_t i) {
    for (;;) {
      std::uint32_t parent = parents_[i].load(std::memory_order_relaxed);
      const std::uint32_t grandparent = parents_[parent].load(std::memory_order_relaxed);
      if (parent == grandparent) return parent;
      parents_[i].compare_exchange_weak(parent, grandparent);  // halves the path; may fail
      i = grandparent;
    }
  }

  std::vector<std::atomic<std::uint32_t>> parents_;
};

std::size_t count_parts(const Adjacency& adjacency) {
  DisjointSets parts(adjacency.neighbors.size());
  tbb::parallel_for(Range(0, adjacency.neighbors.size(), kGrain), [&](const Range& range) {
    for (std::size_t cell = range.begin(); cell != range.end(); ++cell) {
      for (const std::uint32_t neighbor : adjacency.neighbors[cell]) {
        // A neighbour names the cell too: once is enough.
        if (neighbor < cell) parts.unite(static_cast<std::uint32_t>(cell), neighbor);
      }
    }
  });
  return parts.count();
}

struct Quality {
  double min_dihedral = 0;  // degrees
  double radius_ratio = 0;
};

// The smallest of the six angles between the faces: outward normals enclose its supplement. Sines
// come from cross products, which keep small angles accurate; the smallest angle in [0, pi] is that
// of the largest cotangent.
double smallest_dihedral(const std::array<Vector3d, 4>& unit_normals) {
  double best_cosine = -1;
  double best_sine = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      const double cosine = -unit_normals[i].dot(unit_normals[j]);
      const double sine = unit_normals[i].cross(unit_normals[j]).norm();
      if (cosine * best_sine >= best_cosine * sine) {
        best_cosine = cosine;
        best_sine = sine;
      }
    }
  }
  return std::atan2(best_sine, best_cosine) * 180 / std::numbers::pi;
}

// With p[0] at the origin, V the volume and A the area of all faces, the radii are 3 V / A and
// | a^2 b x c + b^2 c x a + c^2 a x b | / (12 V).
Quality quality_of(const std::array<Vector3d, 4>& p) {
  const std::array<Vector3d, 3> edges = {p[1] - p[0], p[2] - p[0], p[3] - p[0]};
  // Scaled to edges of about 1, products neither overflow nor underflow whatever the mesh's units.
  double longest = 0;
  for (const Vector3d& edge : edges) longest = std::max(longest, edge.cwiseAbs().maxCoeff());
  const Vector3d a = edges[0] / longest;
  const Vector3d b = edges[1] / longest;
  const Vector3d c = edges[2] / longest;
  std::array<Vector3d, 4> normals = {(b - a).cross(c - a), c.cross(b), a.cross(c), b.cross(a)};
  double area = 0;  // twice that of the faces
  for (Vector3d& normal : normals) {
    const double length = normal.norm();
    area += length;
    normal /= length;
  }
  const double volume = std::abs(a.dot(b.cross(c)));  // six times that of the cell
  const double around =
      (a.squaredNorm() * b.cross(c) + b.squaredNorm() * c.cross(a) + c.squaredNorm() * a.cross(b))
          .norm();
  return {smallest_dihedral(normals), std::min(1.0, 6 * volume * volume / (area * around))};
}

struct Shape {
  std::size_t not_finite = 0;
  std::size_t degenerate = 0;
  double min_angle = std::numeric_limits<double>::infinity();
  std::array<std::size_t, 18> histogram{};
  double min_ratio = std::numeric_limits<double>::infinity();
  std::array<std::size_t, 20> ratio_histogram{};

  void add(const Quality& quality) {
    min_angle = std::min(min_angle, quality.min_dihedral);
    ++histogram[std::min(static_cast<std::size_t>(quality.min_dihedral / 5), histogram.size() - 1)];
    min_ratio = std::min(min_ratio, quality.radius_ratio);
    ++ratio_histogram[std::min(static_cast<std::size_t>(quality.radius_ratio * 20),
                               ratio_histogram.size() - 1)];
  }
};

Shape examine_cells(const TetMesh& mesh) {
  return tbb::parallel_reduce(
      Range(0, mesh.cells.size(), kGrain), Shape{},
      [&](const Range& range, Shape shape) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          std::array<Vector3d, 4> p;
          bool finite = true;
          for (std::size_t v = 0; v < 4; ++v) {
            p[v] = mesh.points[mesh.cells[i][v]];
            finite = finite && p[v].allFinite();
          }
          if (!finite) {
            ++shape.not_finite;
            continue;
          }
          if (orientation(p[0], p[1], p[2], p[3]) == 0) {
            ++shape.degenerate;
            continue;
          }
          shape.add(quality_of(p));
        }
        return shape;
      },
      [](Shape a, const Shape& b) {
        a.not_finite += b.not_finite;
        a.degenerate += b.degenerate;
        a.min_angle = std::min(a.min_angle, b.min_angle);
        for (std::size_t i = 0; i < a.histogram.size(); ++i) a.histogram[i] += b.histogram[i];
        a.min_ratio = std::min(a.min_ratio, b.min_ratio);
        for (std::size_t i = 0; i < a.ratio_histogram.size(); ++i) {
          a.ratio_histogram[i] += b.ratio_histogram[i];
        }
        return a;
      });
}

using Triangle = std::array<std::uint32_t, 3>;

std::vector<Triangle> boundary_triangles(const TetMesh& mesh, const Adjacency& adjacency) {
  std::vector<Triangle> triangles;
  triangles.reserve(adjacency.boundary_faces);
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell) {
    for (std::size_t face = 0; face < 4; ++face) {
      if (adjacency.neighbors[cell][face] != kNoCell) continue;
      Triangle& triangle = triangles.emplace_back();
      for (std::size_t v = 0; v < 3; ++v) {
        triangle[v] = mesh.cells[cell][static_cast<std::size_t>(kFaceVertices[face][v])];
      }
    }
  }
  return triangles;
}

// One side of a boundary triangle: the edge low-high, and the triangle's third vertex.
struct Side {
  std::uint32_t low;
  std::uint32_t high;
  std::uint32_t triangle;
  std::uint32_t apex;
};

bool same_edge(const Side& a, const Side& b) {
  return a.low == b.low && a.high == b.high;
}

std::vector<Side> sorted_sides(const std::vector<Triangle>& triangles) {
  std::vector<Side> sides(3 * triangles.size());
  tbb::parallel_for(Range(0, triangles.size(), kGrain), [&](const Range& range) {
    for (std::size_t t = range.begin(); t != range.end(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [low, high] = std::minmax(triangles[t][i], triangles[t][(i + 1) % 3]);
        sides[3 * t + i] = {low, high, static_cast<std::uint32_t>(t), triangles[t][(i + 2) % 3]};
      }
    }
  });
  tbb::parallel_sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return sides;
}

// Whether the surface bends inwards or not at all at the common edge of two of its triangles.
bool convex_or_flat(const TetMesh& mesh, const Triangle& triangle, const Side& one,
                    const Side& other) {
  const auto& p = mesh.points;
  if (collinear(p[triangle[0]], p[triangle[1]], p[triangle[2]])) return false;
  // Seen from outside the triangle runs counter-clockwise, so that the inside has negative
  // orientation.
  const int side = orientation(p[triangle[0]], p[triangle[1]], p[triangle[2]], p[other.apex]);
  if (side != 0) return side < 0;
  return same_side_of_line(p[one.low], p[one.high], p[one.apex], p[other.apex]) < 0;  // else folded
}

// For a face-connected mesh without crowded faces, all coordinates finite.
bool is_convex(const TetMesh& mesh, const std::vector<Triangle>& triangles) {
  const std::vector<Side> sides = sorted_sides(triangles);
  // A closed surface has two sides at every edge; more or fewer break the pairing.
  for (std::size_t i = 0; i < sides.size(); i += 2) {
    if (i + 1 == sides.size() || !same_edge(sides[i], sides[i + 1])) return false;
    if (i + 2 < sides.size() && same_edge(sides[i], sides[i + 2])) return false;
  }
  DisjointSets surfaces(triangles.size());
  std::atomic<bool> convex = true;
  tbb::parallel_for(Range(0, sides.size() / 2, kGrain), [&](const Range& range) {
    for (std::size_t i = range.begin(); i != range.end() && convex; ++i) {
      const Side& one = sides[2 * i];
      const Side& other = sides[2 * i + 1];
      surfaces.unite(one.triangle, other.triangle);
      if (!convex_or_flat(mesh, triangles[one.triangle], one, other)) convex = false;
    }
  });
  if (!convex || surfaces.count() != 1) return false;
  // Genus 0 by Euler's formula; V - E + F also tells where two vertices of the surface are one.
  std::vector<bool> used(mesh.points.size());
  std::size_t vertices = 0;
  for (const Triangle& triangle : triangles) {
    for (const std::uint32_t v : triangle) {
      if (!used[v]) ++vertices;
      used[v] = true;
    }
  }
  return vertices + triangles.size() == sides.size() / 2 + 2;
}

std::uint32_t opposite_vertex(const Cell& cell, const Adjacency& adjacency, std::size_t index,
                              std::size_t neighbor) {
  for (std::size_t face = 0; face < 4; ++face) {
    if (adjacency.neighbors[index][face] == neighbor) return cell[face];
  }
  return cell[0];  // not reached: adjacency is mutual
}

bool has_volume(const TetMesh& mesh, const Cell& c) {
  const auto& p = mesh.points;
  return orientation(p[c[0]], p[c[1]], p[c[2]], p[c[3]]) > 0;
}

bool is_delaunay(const TetMesh& mesh, const Adjacency& adjacency) {
  std::atomic<bool> delaunay = true;
  tbb::parallel_for(Range(0, mesh.cells.size(), kGrain), [&](const Range& range) {
    const auto& p = mesh.points;
    for (std::size_t i = range.begin(); i != range.end() && delaunay; ++i) {
      const Cell& c = mesh.cells[i];
      if (!has_volume(mesh, c)) continue;
      for (const std::uint32_t neighbor : adjacency.neighbors[i]) {
        if (neighbor == kNoCell) continue;
        // Both sides of a face give the same answer: the first one with volume is asked.
        if (neighbor < i && has_volume(mesh, mesh.cells[neighbor])) continue;
        const std::uint32_t far = opposite_vertex(mesh.cells[neighbor], adjacency, neighbor, i);
        if (in_sphere(p[c[0]], p[c[1]], p[c[2]], p[c[3]], p[far]) > 0) delaunay = false;
      }
    }
  });
  return delaunay;
}

}  // namespace

Soundness check(const TetMesh& mesh) {
  Soundness result;
  const Adjacency adjacency = face_adjacency(mesh);
  result.boundary_faces = adjacency.boundary_faces;
  result.crowded_faces = adjacency.crowded_faces;
  result.nan_values = count_not_finite(mesh);
  const Shape shape = examine_cells(mesh);
  result.degenerate = shape.degenerate;
  result.dihedral_histogram = shape.histogram;
  result.min_dihedral_degrees = std::isfinite(shape.min_angle) ? shape.min_angle : 0;
  result.min_radius_ratio = std::isfinite(shape.min_ratio) ? shape.min_ratio : 0;
  result.radius_ratio_histogram = shape.ratio_histogram;
  result.parts = count_parts(adjacency);
  const bool whole = result.parts == 1 && result.crowded_faces == 0 && shape.not_finite == 0;
  result.convex = whole && is_convex(mesh, boundary_triangles(mesh, adjacency));
  result.delaunay = result.convex && is_delaunay(mesh, adjacency);
  return result;
}

}  // namespace tetraglass::mesh
