#include "project/cpu/lookup_table.h"

#include <utility>

#include "preint/psi_table.h"
#include "project/integral_tables.h"

namespace tetraglass::project::cpu {

LookupTable::LookupTable(const Scene& scene, const Plan& plan, const ValueScale& scale,
                         double radius)
    : integrator(plan.integrator), n(plan.table_n) {
  if (integrator == Integrator::psi) {
    const preint::PsiTable table = preint::psi_table(n);
    channels = 1;
    texels.assign(table.psi.begin(), table.psi.end());
  } else if (integrator == Integrator::table2d) {
    texels = std::move(integral_table_2d(scene, plan, scale, radius).rgba);
  } else if (integrator == Integrator::table3d) {
    preint::Table3D table = integral_table_3d(scene, plan, scale, radius);
    m = table.m;
    most_length = static_cast<float>(table.max_length);
    texels = std::move(table.rgba);
  }
}

}  // namespace tetraglass::project::cpu
