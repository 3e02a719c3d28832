#include "mesh/surface_fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include <Eigen/Geometry>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/LU>
#include <Eigen/SparseCore>
#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/adjacency.h"
#include "mesh/triangle_surface.h"
#include "mesh/triangle_tree.h"

namespace tetraglass::mesh {
namespace {

using Eigen::Vector3d;
using Matrix = Eigen::SparseMatrix<double>;

constexpr double kTolerance = 1e-8;
constexpr std::uint32_t kFixed = std::numeric_limits<std::uint32_t>::max();

/// A place on the surface: three of its points, and their weights.
struct SurfacePlace {
  std::array<std::uint32_t, 3> points{};
  std::array<double, 3> weights{};
};

/// The weights of the place in a triangle nearest to p.
std::array<double, 3> nearest_weights(const TriangleTree::Triangle& t, const Vector3d& p) {
  const Vector3d ab = t[1] - t[0];
  const Vector3d ac = t[2] - t[0];
  const Vector3d normal = ab.cross(ac);
  const double area = normal.squaredNorm();
  const double v = (p - t[0]).cross(ac).dot(normal) / area;
  const double w = ab.cross(p - t[0]).dot(normal) / area;
  if (v >= 0 && w >= 0 && v + w <= 1) return {1 - v - w, v, w};
  std::array<double, 3> best = {1, 0, 0};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const Vector3d edge = t[j] - t[i];
    const double s = std::clamp((p - t[i]).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    const double distance = (t[i] + s * edge - p).squaredNorm();
    if (!(distance < least)) continue;
    least = distance;
    best = {0, 0, 0};
    best[i] = 1 - s;
    best[j] = s;
  }
  return best;
}

/// Laplace's equation within a mesh, its boundary points given.
class Interior {
 public:
  explicit Interior(const TetMesh& mesh) : mesh_(mesh), unknown_(mesh.points.size(), 0) {
    const Adjacency adjacency = face_adjacency(mesh);
    for (std::size_t i = 0; i < mesh.cells.size(); ++i) {
      for (std::size_t face = 0; face < 4; ++face) {
        if (adjacency.neighbors[i][face] != kNoCell) continue;
        for (const int k : kFaceVertices[face]) {
          unknown_[mesh.cells[i][static_cast<std::size_t>(k)]] = kFixed;
        }
      }
    }
    std::uint32_t count = 0;
    for (std::uint32_t& u : unknown_) {
      if (u != kFixed) u = count++;
    }
    assemble(count);
  }

  [[nodiscard]] bool is_boundary(std::size_t point) const { return unknown_[point] == kFixed; }

  /// Fills in the values within; those at the boundary are given and finite.
  void solve(std::vector<double>& values, double guess) const {
    if (matrix_.rows() == 0) return;
    Eigen::VectorXd load = Eigen::VectorXd::Zero(matrix_.rows());
    for (const Coupling& c : couplings_) load[c.unknown] -= c.weight * values[c.point];
    Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper> solver;
    solver.setTolerance(kTolerance);
    solver.compute(matrix_);
    const Eigen::VectorXd solution =
        solver.solveWithGuess(load, Eigen::VectorXd::Constant(matrix_.rows(), guess));
    if (solver.info() != Eigen::Success) {
      throw base::InputError("the fields of the surface could not be continued into its inside");
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (unknown_[i] != kFixed) values[i] = solution[unknown_[i]];
    }
  }

 private:
  /// Between an unknown and a given value.
  struct Coupling {
    std::uint32_t unknown;
    std::uint32_t point;
    double weight;
  };

