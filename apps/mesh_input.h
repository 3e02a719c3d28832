#pragma once

#include <string>

#include "mesh/import.h"

namespace tetraglass::apps {

/// Prints a line "tetraglass: warning: ..." on stderr.
void warn(const std::string& text);

/// Imports a mesh and tells on stderr what was done to it.
[[nodiscard]] mesh::Import import_and_tell(const std::string& file,
                                           const mesh::ImportOptions& options);

/// As mesh::select_scalar, with the file in its errors.
[[nodiscard]] mesh::ScalarField select_scalar_of(const std::string& file, const mesh::TetMesh& mesh,
                                                 const std::string& spec);

}  // namespace tetraglass::apps
