#pragma once

#include <functional>
#include <string>
#include <vector>

#include "project/compare.h"
#include "project/image.h"
#include "project/plan.h"
#include "project/scene.h"

namespace tetraglass::project {

/// A way to draw, of those that differ from the default in one knob.
struct StudyCase {
  std::string knob;  ///< "projector", "integrator", "order", "layout", "target"
  std::string name;
  Request request;
};

/// Every knob that the scene's mode has, turned one at a time: of the gl projector from its default
/// (exact integrals, mpvo, layout indexed, floats), of the cpu projector from its own. `all`: more
/// sizes of tables. Requests that `plan` refuses for this scene are left out.
[[nodiscard]] std::vector<StudyCase> study_cases(const Scene& scene, bool all);

/// What a case came to.
struct StudyPoint {
  StudyCase what;
  double set_up_ms = 0;   ///< median: buffers, tables, shaders and the first picture
  double frame_ms = 0;    ///< median of the pictures after it: order and drawing
  Difference error;       ///< from the reference
  bool on_front = false;  ///< no other is both faster and nearer to the reference
  Image image;
  std::string failure;  ///< why there is no picture; else empty
};

struct Study {
  Image reference;
  double reference_ms = 0;
  std::vector<StudyPoint> points;
};

/// Draws every case `rounds` times, in turn, so that what else the machine does meets all of them
/// alike, and compares with the reference. `step` is called after each drawing.
[[nodiscard]] Study study_accuracy(const Scene& scene, const std::vector<StudyCase>& cases,
                                   int rounds, const std::function<void()>& step);

/// Marks the points that no other beats in both time and largest error; errors below 2^-20 count as
/// equal. Those without a picture are never on the front.
void mark_front(std::vector<StudyPoint>& points);

}  // namespace tetraglass::project
