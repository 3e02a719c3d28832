#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "project/compare.h"
#include "project/image.h"
#include "project/plan.h"
#include "project/scene.h"

namespace tetraglass::project {

/// A way to draw, of those that differ from the default in one knob.
struct StudyCase {
  std::string knob;  ///< "projector", "integrator", "order", "layout", "target", "shading", ...
  std::string name;
  Request request;
  std::optional<Shading> shading;  ///< instead of the scene's
};

/// Whether it draws the trilinear field of the scene's grid instead of its cells.
[[nodiscard]] inline bool draws_grid(const StudyCase& one) {
  return one.request.projector && draws_grid(*one.request.projector);
}

/// Every knob that the scene's mode has, turned one at a time: of the gl projector from its default
/// (exact integrals, mpvo, layout indexed, floats), of the cpu projector from its own; of a lit
/// medium its shadings; of a scene with a grid slices. `all`: more sizes of tables and more slices.
/// Requests that `plan` refuses for this scene are left out.
[[nodiscard]] std::vector<StudyCase> study_cases(const Scene& scene, bool all);

/// What a case came to.
struct StudyPoint {
  StudyCase what;
  double set_up_ms = 0;   ///< median: buffers, tables, shaders and the first picture
  double frame_ms = 0;    ///< median of the pictures after it: order and drawing
  Difference error;       ///< from its reference
  bool on_front = false;  ///< no other is both faster and nearer to the same reference
  Image image;
  std::string failure;  ///< why there is no picture; else empty
};

struct Study {
  Image reference;       ///< of the cells; of a lit medium, lit at every point
  Image grid_reference;  ///< of the trilinear field; empty where nothing draws it
  double reference_ms = 0;
  int rounds = 0;
  std::vector<StudyPoint> points;

  /// What the point is to come near to.
  [[nodiscard]] const Image& judge(const StudyPoint& point) const {
    return draws_grid(point.what) ? grid_reference : reference;
  }
};

/// How long a study may take.
struct StudyLength {
  int rounds = 1;      ///< at most
  double seconds = 0;  ///< after these no drawing is begun, but of the first case
};

/// Draws every case in each round, in turn, so that what else the machine does meets all of them
/// alike, and compares with the reference. What the time did not suffice for has a `failure` that
/// says so. `step` is called after each drawing.
[[nodiscard]] Study study_accuracy(const Scene& scene, const std::vector<StudyCase>& cases,
                                   const StudyLength& length, const std::function<void()>& step);

/// Marks the points that no other with the same reference beats in both time and largest error;
/// errors below 2^-20 count as equal. Those without a picture are never on the front.
void mark_front(std::vector<StudyPoint>& points);

}  // namespace tetraglass::project
