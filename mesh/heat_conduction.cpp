#include "mesh/heat_conduction.h"

#include <array>
#include <string>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include "base/errors.h"
#include "mesh/adjacency.h"

namespace tetraglass::mesh {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Triplet = Eigen::Triplet<double>;

constexpr double kTolerance = 1e-12;

/// int k grad phi_i . grad phi_j over the cell.
void add_conduction(const TetMesh& mesh, const Cell& cell, double conductivity,
                    std::vector<Triplet>& entries) {
  Eigen::Matrix3d edges;
  for (int i = 0; i < 3; ++i) {
    edges.row(i) = mesh.points[cell[static_cast<std::size_t>(i) + 1]] - mesh.points[cell[0]];
  }
  const double six_volumes = edges.determinant();
  if (!(six_volumes > 0)) return;
  // The gradient of the i-th barycentric coordinate is the i-th column of the inverse; together
  // they sum to zero.
  Eigen::Matrix<double, 3, 4> gradients;
  gradients.rightCols<3>() = edges.inverse();
  gradients.col(0) = -gradients.rightCols<3>().rowwise().sum();
  const Eigen::Matrix4d element =
      conductivity * six_volumes / 6 * gradients.transpose() * gradients;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      entries.emplace_back(cell[static_cast<std::size_t>(i)], cell[static_cast<std::size_t>(j)],
                           element(i, j));
    }
  }
}

/// int h phi_i phi_j and int (h T_ambient + q) phi_i over the face. Returns int h.
double add_surface(const TetMesh& mesh, const std::array<std::uint32_t, 3>& face,
                   const HeatProblem& problem, std::vector<Triplet>& entries,
                   Eigen::VectorXd& load) {
  const Eigen::Vector3d& a = mesh.points[face[0]];
  const Eigen::Vector3d& b = mesh.points[face[1]];
  const Eigen::Vector3d& c = mesh.points[face[2]];
  const double area = (b - a).cross(c - a).norm() / 2;
  const SurfaceCondition condition = problem.surface((a + b + c) / 3);
  for (const std::uint32_t i : face) {
    load[i] += area / 3 * (condition.transfer * problem.ambient + condition.flux);
    for (const std::uint32_t j : face)
      entries.emplace_back(i, j, condition.transfer * area / (i == j ? 6 : 12));
  }
  return condition.transfer * area;
}

}  // namespace

std::vector<double> steady_temperature(const TetMesh& mesh, const HeatProblem& problem) {
  const auto n = static_cast<Eigen::Index>(mesh.points.size());
  std::vector<Triplet> entries;
  Eigen::VectorXd load = Eigen::VectorXd::Zero(n);
  const Adjacency adjacency = face_adjacency(mesh);
  double total_transfer = 0;
  for (std::size_t i = 0; i < mesh.cells.size(); ++i) {
    add_conduction(mesh, mesh.cells[i], problem.conductivity, entries);
    for (std::size_t face = 0; face < 4; ++face) {
      if (adjacency.neighbors[i][face] != kNoCell) continue;
      std::array<std::uint32_t, 3> points{};
      for (std::size_t k = 0; k < 3; ++k) {
        points[k] = mesh.cells[i][static_cast<std::size_t>(kFaceVertices[face][k])];
      }
      total_transfer += add_surface(mesh, points, problem, entries, load);
    }
  }
  const std::string unsettled =
      "the temperature does not settle: heat must be able to leave every part of the body";
  if (!(total_transfer > 0)) throw base::InputError(unsettled);
  Matrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  for (Eigen::Index i = 0; i < n; ++i) {
    if (matrix.coeff(i, i) > 0) continue;  // a point that nothing is connected to
    matrix.coeffRef(i, i) = 1;
    load[i] = problem.ambient;
  }
  Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper,
                           Eigen::DiagonalPreconditioner<double>>
      solver;
  solver.setTolerance(kTolerance);
  solver.compute(matrix);
  const Eigen::VectorXd temperature =
      solver.solveWithGuess(load, Eigen::VectorXd::Constant(n, problem.ambient));
  if (solver.info() != Eigen::Success || !temperature.allFinite()) {
    throw base::InputError(unsettled);
  }
  return {temperature.data(), temperature.data() + n};
}

}  // namespace tetraglass::mesh
