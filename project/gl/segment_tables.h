#pragma once

#include <optional>

#include "project/gl/normalization.h"
#include "project/gl/objects.h"
#include "project/gl/program.h"
#include "project/plan.h"
#include "project/scene.h"
#include "project/stats.h"

namespace tetraglass::project::gl {

/// The tables that the fragment stage looks segments up in: what the integrator of the plan has,
/// and what the light of media has (preint/ramped_table.h). Nothing where there are none.
class SegmentTables {
 public:
  /// Of a material table beside an integrator without one of lengths.
  static constexpr int kMaterialSize = 256;
  static constexpr int kMaterialLengths = 32;

  /// Adds times and bytes to `stats`. Throws UnavailableError where they do not fit.
  SegmentTables(const Context& context, const Scene& scene, const Plan& plan,
                const Normalization& normalization, Stats& stats);

  void set_uniforms(const Program& program) const;
  void bind() const;

 private:
  void make_psi(const Context& context, int n);
  void make_2d(const Context& context, const Scene& scene, const Plan& plan,
               const Normalization& normalization);
  void make_3d(const Context& context, const Scene& scene, const Plan& plan,
               const Normalization& normalization);
  void make_material(const Context& context, const Scene& scene, const Plan& plan,
                     const Normalization& normalization);

  double longest_ = 1;  // segment, in normalized units
  std::optional<Table> table_;
  std::optional<Table> back_;      // light weighted towards the back of the segment
  std::optional<Table> material_;  // means over the segment
  std::size_t bytes_ = 0;
};

}  // namespace tetraglass::project::gl
