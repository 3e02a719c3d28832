#pragma once

#include "apps/view/viewer.h"

namespace tetraglass::apps::view {

/// What the plot remembers between frames.
struct PlotState {
  bool dragging = false;
  double top = 0;  ///< the extinction at its upper edge, kept while a point is dragged
};

/// The transfer function over the histogram of the field, to be edited with the mouse, and the
/// selected point's numbers below. Changes the viewer. Within a frame of ImGui.
void draw_transfer_function(Viewer& viewer, PlotState& state);

}  // namespace tetraglass::apps::view
