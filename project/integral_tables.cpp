#include "project/integral_tables.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "project/longest_edge.h"

namespace tetraglass::project {
namespace {

/// No light tells more from infinity; products of floats of this size stay finite.
constexpr double kMostExtinction = 1e20;  // per radius

/// Extinctions per `radius`.
preint::TransferFunction per_radius(const preint::TransferFunction& tf, double radius) {
  std::vector<preint::ControlPoint> points = tf.points();
  for (preint::ControlPoint& point : points) {
    point.extinction = std::min(point.extinction * radius, kMostExtinction);
  }
  return preint::TransferFunction(std::move(points));
}

}  // namespace

preint::Table2D integral_table_2d(const Scene& scene, const Plan& plan, const ValueScale& values,
                                  double radius) {
  const double low = values.value(-1);
  const double high = values.value(1);
  if (scene.mode == Mode::iso) return iso_table(scene.isosurfaces, low, high, plan.table_n);
  if (scene.mode == Mode::mip) {
    return mip_table(scene.transfer_function, low, high, plan.table_n);
  }
  return emission_table(per_radius(scene.transfer_function, radius), low, high, plan.table_n);
}

preint::Table3D integral_table_3d(const Scene& scene, const Plan& plan, const ValueScale& values,
                                  double radius) {
  return full_table(per_radius(scene.transfer_function, radius), values.value(-1), values.value(1),
                    longest_edge(scene) / radius, plan.table_n, plan.table_m);
}

preint::RampedTables3D ramped_integral_tables(const Scene& scene, const Plan& plan,
                                              const ValueScale& values, double radius) {
  return ramped_tables_3d(per_radius(scene.transfer_function, radius), values.value(-1),
                          values.value(1), longest_edge(scene) / radius, plan.table_n,
                          plan.table_m);
}

preint::Table3D integral_material_table(const Scene& scene, int n, int m, const ValueScale& values,
                                        double radius) {
  return material_table_3d(per_radius(scene.transfer_function, radius), values.value(-1),
                           values.value(1), longest_edge(scene) / radius, n, m);
}

}  // namespace tetraglass::project
