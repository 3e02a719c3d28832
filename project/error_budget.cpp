#include "project/error_budget.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/errors.h"
#include "preint/table_error.h"
#include "project/longest_edge.h"
#include "project/render.h"

namespace tetraglass::project {
namespace {

// What floats lose in colors and opacities, whatever is drawn: the bound that the tests hold the
// cpu and the gl projector to.
constexpr double kFloatError = 1e-4;
// ... and in lengths, of the diagonal of the mesh.
constexpr double kFloatLength = 3e-6;
// The reference's picture is of floats.
constexpr double kReferenceError = 1e-7;
// No ray ends at less opacity, whatever the error allowed.
constexpr double kLeastOpaqueAt = 0.5;

double brightest(const Scene& scene) {
  double most = 1;
  for (const preint::ControlPoint& point : scene.transfer_function.points()) {
    most = std::max(most, point.color.maxCoeff());
  }
  for (const preint::Isosurface& surface : scene.isosurfaces) {
    most = std::max(most, surface.color.maxCoeff());
  }
  return most;
}

double rounding_of_floats(const Scene& scene) {
  const double diagonal = mesh::bounds(*scene.mesh).diagonal().norm();
  if (scene.mode == Mode::thickness) return kFloatLength * diagonal;
  double largest = brightest(scene);
  if (scene.mode == Mode::emission) {
    for (const preint::ControlPoint& point : scene.transfer_function.points()) {
      largest = std::max(largest, point.color.maxCoeff() * point.extinction * diagonal);
    }
  }
  return kFloatError * largest;
}

std::vector<Rung> cpu_ladder(const Scene& scene, const Request& request, double max_error) {
  const double rounding = rounding_of_floats(scene);
  const bool blends = !is_commutative(scene);
  std::vector<Rung> ladder;
  Request exact = request;
  exact.projector = Projector::cpu;
  if (blends && !request.opaque_at) {
    const double behind = 1 - plan(scene, exact).opaque_at;
    const double room = (max_error - rounding) / brightest(scene);
    if (room > behind) {
      Rung saving{exact, max_error, ""};
      saving.request.opaque_at = std::max(kLeastOpaqueAt, 1 - room);
      saving.reason = fmt::format(
          "cpu, exact integrals: the cheapest way here and the most accurate; rays end at an "
          "opacity "
          "of {:.6g}, behind which lies less than the error allowed",
          *saving.request.opaque_at);
      ladder.push_back(saving);
    }
    ladder.push_back(
        {exact, rounding + behind * brightest(scene),
         "cpu, exact integrals: the cheapest way here and the most accurate but for the "
         "reference"});
    exact.opaque_at = 1;
  }
  ladder.push_back({exact, rounding, "cpu, exact integrals, rays to their end"});
  if (request.projector) return ladder;
  Request judge = request;
  judge.projector = Projector::reference;
  judge.opaque_at.reset();
  ladder.push_back({judge, kReferenceError, "reference: double precision, slow"});
  return ladder;
}

/// Tables from small to large until one is predicted to keep within the error.
void add_tables(const Scene& scene, const Request& request, double max_error,
                std::vector<Rung>& ladder) {
  if (!(scene.field.min < scene.field.max) || scene.drawable.cells.empty()) return;
  // A ray through n^3 cells meets some 2 n; their errors are of either sign.
  const double segments = 2 * std::cbrt(static_cast<double>(scene.drawable.cells.size()));
  const double longest = longest_edge(scene);
  struct Size {
    int n;
    int m;
  };
  for (const Size& size : {Size{32, 16}, {64, 32}, {128, 64}, {256, 128}}) {
    const preint::Table3D table = preint::full_table(scene.transfer_function, scene.field.min,
                                                     scene.field.max, longest, size.n, size.m);
    const double error = preint::full_table_error(table, scene.transfer_function);
    const double predicted = error * std::sqrt(segments) + rounding_of_floats(scene);
    if (predicted > max_error) continue;
    Rung rung{request, predicted, ""};
    rung.request.integrator = Integrator::table3d;
    rung.request.table_n = size.n;
    rung.request.table_m = size.m;
    rung.reason = fmt::format("gl, a table of {0} x {0} x {1}: lookups err by {2:.2g} at most",
                              size.n, size.m, error);
    ladder.push_back(rung);
    return;
  }
}

std::vector<Rung> gl_ladder(const Scene& scene, const Request& request, double max_error) {
  std::vector<Rung> ladder;
  Request by_gl = request;
  by_gl.projector = Projector::gl;
  const bool free_integrator = !request.integrator && request.table_n == 0;
  if (scene.mode == Mode::full && free_integrator && !is_lit_medium(scene) && !scene.modulation) {
    add_tables(scene, by_gl, max_error, ladder);
  }
  const double rounding = rounding_of_floats(scene);
  ladder.push_back({by_gl, rounding, "gl, exact integrals"});
  if (!request.sort && !is_commutative(scene) && !has_faces12(plan(scene, by_gl).gl.layout)) {
    by_gl.sort = SortMethod::fragments;
    ladder.push_back({by_gl, rounding, "gl, exact integrals, in exact order at every pixel"});
  }
  return ladder;
}

}  // namespace

std::vector<Rung> error_ladder(const Scene& scene, const Request& request, double max_error) {
  if (!(max_error > 0)) throw base::UsageError("--max-error needs an error above 0");
  const Projector projector = plan(scene, request).projector;
  switch (projector) {
    case Projector::cpu:
      return cpu_ladder(scene, request, max_error);
    case Projector::gl:
      return gl_ladder(scene, request, max_error);
    case Projector::reference:
    case Projector::grid_reference:
      return {{request, kReferenceError, "reference: double precision, slow"}};
    case Projector::slices:
      break;
  }
  return {{request, std::numeric_limits<double>::infinity(),
           to_string(projector) + ": no error is predicted for it"}};
}

VerifiedImage render_within(const Scene& scene, const Request& request, double max_error,
                            int pixels) {
  const std::vector<Rung> ladder = error_ladder(scene, request, max_error);
  VerifiedImage result;
  std::vector<std::string> steps;
  for (std::size_t i = 0; i < ladder.size(); ++i) {
    const Rung& rung = ladder[i];
    const bool last = i + 1 == ladder.size();
    if (rung.predicted_error > max_error && !last) continue;
    result.plan = plan(scene, rung.request);
    Stats stats;
    stats.tables_ms = result.stats.tables_ms;
    stats.sort_ms = result.stats.sort_ms;
    stats.project_ms = result.stats.project_ms;
    result.stats = stats;
    result.image = render(scene, result.plan, result.stats);
    result.verification = verify(scene, result.image, pixels);
    result.met = result.verification.max_error <= max_error;
    steps.push_back(fmt::format("error: {}; predicted {:.2g}, {} pixels show {:.2g} of {:.2g}{}",
                                rung.reason, rung.predicted_error, result.verification.pixels,
                                result.verification.max_error, max_error,
                                result.met ? ""
                                : last     ? ": not met"
                                           : ": not met, a step up"));
    if (result.met) break;
  }
  result.plan.reasons.insert(result.plan.reasons.end(), steps.begin(), steps.end());
  return result;
}

}  // namespace tetraglass::project
