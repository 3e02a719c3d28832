#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

/// Where the cells of one geometric type of MED lie in the mesh.
struct MedRun {
  int type;
  std::size_t first;
  std::size_t count;
};

/// A name as MED stores it, `size` letters at most, without the blanks at its end.
[[nodiscard]] std::string med_text(const char* first, std::size_t size);

/// Adds the fields at nodes and in cells of one time step ("" or "last", a time, "index:N") to the
/// mesh that has been read from an open MED file; of values at integration points the mean of each
/// cell. What is left out goes to the notes. Throws ReadError, with the name `file`, where the
/// fields are damaged, and UsageError for a time that is not there.
void read_med_fields(std::int64_t id, const std::string& file, const char* mesh_name,
                     std::span<const MedRun> runs, const std::string& time, MeshData& mesh);

}  // namespace tetraglass::mesh
