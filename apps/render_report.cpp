#include "apps/render_report.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/stopwatch.h"
#include "project/reference/grid_reference.h"
#include "project/reference/reference.h"

namespace tetraglass::apps {

Verification verify(const project::Scene& scene, const project::Image& image, int count) {
  std::mt19937 random;  // the default seed: the same pixels each time
  // Not uniform_int_distribution: its values differ between standard libraries.
  const auto below = [&](int limit) {
    return static_cast<int>(random() % static_cast<std::uint32_t>(limit));
  };
  std::vector<Eigen::Vector2i> pixels;
  pixels.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const int x = below(image.width);
    pixels.emplace_back(x, below(image.height));
  }
  const std::vector<Eigen::Array4d> expected = scene.grid
                                                   ? project::grid_reference_pixels(scene, pixels)
                                                   : project::reference_pixels(scene, pixels);
  Verification result;
  result.pixels = pixels.size();
  double squares = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const float* actual = image.pixel(pixels[i].x(), pixels[i].y());
    for (int c = 0; c < 4; ++c) {
      const double error = std::abs(static_cast<double>(actual[c]) - expected[i][c]);
      result.max_error = std::max(result.max_error, error);
      squares += error * error;
    }
  }
  result.rms_error =
      std::sqrt(squares / (4.0 * static_cast<double>(std::max<std::size_t>(1, pixels.size()))));
  return result;
}

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
      {"plan", plan.reasons},
      {"threads", stats.threads},
      {"peak_bytes", base::peak_bytes()}};
  if (report.verification) {
    json["verified"] = {{"pixels", report.verification->pixels},
                        {"max_error", report.verification->max_error},
                        {"rms_error", report.verification->rms_error}};
  }
  return json.dump(2) + "\n";
}

std::string stage_lines(const RenderReport& report) {
  return fmt::format(
      "read {:.0f} ms, decompose {:.0f} ms, tables {:.0f} ms, sort {:.1f} ms, project {:.0f} ms, "
      "write {:.0f} ms; {} fragments",
      report.import.read_ms, report.import.decompose_ms, report.stats.tables_ms,
      report.stats.sort_ms, report.stats.project_ms, report.write_ms, report.stats.fragments);
}

}  // namespace tetraglass::apps
