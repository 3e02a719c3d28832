#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/self_intersection.h"
#include "mesh/triangle_surface.h"

namespace tetraglass::mesh {

/// What keeps a surface from being filled, and what it is made of.
struct SurfaceDiagnosis {
  using Edge = std::array<std::uint32_t, 2>;  ///< two points of the surface

  std::size_t parts = 0;  ///< pieces that hang together by edges
  std::size_t edges = 0;
  std::size_t open_edges = 0;  ///< with one triangle only
  std::vector<Edge> first_open;
  std::size_t crowded_edges = 0;  ///< with more than two triangles: not a manifold there
  std::vector<Edge> first_crowded;
  std::size_t disagreeing_edges = 0;  ///< with two triangles that run the same way along them
  SurfaceFaults faults;
};

/// Examines the triangles of any surface. Cost: that of find_faults.
[[nodiscard]] SurfaceDiagnosis diagnose(const TriangleSurface& surface);

/// One line: what is wrong first, then the other counts, each with a few of the places. Points and
/// triangles are numbered as the data's points and cells, from 0.
[[nodiscard]] std::string describe(const TriangleSurface& surface,
                                   const SurfaceDiagnosis& diagnosis);

}  // namespace tetraglass::mesh
