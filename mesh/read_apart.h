#pragma once

#include <functional>
#include <string>

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

/// Reads a file by a library that may crash, hang or take all memory where a file is damaged: in a
/// process of its own, which may use `seconds` of processor time and as much address space as the
/// machine has memory. Throws what `read` throws (of the types of base/errors.h), and ReadError
/// where it ended in another way.
[[nodiscard]] MeshData read_apart(const std::string& file, const std::function<MeshData()>& read,
                                  unsigned seconds);

/// A mesh as bytes, as it goes from one process to the other, and back. `from_bytes` throws
/// InputError where the bytes are no whole mesh.
[[nodiscard]] std::string to_bytes(const MeshData& mesh);
[[nodiscard]] MeshData from_bytes(std::string_view bytes);

}  // namespace tetraglass::mesh
