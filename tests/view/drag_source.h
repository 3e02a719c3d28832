#pragma once

#include <string>

namespace tetraglass::tests {

/// Drags a list of files (text/uri-list) over the middle of the window of this title and drops it
/// there, as a file manager does (XDND, https://freedesktop.org/wiki/Specifications/XDND). Returns
/// why that failed, nothing where the window took the list.
[[nodiscard]] std::string drop_on_window(const std::string& display, const std::string& title,
                                         const std::string& uri_list);

}  // namespace tetraglass::tests
