#pragma once

#include <string>
#include <vector>

#include "preint/transfer_function.h"

/// What the panel is made of, within a window of ImGui.
namespace tetraglass::apps::view {

/// A list to choose from; whether another name was chosen. The empty name is the default.
bool choose(const char* label, const std::vector<std::string>& names, std::string& chosen);

/// Whether the value changed.
bool slider(const char* label, double& value, double low, double high, const char* format = "%.5g",
            bool logarithmic = false);

/// A linear color between black and white, as sRGB on the screen; whether it changed.
bool edit_color(const char* label, preint::Color& color, bool with_label = true);

}  // namespace tetraglass::apps::view
