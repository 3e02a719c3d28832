#include <algorithm>
#include <numeric>
#include <random>

#include <benchmark/benchmark.h>

#include "mesh/samples.h"
#include "sort/centroid.h"

// Visibility orders of grids of 5 tetrahedra per voxel; items are cells.
namespace {

using namespace tetraglass;

enum Numbering : int { in_file_order, at_random };

void centroid(benchmark::State& state, bool parallel, Numbering numbering) {
  const mesh::TetMesh mesh = mesh::make_sample("sphere", static_cast<std::size_t>(state.range(0)));
  std::vector<std::uint32_t> cells(mesh.cells.size());
  std::iota(cells.begin(), cells.end(), 0U);
  if (numbering == at_random) std::shuffle(cells.begin(), cells.end(), std::mt19937(1));
  const sort::View view{parallel, {3, 4, 5}, Eigen::Vector3d(-3, -4, -5).normalized()};
  sort::CentroidSorter sorter;
  for (auto _ : state) benchmark::DoNotOptimize(sorter.sort(mesh, cells, view).cells.data());
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(cells.size()));
}

constexpr std::int64_t kSizes[] = {1000, 148955, 1000000, 10000000};

void sizes(benchmark::internal::Benchmark* bench) {
  for (const std::int64_t size : kSizes) bench->Arg(size);
  bench->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK_CAPTURE(centroid, parallel_view, true, in_file_order)->Apply(sizes);
BENCHMARK_CAPTURE(centroid, perspective, false, in_file_order)->Apply(sizes);
BENCHMARK_CAPTURE(centroid, perspective_shuffled, false, at_random)->Apply(sizes);

}  // namespace
