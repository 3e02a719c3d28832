#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "mesh/tet_mesh.h"

namespace tetraglass::mesh {

/// What happens at a piece of the surface.
struct SurfaceCondition {
  double transfer = 0;  ///< heat transfer coefficient to the surroundings, W / (m^2 K), >= 0
  double flux = 0;      ///< heat that is brought in, W / m^2
};

/// A body of one material in surroundings of one temperature.
struct HeatProblem {
  double conductivity = 1;  ///< W / (m K), > 0
  double ambient = 0;       ///< temperature of the surroundings
  /// By the centroid of a boundary face. Some face must have a transfer > 0.
  std::function<SurfaceCondition(const Eigen::Vector3d&)> surface;
};

/// The steady temperature at the points of the mesh: linear finite elements (Galerkin), -k grad T .
/// n = h (T - T_ambient) - q on the boundary, solved by conjugate gradients. The heat brought in
/// equals the heat given off, up to the solver's tolerance (1e-12 relative). Points that no cell
/// uses have the ambient temperature; cells without volume do not conduct. Throws InputError where
/// the solver does not converge (no heat can leave some part of the body).
[[nodiscard]] std::vector<double> steady_temperature(const TetMesh& mesh,
                                                     const HeatProblem& problem);

}  // namespace tetraglass::mesh
