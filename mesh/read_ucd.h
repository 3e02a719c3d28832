#pragma once

#include <string>

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

/// Whether a file of the extension .inp is one of AVS (its first line, after remarks, is of five
/// numbers, or it begins with the byte 7) and not one of Abaqus.
[[nodiscard]] bool is_ucd(const std::string& file);

/// Reads unstructured cell data of AVS (UCD), in text or binary: cells, with the cell field
/// `Material Id` where these differ, and the node and cell data as fields. Source: AVS Developer's
/// Guide, appendix "UCD file format". Throws ReadError.
[[nodiscard]] MeshData read_ucd(const std::string& file);

}  // namespace tetraglass::mesh
