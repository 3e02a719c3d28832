#pragma once

#include <optional>
#include <string>

#include "mesh/import.h"
#include "project/image.h"
#include "project/plan.h"
#include "project/scene.h"
#include "project/stats.h"

namespace tetraglass::apps {

/// Errors of random pixels against the reference.
struct Verification {
  std::size_t pixels = 0;
  double max_error = 0;  ///< per channel, in the picture's own units
  double rms_error = 0;
};

/// Draws `count` random pixels (the same ones each time) by the reference projector (that of grids
/// where the scene has one) and compares.
[[nodiscard]] Verification verify(const project::Scene& scene, const project::Image& image,
                                  int count);

/// What a rendering took, stage by stage.
struct RenderReport {
  mesh::ImportReport import;
  project::Stats stats;
  std::optional<Verification> verification;
  double write_ms = 0;
};

/// The contract's JSON.
[[nodiscard]] std::string stats_json(const project::Scene& scene, const project::Plan& plan,
                                     const RenderReport& report);

/// One line per stage, for people.
[[nodiscard]] std::string stage_lines(const RenderReport& report);

}  // namespace tetraglass::apps
