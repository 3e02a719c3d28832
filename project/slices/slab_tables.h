#pragma once

#include <optional>

#include "preint/table.h"
#include "project/gl/normalization.h"
#include "project/gl/objects.h"
#include "project/gl/program.h"
#include "project/plan.h"
#include "project/scene.h"
#include "project/stats.h"

namespace tetraglass::project::slices {

/// The tables over the values at the front and the back of slabs of one length: of their colors
/// (lum2004, meissner2002 section 2.4), or of their light parted towards either side (lum2004), and
/// of where most of the light comes from and of what material (meissner2002 section 4). None that
/// the scene and the plan do not ask for.
class SlabTables {
 public:
  /// Values each way of the table of materials beside an integrator without a table.
  static constexpr int kMaterialSize = 256;

  /// Refers to all of these, which outlive it.
  SlabTables(const gl::Context& context, const Scene& scene, const Plan& plan,
             const gl::Normalization& normalization);

  /// Makes them for this length, in units of the normalization, unless it is that of those that are
  /// there. Adds the time to `stats`. Throws UnavailableError where they do not fit.
  void make(double length, Stats& stats);

  static void set_uniforms(const gl::Program& program);
  void bind() const;

  /// What they take on the context.
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  [[nodiscard]] gl::Table texture(const preint::Table2D& table);

  const gl::Context& context_;
  const Scene& scene_;
  const Plan& plan_;
  const gl::Normalization& normalization_;
  std::optional<gl::Table> light_;
  std::optional<gl::Table> back_;      // light weighted towards the back of the slab
  std::optional<gl::Table> material_;  // means over the slab
  double length_ = 0;                  // of the slabs of the tables
  std::size_t bytes_ = 0;
};

}  // namespace tetraglass::project::slices
