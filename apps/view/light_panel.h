#pragma once

#include "apps/view/viewer.h"

namespace tetraglass::apps::view {

/// Lights, within a window of ImGui. Changes the viewer.
void draw_light_panel(Viewer& viewer);

}  // namespace tetraglass::apps::view
