#pragma once

#include <optional>
#include <string>
#include <vector>

#include "project/gl_plan.h"
#include "project/scene.h"
#include "project/slices_plan.h"
#include "sort/cell_sorter.h"

namespace tetraglass::project {

enum class Projector {
  reference,
  gl,
  cpu,
  slices,          ///< the trilinear field of a grid, by textures
  grid_reference,  ///< ... exactly
};
using SortMethod = sort::Method;
enum class Integrator {
  exact,
  table2d,
  table3d,
  psi,    ///< partial pre-integration (Moreland and Angel, 2004)
  linear  ///< from the values at the ends of a segment alone, as most renderers do
};
enum class ContextKind { none, osmesa, egl };

/// What the user forced; what is not set is chosen by `plan`.
struct Request {
  std::optional<Projector> projector;
  std::optional<SortMethod> sort;
  std::optional<Integrator> integrator;
  std::optional<ContextKind> context;
  std::optional<double> opaque_at;  ///< in (0, 1]; mode full of the cpu projector
  int table_n = 0;                  ///< scalar resolution of the table, 0: chosen
  int table_m = 0;                  ///< length resolution of the 3D table, 0: chosen
  int light_map = 0;                ///< texels each way of cube maps of the lights, 0: none
  GlRequest gl;                     ///< for the gl projector only
  SlicesRequest slices;             ///< for the slices projector only
};

/// How a scene is drawn, and why.
struct Plan {
  Projector projector = Projector::gl;
  SortMethod sort = SortMethod::none;
  /// With mpvo: where cells hide each other in a ring, so that it is not exact, the frame is drawn
  /// by `fragments` (gl, layout indexed).
  bool fragments_in_cycles = false;
  Integrator integrator = Integrator::exact;
  ContextKind context = ContextKind::none;
  int table_n = 0;                   ///< 0: no table
  int table_m = 0;                   ///< 0: no length axis
  GlPlan gl;                         ///< for the gl projector only
  SlicesPlan slices;                 ///< for the slices projector only
  double opaque_at = 1;              ///< opacity at which a ray ends (cpu)
  bool gradients = false;            ///< of the field are computed, to light it
  int light_map = 0;                 ///< texels each way of cube maps of the lights; 0: none
  std::vector<std::string> reasons;  ///< one line per decision, for people
};

/// Chooses the way to draw the scene: by the cpu projector, which needs no GPU and is exact, where
/// it has what is asked for; else by gl. Pure: depends on nothing but its arguments. Throws
/// UsageError where the request contradicts the scene (unsorted `full`, a projector that lacks what
/// is asked for).
[[nodiscard]] Plan plan(const Scene& scene, const Request& request);

/// Whether the cells are put in order, as `sort` does it, before they are drawn.
[[nodiscard]] constexpr bool sorts_cells(const Plan& plan) {
  return plan.sort != SortMethod::none && plan.sort != SortMethod::fragments;
}

/// Whether the projector draws the trilinear field of a grid, not cells.
[[nodiscard]] constexpr bool draws_grid(Projector projector) {
  return projector == Projector::grid_reference || projector == Projector::slices;
}

[[nodiscard]] std::string to_string(Projector projector);
using sort::to_string;
[[nodiscard]] std::string to_string(Integrator integrator);
[[nodiscard]] std::string to_string(ContextKind context);

}  // namespace tetraglass::project
