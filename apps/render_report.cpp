#include "apps/render_report.h"

#include <cstddef>
#include <numeric>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/median.h"
#include "base/stopwatch.h"
#include "project/effects.h"

namespace tetraglass::apps {

namespace {

/// What each effect took, where it was needed.
nlohmann::ordered_json effects_json(const project::Scene& scene, const project::Plan& plan,
                                    const project::Stats& stats) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const project::EffectPlan& effect : project::planned_effects(scene, plan, stats.threads)) {
    nlohmann::ordered_json entry = {{"needed", effect.needed}, {"why", effect.why}};
    if (const auto work = stats.work.find(effect.effect); work != stats.work.end()) {
      entry["bytes"] = work->second.bytes;
      entry["ms"] = work->second.ms;
    }
    json[project::to_string(effect.effect)] = entry;
  }
  return json;
}

}  // namespace

std::string stats_json(const project::Scene& scene, const project::Plan& plan,
                       const RenderReport& report) {
  const project::Stats& stats = report.stats;
  nlohmann::ordered_json json = {
      {"stages_ms",
       {{"read", report.import.read_ms},
        {"decompose", report.import.decompose_ms},
        {"tables", stats.tables_ms},
        {"sort", stats.sort_ms},
        {"project", stats.project_ms},
        {"write", report.write_ms}}},
      {"cells", scene.mesh->cells.size()},
      {"cells_skipped", {{"degenerate", scene.drawable.degenerate}, {"nan", scene.drawable.nan}}},
      {"fragments", stats.fragments},
      {"sort",
       {{"method", stats.sort_method}, {"exact", stats.sort_exact}, {"cycles", stats.cycles}}},
      {"projector", project::to_string(plan.projector)},
      {"context", stats.context},
      {"integrator", project::to_string(plan.integrator)},
      {"parts", stats.parts},
      {"plan", plan.reasons},
      {"effects", effects_json(scene, plan, stats)},
      {"threads", stats.threads},
      {"peak_bytes", base::peak_bytes()}};
  if (report.verification) {
    json["verified"] = {{"pixels", report.verification->pixels},
                        {"max_error", report.verification->max_error},
                        {"rms_error", report.verification->rms_error}};
  }
  if (!report.frame_ms.empty()) {
    json["frames"] = {
        {"count", report.frame_ms.size()},
        {"median_ms", base::median(report.frame_ms)},
        {"sum_ms", std::accumulate(report.frame_ms.begin(), report.frame_ms.end(), 0.0)}};
  }
  return json.dump(2) + "\n";
}

std::string stage_lines(const RenderReport& report) {
  return fmt::format(
      "read {:.0f} ms, decompose {:.0f} ms, tables {:.0f} ms, sort {:.1f} ms, project {:.0f} ms, "
      "write {:.0f} ms; {} fragments{}",
      report.import.read_ms, report.import.decompose_ms, report.stats.tables_ms,
      report.stats.sort_ms, report.stats.project_ms, report.write_ms, report.stats.fragments,
      report.stats.parts > 1 ? fmt::format(", mesh in {} parts", report.stats.parts) : "");
}

}  // namespace tetraglass::apps
