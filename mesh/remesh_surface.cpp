#include "base/errors.h"
#include "mesh/tetrahedralize.h"

#ifdef TETRAGLASS_WITH_CGAL

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polyhedral_mesh_domain_with_features_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/make_mesh_3.h>
#include <fmt/format.h>

#include "mesh/mesh_complex-inl.h"
#include "mesh/self_intersection.h"
#include "mesh/surface_diagnosis.h"
#include "mesh/triangle_surface.h"

namespace tetraglass::mesh {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Polyhedron = CGAL::Surface_mesh<Kernel::Point_3>;
using Domain = CGAL::Polyhedral_mesh_domain_with_features_3<Kernel, Polyhedron>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation, Domain::Corner_index,
                                                        Domain::Curve_index>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

/// Processor time that Mesh_3 may take.
constexpr unsigned kMostSeconds = 600;
constexpr double kFacetAngle = 25;  ///< degrees; Mesh_3 ends for up to 30 (Jamin et al. 2015)

Polyhedron polyhedron_of(const TriangleSurface& surface) {
  Polyhedron polyhedron;
  for (const Eigen::Vector3d& p : surface.points) {
    polyhedron.add_vertex(Kernel::Point_3(p.x(), p.y(), p.z()));
  }
  for (const auto& t : surface.triangles) {
    const auto face =
        polyhedron.add_face(Polyhedron::Vertex_index(t[0]), Polyhedron::Vertex_index(t[1]),
                            Polyhedron::Vertex_index(t[2]));
    if (face == Polyhedron::null_face()) {
      throw base::InputError(
          "the surface is not a manifold: edges of more than two triangles, or points where "
          "sheets meet; --repair mends that, and TetGen can fill it");
    }
  }
  return polyhedron;
}

std::string refined(const Polyhedron& polyhedron, double volume_of_cell, double ratio) {
  const auto tell = [](const char* stage) { std::puts(stage); };
  tell("sharp edges");
  Domain domain(polyhedron);
  domain.detect_features();
  const MeshCriteriaSizes sizes(volume_of_cell);
  namespace parameters = CGAL::parameters;
  const Criteria criteria(
      parameters::edge_size = sizes.edge, parameters::facet_angle = kFacetAngle,
      parameters::facet_size = sizes.circumradius, parameters::facet_distance = sizes.distance,
      parameters::cell_radius_edge_ratio = ratio, parameters::cell_size = sizes.circumradius);
  tell("refinement");
  Complex complex = CGAL::make_mesh_3<Complex>(domain, criteria, parameters::no_exude(),
                                               parameters::no_perturb());
  tell("slivers");
  CGAL::exude_mesh_3(complex);
  return complex_parcel(complex);
}

}  // namespace

TetMesh remesh_surface(const MeshData& data, std::vector<std::string>& notes,
                       const FillOptions& options) {
  if (!options.holes.empty() || options.keep_surface || options.min_dihedral > 0) {
    throw base::InputError(
        "places of holes, keeping the surface and a smallest dihedral angle are for TetGen");
  }
  const TriangleSurface surface = triangle_surface(data, notes);
  const SurfaceFaults faults = find_faults(surface);
  if (faults.flat + faults.crossings > 0) {
    throw base::InputError(describe(surface, diagnose(surface)));
  }
  const double volume = std::abs(enclosed_volume(surface));
  if (!(volume > 0)) throw base::InputError("the surface encloses no volume");
  const double cell = options.max_volume > 0
                          ? options.max_volume / std::pow(MeshCriteriaSizes::kLargest, 3)
                          : volume / options.cells;
  const Polyhedron polyhedron = polyhedron_of(surface);
  const Apart apart = run_apart(
      [&] { return refined(polyhedron, cell, options.radius_edge_ratio); }, kMostSeconds, "CGAL");
  TetMesh mesh = mesh_of_parcel(apart, false);
  if (mesh.cells.empty())
    throw base::InputError("CGAL's Mesh_3 has found no volume in the surface");
  notes.push_back(fmt::format(
      "{} triangles in {} shells, meshed anew by CGAL with {} points; facets lie within about "
      "{:.3g} of the surface",
      surface.triangles.size(), surface.shells.size(), mesh.points.size(),
      MeshCriteriaSizes(cell).distance));
  return mesh;
}

}  // namespace tetraglass::mesh

#else

namespace tetraglass::mesh {

TetMesh remesh_surface(const MeshData& /*data*/, std::vector<std::string>& /*notes*/,
                       const FillOptions& /*options*/) {
  throw base::UnavailableError(
      "meshing a surface anew needs CGAL's Mesh_3, which this build lacks (TETRAGLASS_WITH_CGAL)");
}

}  // namespace tetraglass::mesh

#endif
