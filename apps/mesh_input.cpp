#include "apps/mesh_input.h"

#include <fmt/format.h>

#include "base/errors.h"

namespace tetraglass::apps {

void warn(const std::string& text) {
  fmt::print(stderr, "tetraglass: warning: {}\n", text);
}

mesh::Import import_and_tell(const std::string& file, const mesh::ImportOptions& options) {
  mesh::Import result = mesh::import_mesh(file, options);
  for (const std::string& note : result.report.notes) fmt::print(stderr, "{}: {}\n", file, note);
  if (result.report.skipped > 0) {
    fmt::print(stderr, "{}: {} cells of dimension below 3 are left out\n", file,
               result.report.skipped);
  }
  if (result.report.inverted > 0) {
    fmt::print(stderr, "{}: {} inverted tetrahedra were turned\n", file, result.report.inverted);
  }
  return result;
}

mesh::ScalarField select_scalar_of(const std::string& file, const mesh::TetMesh& mesh,
                                   const std::string& spec) {
  try {
    return mesh::select_scalar(mesh, spec);
  } catch (const base::InputError& error) {
    throw base::InputError(file + ": " + error.what());
  }
}

}  // namespace tetraglass::apps
