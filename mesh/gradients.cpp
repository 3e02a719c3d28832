#include "mesh/gradients.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <Eigen/QR>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "mesh/predicates.h"

namespace tetraglass::mesh {
namespace {

using Eigen::Vector3d;
using Range = tbb::blocked_range<std::size_t>;

constexpr std::size_t kGrain = 4096;

// A gradient multiplied by six times the volume of its cell. The product needs no division, so that
// it stays accurate, and small, in cells of hardly any volume.
struct Weighted {
  Vector3d gradient = Vector3d::Zero();
  double weight = 0;
};

// The gradient of s in a cell is sum_i (s_i - s_0) n_i / (6 V), with n_i the inward normal, twice
// as long as the area, of the face opposite vertex i.
Weighted weighted_gradient(const TetMesh& mesh, const std::vector<double>& values,
                           const Cell& cell) {
  const Vector3d& origin = mesh.points[cell[0]];
  const Vector3d a = mesh.points[cell[1]] - origin;
  const Vector3d b = mesh.points[cell[2]] - origin;
  const Vector3d c = mesh.points[cell[3]] - origin;
  const double s = values[cell[0]];
  const Vector3d bc = b.cross(c);
  return {(values[cell[1]] - s) * bc + (values[cell[2]] - s) * c.cross(a) +
              (values[cell[3]] - s) * a.cross(b),
          a.dot(bc)};
}

// Whether a cell has a gradient: finite values and coordinates, and a volume.
bool has_gradient(const TetMesh& mesh, const std::vector<double>& values, const Cell& cell) {
  for (const std::uint32_t v : cell) {
    if (!std::isfinite(values[v]) || !mesh.points[v].allFinite()) return false;
  }
  return orientation(mesh.points[cell[0]], mesh.points[cell[1]], mesh.points[cell[2]],
                     mesh.points[cell[3]]) != 0;
}

// The cells around each point: cells[begins[p] .. begins[p + 1]), in increasing order.
struct Incidence {
  std::vector<std::size_t> begins;
  std::vector<std::uint32_t> cells;
};

Incidence cells_around_points(const TetMesh& mesh) {
  std::vector<std::atomic<std::uint32_t>> counts(mesh.points.size());
  const auto for_each_corner = [&](const auto& f) {
    tbb::parallel_for(Range(0, mesh.cells.size(), kGrain), [&](const Range& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        for (const std::uint32_t v : mesh.cells[i]) f(v, static_cast<std::uint32_t>(i));
      }
    });
  };
  for_each_corner(
      [&](std::uint32_t v, std::uint32_t) { counts[v].fetch_add(1, std::memory_order_relaxed); });
  Incidence result;
  result.begins.resize(mesh.points.size() + 1, 0);
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    result.begins[p + 1] = result.begins[p] + counts[p].load(std::memory_order_relaxed);
  }
  result.cells.resize(result.begins.back());
  for_each_corner([&](std::uint32_t v, std::uint32_t cell) {
    const std::uint32_t left = counts[v].fetch_sub(1, std::memory_order_relaxed);
    result.cells[result.begins[v] + left - 1] = cell;
  });
  // The threads came in any order; the sums below must not depend on it.
  tbb::parallel_for(Range(0, mesh.points.size(), kGrain), [&](const Range& range) {
    for (std::size_t p = range.begin(); p != range.end(); ++p) {
      std::sort(result.cells.begin() + static_cast<std::ptrdiff_t>(result.begins[p]),
                result.cells.begin() + static_cast<std::ptrdiff_t>(result.begins[p + 1]));
    }
  });
  return result;
}

// The gradient at point p that fits the differences to its neighbours best.
Vector3d fit_gradient(const TetMesh& mesh, const std::vector<double>& values, std::uint32_t p,
                      const std::vector<std::uint32_t>& neighbors) {
  if (neighbors.empty()) return Vector3d::Zero();
  Eigen::Matrix<double, Eigen::Dynamic, 3> directions(neighbors.size(), 3);
  Eigen::VectorXd slopes(neighbors.size());
  Eigen::Index rows = 0;
  double farthest = 0;
  for (const std::uint32_t q : neighbors) {
    farthest = std::max(farthest, (mesh.points[q] - mesh.points[p]).stableNorm());
  }
  // Nearer ones, of slivers, count less: over so short a way the rounding of values is magnified.
  constexpr double kNearest = 1e-3;
  for (const std::uint32_t q : neighbors) {
    const Vector3d difference = mesh.points[q] - mesh.points[p];
    const double distance = std::max(difference.stableNorm(), kNearest * farthest);
    if (!(distance > 0) || q == p) continue;
    directions.row(rows) = difference / distance;
    slopes[rows++] = (values[q] - values[p]) / distance;
  }
  if (rows == 0) return Vector3d::Zero();
  return directions.topRows(rows).completeOrthogonalDecomposition().solve(slopes.head(rows));
}

}  // namespace

