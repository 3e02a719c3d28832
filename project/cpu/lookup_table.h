#pragma once

#include <cstddef>
#include <vector>

#include "preint/table.h"
#include "project/plan.h"
#include "project/scene.h"
#include "project/value_scale.h"

namespace tetraglass::project::cpu {

/// The table of a plan that integrates by one, as the kernels look it up: over front and back
/// values, scaled, from -1 to 1 (table2d, table3d) or over optical extinctions k as k / (k + 1)
/// (psi).
struct LookupTable {
  /// `radius`: the unit of length (see Projection).
  LookupTable(const Scene& scene, const Plan& plan, const ValueScale& scale, double radius);

  [[nodiscard]] std::size_t bytes() const { return sizeof(float) * texels.size(); }

  Integrator integrator;
  int n = 0;              ///< samples of both values
  int m = 1;              ///< ... and of the length
  float most_length = 1;  ///< that of the last sample
  int channels = 4;       ///< neighbours in memory: red, green, blue and alpha, or psi alone
  preint::Entries texels;
};

}  // namespace tetraglass::project::cpu
