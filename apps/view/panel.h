#pragma once

#include <vector>

#include "apps/view/controls.h"
#include "apps/view/transfer_function_plot.h"
#include "apps/view/viewer.h"

namespace tetraglass::apps::view {

/// What the panel remembers between frames.
struct PanelState {
  bool shown = true;
  bool help = false;
  bool playing = false;  ///< the time steps
  PlotState plot;
};

/// Of the panel, in heights of the font.
inline constexpr float kPanelWidth = 24;

/// The width of the panel, in the window's coordinates, where it is shown.
[[nodiscard]] float panel_width(const PanelState& state);

/// The panel on the left of the window, within a frame of ImGui. Changes the viewer; returns what
/// was asked for by buttons.
std::vector<Action> draw_panel(Viewer& viewer, PanelState& state);

/// Mouse and keys, in a window of their own.
void draw_help(PanelState& state);

}  // namespace tetraglass::apps::view
