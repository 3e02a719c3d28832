// Feeds bytes to one of the project's own readers (TETRAGLASS_FUZZ_READ, of files with the
// extension TETRAGLASS_FUZZ_EXTENSION) and splits what it reads: any input has to end in a mesh or
// in one of the errors of base/errors.h.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>

#include <unistd.h>

#include "base/errors.h"
#include "mesh/decompose.h"
#include "mesh/linearize.h"
#include "mesh/read_abaqus.h"
#include "mesh/read_gambit.h"
#include "mesh/read_medit.h"
#include "mesh/read_msh.h"
#include "mesh/read_netgen.h"
#include "mesh/read_plot3d.h"
#include "mesh/read_points.h"
#include "mesh/read_pos.h"
#include "mesh/read_surface.h"
#include "mesh/read_tetgen.h"
#include "mesh/read_ucd.h"
#include "mesh/read_volume.h"

namespace {

using namespace tetraglass;

/// A file of this process alone.
const std::string& input_file() {
  static const std::string kFile = [] {
    const auto folder =
        std::filesystem::temp_directory_path() / ("tetraglass-fuzz-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    return (folder / ("input" TETRAGLASS_FUZZ_EXTENSION)).string();
  }();
  return kFile;
}

mesh::MeshData read(const std::string& file) {
  return mesh::TETRAGLASS_FUZZ_READ;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::FILE* file = std::fopen(input_file().c_str(), "wb");
  if (file == nullptr) return 0;
  std::fwrite(data, 1, size, file);
  std::fclose(file);
  try {
    static_cast<void>(mesh::decompose(mesh::linearize(read(input_file()), true).mesh));
  } catch (const base::Error&) {
  } catch (const base::UsageError&) {
  }
  return 0;
}
