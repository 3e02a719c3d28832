#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace tetraglass::mesh {

/// The least number of bytes that a netCDF file of one of the classic formats (CDF-1, 2, 5) takes,
/// from its head; nothing for any other file, and where the head itself is cut off or damaged.
/// NetCDF's library reads what is missing at the end of a file as zeros. Source: NetCDF User's
/// Guide, appendix "File Format Specifications".
[[nodiscard]] std::optional<std::uint64_t> netcdf_size(const std::string& file);

}  // namespace tetraglass::mesh