  void assemble(std::uint32_t count) {
    std::vector<Eigen::Triplet<double>> entries;
    for (const Cell& cell : mesh_.cells) {
      Eigen::Matrix3d edges;
      for (int i = 0; i < 3; ++i) {
        edges.row(i) = mesh_.points[cell[static_cast<std::size_t>(i) + 1]] - mesh_.points[cell[0]];
      }
      const double volume = edges.determinant();
      if (!(volume > 0)) continue;
      Eigen::Matrix<double, 3, 4> gradients;
      gradients.rightCols<3>() = edges.inverse();
      gradients.col(0) = -gradients.rightCols<3>().rowwise().sum();
      const Eigen::Matrix4d element = volume * gradients.transpose() * gradients;
      for (int i = 0; i < 4; ++i) {
        const std::uint32_t row = unknown_[cell[static_cast<std::size_t>(i)]];
        if (row == kFixed) continue;
        for (int j = 0; j < 4; ++j) {
          const std::uint32_t point = cell[static_cast<std::size_t>(j)];
          if (unknown_[point] == kFixed) {
            couplings_.push_back({row, point, element(i, j)});
          } else {
            entries.emplace_back(row, unknown_[point], element(i, j));
          }
        }
      }
    }
    matrix_.resize(count, count);
    matrix_.setFromTriplets(entries.begin(), entries.end());
  }

  const TetMesh& mesh_;
  std::vector<std::uint32_t> unknown_;  ///< number of each point in the system, or kFixed
  Matrix matrix_;
  std::vector<Coupling> couplings_;
};

/// Of each boundary point, its place on the surface.
std::vector<SurfacePlace> find_places(const TriangleSurface& surface, const TetMesh& mesh,
                                      const Interior& interior) {
  std::vector<TriangleTree::Triangle> triangles;
  for (const auto& t : surface.triangles) {
    triangles.push_back({surface.points[t[0]], surface.points[t[1]], surface.points[t[2]]});
  }
  const TriangleTree tree(triangles);
  std::vector<SurfacePlace> places(mesh.points.size());
  std::uint32_t nearest = 0;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    if (!interior.is_boundary(i)) continue;
    static_cast<void>(tree.squared_distance_to(mesh.points[i], nearest));
    const std::uint32_t t = tree.number(nearest);
    SurfacePlace& place = places[i];
    place.weights = nearest_weights(triangles[t], mesh.points[i]);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t corner = surface.triangles[t][k];
      place.points[k] = surface.sources[corner];
      if (surface.points[corner] == mesh.points[i]) {
        place.weights = {0, 0, 0};
        place.weights[k] = 1;
      }
    }
  }
  return places;
}

}  // namespace

void carry_surface_fields(const MeshData& surface, TetMesh& mesh, std::vector<std::string>& notes) {
  const bool any = std::ranges::any_of(
      surface.fields, [](const Field& field) { return field.location == Location::point; });
  if (!any) return;
  std::vector<std::string> told_already;
  const TriangleSurface triangles = collect_triangles(surface, told_already);
  const Interior interior(mesh);
  const std::vector<SurfacePlace> places = find_places(triangles, mesh, interior);
  for (const Field& field : surface.fields) {
    const auto n = static_cast<std::size_t>(field.components);
    if (field.location != Location::point || field.values.size() != n * surface.points.size()) {
      continue;
    }
    Field out{field.name, Location::point, field.components, {}};
    out.values.resize(n * mesh.points.size());
    for (std::size_t c = 0; c < n; ++c) {
      std::vector<double> given(mesh.points.size(), 0);
      double sum = 0;
      double count = 0;
      for (std::size_t i = 0; i < given.size(); ++i) {
        if (!interior.is_boundary(i)) continue;
        for (std::size_t k = 0; k < 3; ++k) {
          if (places[i].weights[k] == 0) continue;
          given[i] += places[i].weights[k] * field.values[n * places[i].points[k] + c];
        }
        if (!std::isfinite(given[i])) continue;
        sum += given[i];
        ++count;
      }
      const double mean = count > 0 ? sum / count : 0;
      std::vector<double> values = given;
      for (double& value : values) value = std::isfinite(value) ? value : mean;
      interior.solve(values, mean);
      for (std::size_t i = 0; i < values.size(); ++i) {
        out.values[n * i + c] = interior.is_boundary(i) ? given[i] : values[i];
      }
    }
    mesh.fields.push_back(std::move(out));
    notes.push_back(fmt::format(
        "field '{}' of the surface is continued into its inside (harmonic interpolation)",
        field.name));
  }
}

}  // namespace tetraglass::mesh
