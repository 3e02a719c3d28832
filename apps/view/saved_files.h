#pragma once

#include <cstdint>
#include <string>
#include <vector>

/// What the window leaves behind.
namespace tetraglass::apps::view {

/// NAME-1, NAME-2, ...: the first that no file of these extensions has in the working folder.
[[nodiscard]] std::string free_name(const std::string& name,
                                    const std::vector<std::string>& extensions);

/// Writes sRGB pixels, RGBA, row 0 at the top, to a .png, without their opacity. Throws WriteError.
void save_pixels(const std::vector<std::uint8_t>& pixels, int width, int height,
                 const std::string& file);

/// A line on stdout, at once.
void print_result(const std::string& line);

}  // namespace tetraglass::apps::view
