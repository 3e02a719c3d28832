#pragma once

#include "apps/view/viewer.h"

namespace tetraglass::apps::view {

/// Opens a window on the file of the arguments and shows it until the window is closed. Saved files
/// and copied command lines are printed on stdout. Throws UnavailableError where there is no
/// display or no OpenGL for a window, and what reading the file or setting up its first picture
/// throws.
void show_window(const RenderArguments& arguments, const std::vector<TypedOption>& typed);

}  // namespace tetraglass::apps::view
