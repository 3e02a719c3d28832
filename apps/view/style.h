#pragma once

#include "apps/view/gl_window.h"

namespace tetraglass::apps::view {

/// In the window's coordinates.
[[nodiscard]] float font_size(const GlWindow& window);

/// The window's font, colors and distances, for the context of ImGui that is current, in the size
/// that the display's scale asks for.
void set_style(const GlWindow& window);

}  // namespace tetraglass::apps::view
