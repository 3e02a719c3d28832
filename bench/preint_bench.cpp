// Pre-integration: segment integrals, and tables by brute force against incremental subrange
// integration (lum2004).

#include <cmath>
#include <cstdint>
#include <vector>

#include <benchmark/benchmark.h>

#include "preint/piece_light.h"
#include "preint/segment_integral.h"
#include "preint/table.h"

namespace {

using namespace tetraglass::preint;

/// One control point per table sample, as in lum2004: n - 1 pieces, smooth bumps of extinction,
/// total depth about 10.
TransferFunction as_fine_as_the_table(int n) {
  std::vector<ControlPoint> points;
  for (int i = 0; i < n; ++i) {
    const double t = static_cast<double>(i) / (n - 1);
    const double bump = std::sin(20 * t);
    points.push_back({t, Color(t, 1 - t, 0.5), 20 * bump * bump});
  }
  return TransferFunction(points);
}

void table_2d(benchmark::State& state, TableMethod method) {
  const int n = static_cast<int>(state.range(0));
  const TransferFunction tf = as_fine_as_the_table(n);
  for (auto _ : state) benchmark::DoNotOptimize(slab_table(tf, 0, 1, 1, n, method));
  state.SetItemsProcessed(state.iterations() * n * n);
  state.SetComplexityN(n);
}

void table_3d(benchmark::State& state, TableMethod method) {
  const int n = static_cast<int>(state.range(0));
  const int m = static_cast<int>(state.range(1));
  const TransferFunction tf = as_fine_as_the_table(n);
  for (auto _ : state) benchmark::DoNotOptimize(full_table(tf, 0, 1, 1, n, m, method));
  state.SetItemsProcessed(state.iterations() * n * n * m);
  state.SetComplexityN(n);
}

void segment(benchmark::State& state, double front, double back, double length) {
  const TransferFunction tf = preset("viridis", 0, 1, 1);
  for (auto _ : state) benchmark::DoNotOptimize(integrate_full(tf, {front, back, length}));
  state.SetItemsProcessed(state.iterations());
}

/// Linear pieces in float vectors; the argument is the bound on the optical depth, in hundredths.
void lights_of_pieces(benchmark::State& state) {
  constexpr std::size_t kPieces = 4096;
  const float deepest = static_cast<float>(state.range(0)) / 100;
  const std::vector<float> k(kPieces, deepest);
  std::vector<float> front(kPieces), back(kPieces), transmittance(kPieces);
  for (auto _ : state) {
    piece_lights({k, k, front, back, transmittance}, deepest);
    benchmark::DoNotOptimize(front.data());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kPieces));
}

const auto kMilliseconds = benchmark::kMillisecond;

BENCHMARK_CAPTURE(segment, thin_in_one_piece, 0.51, 0.53, 0.01);
BENCHMARK_CAPTURE(segment, whole_range_16_pieces, 0.0, 1.0, 1.0);
BENCHMARK_CAPTURE(segment, opaque, 0.2, 0.9, 1000.0);
BENCHMARK(lights_of_pieces)->Arg(10)->Arg(90)->Arg(400)->Arg(1000);

BENCHMARK_CAPTURE(table_2d, incremental, TableMethod::incremental)
    ->RangeMultiplier(2)
    ->Range(64, 1024)
    ->Unit(kMilliseconds)
    ->UseRealTime()
    ->Complexity();
BENCHMARK_CAPTURE(table_2d, brute_force, TableMethod::brute_force)
    ->RangeMultiplier(2)
    ->Range(64, 1024)
    ->Unit(kMilliseconds)
    ->UseRealTime()
    ->Complexity();
BENCHMARK_CAPTURE(table_3d, incremental, TableMethod::incremental)
    ->ArgsProduct({{32, 64, 128, 256}, {64}})
    ->Unit(kMilliseconds)
    ->UseRealTime();
BENCHMARK_CAPTURE(table_3d, brute_force, TableMethod::brute_force)
    ->ArgsProduct({{32, 64, 128, 256}, {64}})
    ->Unit(kMilliseconds)
    ->UseRealTime();

}  // namespace
