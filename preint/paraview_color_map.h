#pragma once

#include <string>

#include "preint/transfer_function.h"

namespace tetraglass::preint {

/// Reads a color map that ParaView exported (JSON or XML; by content, not by name of the file) and
/// spreads it over the values [low, high]. `name` chooses one of several maps; empty takes the
/// first. Colors are interpolated in the map's space (RGB, HSV, Lab, Diverging, or Step: constant
/// up to the next point) and converted to linear RGB at enough points between. Opacity: where the
/// file has opacities ("Points" in JSON, "o" in XML), they are taken as those of a tenth of the
/// `diagonal`, at most 0.999 (ParaView's own unit of length is not in the file); else the
/// extinction of a preset. Throws ReadError (unreadable, not such a file, wrong numbers, a map of
/// categories or an unknown color space), UsageError (no map of that name, low >= high), InputError
/// (diagonal not positive).
[[nodiscard]] TransferFunction read_paraview_color_map(const std::string& file,
                                                       const std::string& name, double low,
                                                       double high, double diagonal);

}  // namespace tetraglass::preint
