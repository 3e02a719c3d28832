#pragma once

#include <string>
#include <vector>

#include "project/image.h"
#include "project/plan.h"
#include "project/scene.h"
#include "project/stats.h"
#include "project/verification.h"

namespace tetraglass::project {

/// A way to draw a scene that is expected to keep within an error.
struct Rung {
  Request request;
  double predicted_error = 0;  ///< the largest per channel
  std::string reason;          ///< one line, for people
};

/// The ways to draw the scene that come into question for an error of at most `max_error` per
/// channel, the cheapest first; each is at least as accurate as the one before, the last one the
/// most accurate that the request leaves. At least one. What the request forces stays.
///
/// Without a GPU the cpu projector with exact integrals is the cheapest way and the most accurate
/// but for the reference: then all that can be saved is what lies behind nearly opaque rays. Of the
/// gl projector, in mode full: pre-integrated tables of the smallest size whose measured lookup
/// error (preint::choose_full_table) leaves room for the segments of a ray; then exact integrals;
/// then an order that is exact at every pixel. Orders without a guarantee and targets of fewer bits
/// predict nothing, and `tetraglass accuracy` shows that they save little.
///
/// Pure. Throws UsageError where max_error is not positive, and like `plan`.
[[nodiscard]] std::vector<Rung> error_ladder(const Scene& scene, const Request& request,
                                             double max_error);

/// A picture with its error.
struct VerifiedImage {
  Image image;
  Plan plan;
  Stats stats;  ///< of the picture; what steps before it took is added up
  Verification verification;
  bool met =
      false;  ///< whether the error of the pixels that were checked is at most what was asked
};

/// Draws the scene by the rungs of `error_ladder`, from the first that is predicted to keep within
/// `max_error`, until `pixels` random pixels do so against the reference, or the last is reached.
/// The plan's reasons tell the steps.
[[nodiscard]] VerifiedImage render_within(const Scene& scene, const Request& request,
                                          double max_error, int pixels);

}  // namespace tetraglass::project
