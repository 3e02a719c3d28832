#include <algorithm>
#include <numeric>
#include <random>

#include <benchmark/benchmark.h>

#include "mesh/adjacency.h"
#include "mesh/check.h"
#include "mesh/distance.h"
#include "mesh/gradients.h"
#include "mesh/samples.h"

// What is computed from a mesh, for grids of 5 tetrahedra per voxel; items are cells.
namespace {

using namespace tetraglass::mesh;

TetMesh grid(const benchmark::State& state) {
  return make_sample("sphere", static_cast<std::size_t>(state.range(0)));
}

// Cells and points numbered at random: no neighbour is near in memory.
TetMesh shuffled(TetMesh mesh) {
  std::mt19937 bits(1);
  std::vector<std::uint32_t> names(mesh.points.size());
  std::iota(names.begin(), names.end(), 0U);
  std::shuffle(names.begin(), names.end(), bits);
  for (Cell& cell : mesh.cells) {
    for (std::uint32_t& v : cell) v = names[v];
  }
  std::shuffle(mesh.cells.begin(), mesh.cells.end(), bits);
  return mesh;
}

template <typename F>
void measure(benchmark::State& state, const TetMesh& mesh, const F& f) {
  for (auto _ : state) benchmark::DoNotOptimize(f(mesh));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mesh.cells.size()));
}

void adjacency(benchmark::State& state) {
  measure(state, grid(state), face_adjacency);
}

void adjacency_shuffled(benchmark::State& state) {
  measure(state, shuffled(grid(state)), face_adjacency);
}

void soundness(benchmark::State& state) {
  measure(state, grid(state), check);
}

void distance(benchmark::State& state) {
  measure(state, grid(state), boundary_distance);
}

void gradients_at_vertices(benchmark::State& state) {
  const TetMesh mesh = grid(state);
  const ScalarField field = select_scalar(mesh, "sphere");
  measure(state, mesh, [&](const TetMesh& m) { return vertex_gradients(m, field); });
}

void gradients_by_least_squares(benchmark::State& state) {
  const TetMesh mesh = grid(state);
  const ScalarField field = select_scalar(mesh, "sphere");
  measure(state, mesh, [&](const TetMesh& m) { return least_squares_gradients(m, field); });
}

void drawable(benchmark::State& state) {
  const TetMesh mesh = grid(state);
  const ScalarField field = select_scalar(mesh, "sphere");
  measure(state, mesh, [&](const TetMesh& m) { return find_drawable(m, field); });
}

void sample(benchmark::State& state) {
  measure(state, grid(state), [&](const TetMesh&) { return grid(state); });
}

void sizes(benchmark::internal::Benchmark* bench) {
  bench->Arg(148955)->Arg(1000000)->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK(adjacency)->Apply(sizes)->Arg(10000000);
BENCHMARK(adjacency_shuffled)->Apply(sizes);
BENCHMARK(soundness)->Apply(sizes);
BENCHMARK(distance)->Apply(sizes);
BENCHMARK(gradients_at_vertices)->Apply(sizes);
BENCHMARK(gradients_by_least_squares)->Apply(sizes);
BENCHMARK(drawable)->Apply(sizes);
BENCHMARK(sample)->Apply(sizes)->Arg(10000000);

}  // namespace
