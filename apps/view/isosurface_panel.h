#pragma once

#include "apps/view/viewer.h"

namespace tetraglass::apps::view {

/// Values, colors and opacity of the isosurfaces of mode iso, within a window of ImGui. Changes the
/// viewer, which has facts.
void draw_isosurface_panel(Viewer& viewer);

}  // namespace tetraglass::apps::view
