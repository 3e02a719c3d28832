#pragma once

#include "preint/ramped_table.h"
#include "preint/table.h"
#include "project/plan.h"
#include "project/scene.h"
#include "project/value_scale.h"

namespace tetraglass::project {

// The pre-integrated tables of a plan, over the range of the scene's field as `values` has it:
// front and back values run from -1 to 1, scaled. Lengths are in units of `radius`, and extinctions
// are bounded so that products of floats stay finite.

/// Of mode iso, mip, emission or absorption; in parallel (see emission_table).
[[nodiscard]] preint::Table2D integral_table_2d(const Scene& scene, const Plan& plan,
                                                const ValueScale& values, double radius);

/// Of mode full, for lengths up to the longest edge; in parallel (see full_table).
[[nodiscard]] preint::Table3D integral_table_3d(const Scene& scene, const Plan& plan,
                                                const ValueScale& values, double radius);

/// Of mode full, its light weighted towards either end of a segment; in parallel (see
/// ramped_tables_3d).
[[nodiscard]] preint::RampedTables3D ramped_integral_tables(const Scene& scene, const Plan& plan,
                                                            const ValueScale& values,
                                                            double radius);

/// Means of the materials, for n values and m lengths up to the longest edge; in parallel (see
/// material_table_3d).
[[nodiscard]] preint::Table3D integral_material_table(const Scene& scene, int n, int m,
                                                      const ValueScale& values, double radius);

}  // namespace tetraglass::project
