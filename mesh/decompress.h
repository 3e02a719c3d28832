#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace tetraglass::mesh {

/// What the bytes unpack to, up to `most` bytes; the rest is left packed. Throws InputError where
/// they are damaged or cut off before that.
[[nodiscard]] std::string gunzip(std::string_view packed, std::size_t most);   ///< gzip or zlib
[[nodiscard]] std::string bunzip2(std::string_view packed, std::size_t most);  ///< bzip2

}  // namespace tetraglass::mesh
