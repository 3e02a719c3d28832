#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tetraglass::mesh {

/// Points along the three axes of a grid.
struct Plot3dDimensions {
  std::array<std::uint64_t, 3> n;
  [[nodiscard]] std::uint64_t points() const { return n[0] * n[1] * n[2]; }
  bool operator==(const Plot3dDimensions&) const = default;
};

enum class Plot3dContent { grid, solution };

/// One grid or solution: the channels one after the other, each with a value per point.
struct Plot3dBlock {
  Plot3dDimensions dimensions;
  std::vector<double> values;
  std::vector<double> blanks;  ///< per point, empty if the file has none
};

/// The grids or solutions of a PLOT3D file: text, or binary in any of the layouts that are met with
/// (either byte order, single or double precision, bare or in Fortran's records, one grid or many,
/// iblank or not), whichever agrees with the size of the file and, if they are given, with the
/// dimensions `wanted`. Nothing if none does. Throws ReadError where the file cannot be read.
[[nodiscard]] std::optional<std::vector<Plot3dBlock>> read_plot3d_blocks(
    const std::string& file, Plot3dContent content,
    const std::vector<Plot3dDimensions>* wanted = nullptr);

}  // namespace tetraglass::mesh