std::vector<Vector3d> cell_gradients(const TetMesh& mesh, const ScalarField& field) {
  std::vector<Vector3d> gradients(mesh.cells.size(), Vector3d::Zero());
  if (field.location == Location::cell) return gradients;
  tbb::parallel_for(Range(0, mesh.cells.size(), kGrain), [&](const Range& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Cell& cell = mesh.cells[i];
      if (!has_gradient(mesh, field.values, cell)) continue;
      const Weighted w = weighted_gradient(mesh, field.values, cell);
      const Vector3d gradient = w.gradient / w.weight;
      if (gradient.allFinite()) gradients[i] = gradient;  // else the volume underflows
    }
  });
  return gradients;
}

std::vector<Vector3d> vertex_gradients(const TetMesh& mesh, const ScalarField& field) {
  std::vector<Vector3d> gradients(mesh.points.size(), Vector3d::Zero());
  if (field.location == Location::cell) return gradients;
  std::vector<Weighted> weighted(mesh.cells.size());
  tbb::parallel_for(Range(0, mesh.cells.size(), kGrain), [&](const Range& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Cell& cell = mesh.cells[i];
      if (!has_gradient(mesh, field.values, cell)) continue;
      const Weighted w = weighted_gradient(mesh, field.values, cell);
      if (w.gradient.allFinite() && std::isfinite(w.weight)) weighted[i] = w;  // else: overflow
    }
  });
  const Incidence around = cells_around_points(mesh);
  tbb::parallel_for(Range(0, mesh.points.size(), kGrain), [&](const Range& range) {
    for (std::size_t p = range.begin(); p != range.end(); ++p) {
      Weighted sum;
      for (std::size_t i = around.begins[p]; i < around.begins[p + 1]; ++i) {
        sum.gradient += weighted[around.cells[i]].gradient;
        sum.weight += weighted[around.cells[i]].weight;
      }
      const Vector3d gradient = sum.gradient / sum.weight;
      if (gradient.allFinite()) gradients[p] = gradient;
    }
  });
  return gradients;
}

std::vector<Vector3d> least_squares_gradients(const TetMesh& mesh, const ScalarField& field) {
  std::vector<Vector3d> gradients(mesh.points.size(), Vector3d::Zero());
  if (field.location == Location::cell) return gradients;
  std::vector<char> usable(mesh.cells.size());
  tbb::parallel_for(Range(0, mesh.cells.size(), kGrain), [&](const Range& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      usable[i] = has_gradient(mesh, field.values, mesh.cells[i]) ? 1 : 0;
    }
  });
  const Incidence around = cells_around_points(mesh);
  constexpr std::size_t kPointGrain = 256;
  tbb::parallel_for(Range(0, mesh.points.size(), kPointGrain), [&](const Range& range) {
    std::vector<std::uint32_t> neighbors;
    for (std::size_t p = range.begin(); p != range.end(); ++p) {
      neighbors.clear();
      for (std::size_t i = around.begins[p]; i < around.begins[p + 1]; ++i) {
        if (usable[around.cells[i]] == 0) continue;
        const Cell& cell = mesh.cells[around.cells[i]];
        neighbors.insert(neighbors.end(), cell.begin(), cell.end());
      }
      std::sort(neighbors.begin(), neighbors.end());
      neighbors.erase(std::unique(neighbors.begin(), neighbors.end()), neighbors.end());
      const Vector3d gradient =
          fit_gradient(mesh, field.values, static_cast<std::uint32_t>(p), neighbors);
      if (gradient.allFinite()) gradients[p] = gradient;
    }
  });
  return gradients;
}

}  // namespace tetraglass::mesh
