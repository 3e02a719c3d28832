#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh/import.h"
#include "project/plan.h"
#include "project/scene.h"
#include "project/stats.h"
#include "project/verification.h"

namespace tetraglass::apps {

/// What a rendering took, stage by stage.
struct RenderReport {
  mesh::ImportReport import;
  project::Stats stats;
  std::optional<project::Verification> verification;
  double write_ms = 0;
  std::vector<double> frame_ms;  ///< of each frame, where there is a row of them
};

/// The contract's JSON.
[[nodiscard]] std::string stats_json(const project::Scene& scene, const project::Plan& plan,
                                     const RenderReport& report);

/// One line per stage, for people.
[[nodiscard]] std::string stage_lines(const RenderReport& report);

}  // namespace tetraglass::apps
