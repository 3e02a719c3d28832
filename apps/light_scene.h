#pragma once

#include "apps/render_arguments.h"
#include "project/scene.h"

namespace tetraglass::apps {

/// How light falls on a scene whose mode is known: shading, gradients, lights, modulation. Throws
/// UsageError, and ReadError for the file of the lights.
void set_light(const RenderArguments& arguments, project::Scene& scene);

}  // namespace tetraglass::apps
