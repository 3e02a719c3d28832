#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "mesh/read_surface.h"
#include "mesh/tetrahedralize.h"

// The tetrahedralizers on the elephant (5,558 triangles; its file is not part of the sources: its
// folder is told by TETRAGLASS_DATA). Items are tetrahedra.
namespace {

using namespace tetraglass::mesh;

std::string elephant() {
  const char* chosen = std::getenv("TETRAGLASS_DATA");
  const std::filesystem::path folder = chosen != nullptr ? chosen : "../shared/data";
  return (folder / "surfaces" / "elephant.off").string();
}

template <typename Make>
void measure(benchmark::State& state, const Make& make) {
  if (!std::filesystem::exists(elephant())) {
    state.SkipWithError(
        ("no file " + elephant() + "; name its folder with TETRAGLASS_DATA").c_str());
    return;
  }
  const MeshData surface = read_surface(elephant());
  FillOptions options;
  options.cells = static_cast<double>(state.range(0));
  std::size_t cells = 0;
  for (auto _ : state) {
    std::vector<std::string> notes;
    cells = make(surface, notes, options).cells.size();
  }
  state.counters["tetrahedra"] = static_cast<double>(cells);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(cells));
}

void tetgen(benchmark::State& state) {
  measure(state, fill_surface);
}

void mesh_3(benchmark::State& state) {
  measure(state, remesh_surface);
}

void points_alone(benchmark::State& state) {
  measure(state, [](const MeshData& surface, std::vector<std::string>& notes, const FillOptions&) {
    return delaunay(surface, notes);
  });
}

BENCHMARK(tetgen)->Arg(100000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(mesh_3)->Arg(20000)->Arg(100000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(points_alone)->Arg(0)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
