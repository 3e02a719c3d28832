#include "project/gl/segment_tables.h"

#include <array>

#include "base/stopwatch.h"
#include "preint/psi_table.h"
#include "project/gl/mesh_buffers.h"
#include "project/gl/switches.h"
#include "project/integral_tables.h"

namespace tetraglass::project::gl {
namespace {

Table texture(const Context& context, const preint::Table3D& table) {
  return {context, Texel::rgba32f, {table.n, table.n, table.m}, table.rgba, true};
}

std::size_t bytes_of(const preint::Table3D& table) {
  return sizeof(float) * table.rgba.size();
}

}  // namespace

SegmentTables::SegmentTables(const Context& context, const Scene& scene, const Plan& plan,
                             const Normalization& normalization, Stats& stats) {
  const base::Stopwatch clock;
  if (plan.integrator == Integrator::psi) make_psi(context, plan.table_n);
  if (plan.integrator == Integrator::table2d) make_2d(context, scene, plan, normalization);
  if (plan.integrator == Integrator::table3d) make_3d(context, scene, plan, normalization);
  if (has_material_table(scene)) make_material(context, scene, plan, normalization);
  if (bytes_ == 0) return;
  stats.tables_ms += clock.milliseconds();
  stats.add(Effect::table, bytes_, clock.milliseconds());
}

void SegmentTables::make_psi(const Context& context, int n) {
  const preint::PsiTable table = preint::psi_table(n);
  table_.emplace(context, Texel::r32f, std::array<int, 3>{table.n, table.n, 0}, table.psi, true);
  bytes_ += sizeof(float) * table.psi.size();
}

void SegmentTables::make_2d(const Context& context, const Scene& scene, const Plan& plan,
                            const Normalization& normalization) {
  const preint::Table2D table =
      integral_table_2d(scene, plan, normalization.values, normalization.radius);
  table_.emplace(context, Texel::rgba32f, std::array<int, 3>{table.n, table.n, 0}, table.rgba,
                 scene.mode != Mode::iso);
  bytes_ += sizeof(float) * table.rgba.size();
}

void SegmentTables::make_3d(const Context& context, const Scene& scene, const Plan& plan,
                            const Normalization& normalization) {
  if (!has_ramped_light(scene, plan)) {
    const preint::Table3D table =
        integral_table_3d(scene, plan, normalization.values, normalization.radius);
    table_.emplace(texture(context, table));
    longest_ = table.max_length;
    bytes_ += bytes_of(table);
    return;
  }
  const preint::RampedTables3D tables =
      ramped_integral_tables(scene, plan, normalization.values, normalization.radius);
  table_.emplace(texture(context, tables.front));
  back_.emplace(texture(context, tables.back));
  longest_ = tables.front.max_length;
  bytes_ += bytes_of(tables.front) + bytes_of(tables.back);
}

void SegmentTables::make_material(const Context& context, const Scene& scene, const Plan& plan,
                                  const Normalization& normalization) {
  const bool has_lengths = plan.table_m > 0;
  const preint::Table3D table = integral_material_table(
      scene, has_lengths ? plan.table_n : kMaterialSize,
      has_lengths ? plan.table_m : kMaterialLengths, normalization.values, normalization.radius);
  material_.emplace(texture(context, table));
  longest_ = table.max_length;
  bytes_ += bytes_of(table);
}

void SegmentTables::set_uniforms(const Program& program) const {
  program.set("table", Units::kTable);
  program.set("back_table", Units::kBackTable);
  program.set("material_table", Units::kMaterialTable);
  program.set("table_length", static_cast<float>(longest_));
}

void SegmentTables::bind() const {
  if (table_) table_->bind(Units::kTable);
  if (back_) back_->bind(Units::kBackTable);
  if (material_) material_->bind(Units::kMaterialTable);
}

}  // namespace tetraglass::project::gl
