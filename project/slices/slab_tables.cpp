#include "project/slices/slab_tables.h"

#include <array>

#include "base/stopwatch.h"
#include "preint/ramped_table.h"
#include "project/gl/mesh_buffers.h"
#include "project/gl/switches.h"

namespace tetraglass::project::slices {

SlabTables::SlabTables(const gl::Context& context, const Scene& scene, const Plan& plan,
                       const gl::Normalization& normalization)
    : context_(context), scene_(scene), plan_(plan), normalization_(normalization) {}

gl::Table SlabTables::texture(const preint::Table2D& table) {
  bytes_ += sizeof(float) * table.rgba.size();
  return {context_, gl::Texel::rgba32f, {table.n, table.n, 0}, table.rgba, true};
}

void SlabTables::make(double length, Stats& stats) {
  const bool has_colors = plan_.integrator == Integrator::table2d;
  const bool has_materials = gl::has_material_table(scene_);
  if ((!has_colors && !has_materials) || length_ == length) return;
  const base::Stopwatch clock;
  const preint::TransferFunction& tf = scene_.transfer_function;
  const double low = normalization_.field_value(-1);
  const double high = normalization_.field_value(1);
  const double size = length * normalization_.radius;
  bytes_ = 0;
  if (gl::has_ramped_light(scene_, plan_)) {
    const preint::RampedTables tables = preint::ramped_tables(tf, low, high, size, plan_.table_n);
    light_.emplace(texture(tables.front));
    back_.emplace(texture(tables.back));
  } else if (has_colors) {
    light_.emplace(texture(preint::slab_table(tf, low, high, size, plan_.table_n)));
  }
  if (has_materials) {
    const int n = plan_.table_n > 0 ? plan_.table_n : kMaterialSize;
    material_.emplace(texture(preint::material_table(tf, low, high, size, n)));
  }
  length_ = length;
  stats.tables_ms += clock.milliseconds();
}

void SlabTables::set_uniforms(const gl::Program& program) {
  program.set("table", gl::Units::kTable);
  program.set("back_table", gl::Units::kBackTable);
  program.set("material_table", gl::Units::kMaterialTable);
}

void SlabTables::bind() const {
  if (light_) light_->bind(gl::Units::kTable);
  if (back_) back_->bind(gl::Units::kBackTable);
  if (material_) material_->bind(gl::Units::kMaterialTable);
}

}  // namespace tetraglass::project::slices
