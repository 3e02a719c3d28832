#include <cstdlib>
#include <filesystem>

#include <benchmark/benchmark.h>

#include "mesh/decompose.h"
#include "mesh/read_plot3d.h"

// Reading the blunt fin of NASA (from the folder TETRAGLASS_DATA, default ../shared/data; skipped
// without it) and splitting its hexahedra; items are the tetrahedra that come of it.
namespace {

using namespace tetraglass::mesh;

std::filesystem::path blunt_fin() {
  const char* folder = std::getenv("TETRAGLASS_DATA");
  return std::filesystem::path(folder != nullptr ? folder
                                                 : TETRAGLASS_SOURCE_DIR "/../shared/data") /
         "classics" / "bluntfinxyz.bin";
}

void read(benchmark::State& state) {
  if (!std::filesystem::is_regular_file(blunt_fin())) {
    state.SkipWithError("the file classics/bluntfinxyz.bin is not in the folder of real files");
    return;
  }
  for (auto _ : state) benchmark::DoNotOptimize(read_plot3d(blunt_fin().string()));
}

void split(benchmark::State& state) {
  if (!std::filesystem::is_regular_file(blunt_fin())) {
    state.SkipWithError("the file classics/bluntfinxyz.bin is not in the folder of real files");
    return;
  }
  const MeshData data = read_plot3d(blunt_fin().string());
  std::size_t cells = 0;
  for (auto _ : state) {
    const Decomposition split = decompose(data);
    cells += split.mesh.cells.size();
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(cells));
}

BENCHMARK(read)->Unit(benchmark::kMillisecond);
BENCHMARK(split)->Unit(benchmark::kMillisecond);

}  // namespace
