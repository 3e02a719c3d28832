#pragma once

#include <string>

namespace tetraglass::mesh {

/// The extension of a file name with its dot, in lower case; empty if it has none.
[[nodiscard]] std::string extension_of(const std::string& file);

/// The whole content of a file. Throws ReadError where it cannot be read.
[[nodiscard]] std::string content_of(const std::string& file);

}  // namespace tetraglass::mesh
