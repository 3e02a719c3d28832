#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/render_arguments.h"
#include "apps/render_report.h"
#include "mesh/import.h"
#include "project/plan.h"
#include "project/scene.h"

namespace tetraglass::apps {

/// How many time steps the input has. Throws InputError where it has none.
[[nodiscard]] int count_time_steps(const RenderArguments& arguments);

/// The values that the field has in a row of time steps: all of a small mesh, evenly picked ones of
/// a large one; least and largest of all of them.
[[nodiscard]] mesh::ScalarField values_of_all_times(const RenderArguments& arguments, int steps);

/// What drawing a row of frames gives.
struct FramesDrawn {
  std::vector<std::string> files;
  std::vector<double> frame_ms;  ///< of each, without reading and writing
};

/// Draws `orbit` frames of the scene (made by make_scene with the same arguments) from all around,
/// and writes them. What does not depend on the view is set up once.
[[nodiscard]] FramesDrawn draw_orbit(const RenderArguments& arguments, project::Scene& scene,
                                     const project::Plan& plan, RenderReport& report);

/// Draws a frame for each of the time steps of the input, with the camera, the transfer function
/// and all else of the scene, which is that of the first step.
[[nodiscard]] FramesDrawn draw_times(const RenderArguments& arguments, int steps,
                                     project::Scene& scene, const project::Plan& plan,
                                     RenderReport& report);

}  // namespace tetraglass::apps
