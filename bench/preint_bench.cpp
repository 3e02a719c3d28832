// Pre-integration: segment integrals, and tables by brute force against incremental subrange
// integration (lum2004).

#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "preint/piece_light.h"
#include "preint/segment_integral.h"
#include "preint/segment_light.h"
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
}

void table_3d(benchmark::State& state, TableMethod method) {
  const int n = static_cast<int>(state.range(0));
  const int m = static_cast<int>(state.range(1));
  const TransferFunction tf = as_fine_as_the_table(n);
  for (auto _ : state) benchmark::DoNotOptimize(full_table(tf, 0, 1, 1, n, m, method));
  state.SetItemsProcessed(state.iterations() * n * n * m);
}

void segment(benchmark::State& state, double front, double back, double length) {
  const TransferFunction tf = preset("viridis", 0, 1, 1);
  for (auto _ : state) benchmark::DoNotOptimize(integrate_full(tf, {front, back, length}));
  state.SetItemsProcessed(state.iterations());
}

/// Linear pieces in float vectors; the argument is their optical depth, in hundredths.
void lights_of_pieces(benchmark::State& state) {
  constexpr std::size_t kPieces = 4096;
  const float depth = static_cast<float>(state.range(0)) / 100;
  const std::vector<float> k(kPieces, depth);
  std::vector<float> front(kPieces), back(kPieces), transmittance(kPieces);
  for (auto _ : state) {
    piece_lights({k, k, front, back, transmittance});
    benchmark::DoNotOptimize(front.data());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kPieces));
}

/// Segments in float, split at 17 control points: neighbours have similar values, each crosses as
/// many control points as the argument says.
void lights_of_segments(benchmark::State& state) {
  constexpr std::size_t kSegments = 1024;
  const FloatTransferFunction tf(preset("viridis", 0, 1, 1));
  const auto crossed = static_cast<float>(state.range(0));
  const auto& intervals = tf.intervals();
  std::vector<float> front, back, length(kSegments, 0.01F);
  for (std::size_t i = 0; i < kSegments; ++i) {
    const FloatTransferFunction::Interval& at = intervals[1 + i * 8 / kSegments];
    const float width = at.high - at.low;
    const float start = at.low + width * (0.1F + 0.1F * static_cast<float>(i % 16) / 16);
    front.push_back(start);
    back.push_back(start + width * (0.5F + crossed));
    if (i % 32 >= 16) std::swap(front.back(), back.back());
  }
  std::vector<float> red(kSegments), green(kSegments), blue(kSegments), transmittance(kSegments);
  for (auto _ : state) {
    segment_lights(tf, {front, back, length, red, green, blue, transmittance});
    benchmark::DoNotOptimize(red.data());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kSegments));
}

const auto kMilliseconds = benchmark::kMillisecond;

BENCHMARK_CAPTURE(segment, thin_in_one_piece, 0.51, 0.53, 0.01);
BENCHMARK_CAPTURE(segment, whole_range_16_pieces, 0.0, 1.0, 1.0);
BENCHMARK_CAPTURE(segment, opaque, 0.2, 0.9, 1000.0);
BENCHMARK(lights_of_pieces)->Arg(10)->Arg(90)->Arg(400)->Arg(1000);
BENCHMARK(lights_of_segments)->Arg(0)->Arg(1)->Arg(2);

BENCHMARK_CAPTURE(table_2d, incremental, TableMethod::incremental)
    ->RangeMultiplier(2)
    ->Range(64, 1024)
    ->Unit(kMilliseconds)
    ->UseRealTime();
BENCHMARK_CAPTURE(table_2d, brute_force, TableMethod::brute_force)
    ->RangeMultiplier(2)
    ->Range(64, 1024)
    ->Unit(kMilliseconds)
    ->UseRealTime();
BENCHMARK_CAPTURE(table_3d, incremental, TableMethod::incremental)
    ->Args({32, 32})
    ->Args({64, 64})
    ->Args({128, 128})
    ->Args({256, 256})
    ->Unit(kMilliseconds)
    ->UseRealTime();
BENCHMARK_CAPTURE(table_3d, brute_force, TableMethod::brute_force)
    ->Args({32, 32})
    ->Args({64, 64})
    ->Args({128, 128})
    ->Args({256, 256})
    ->Unit(kMilliseconds)
    ->UseRealTime();
BENCHMARK_CAPTURE(table_3d, incremental_64_lengths, TableMethod::incremental)
    ->Args({256, 64})
    ->Unit(kMilliseconds)
    ->UseRealTime();

/// Besides the usual lines: the exponents with which the tables' times grow (least squares of the
/// logarithms), and how many times faster the incremental method is.
class GrowthReporter : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      const std::string name = run.run_name.function_name;
      if (name.starts_with("table") && run.run_type == Run::RT_Iteration) {
        times_[name][std::stod(run.run_name.args)] = run.GetAdjustedRealTime();
      }
    }
  }

  void Finalize() override {
    ConsoleReporter::Finalize();
    for (const auto& [name, times] : times_) {
      if (times.size() < 3) continue;
      GetOutputStream() << name << ": n^" << exponent(times) << " over all sizes, n^"
                        << exponent({std::prev(times.end(), 3), times.end()})
                        << " over the largest three\n";
    }
    for (const std::string kind : {"table_2d/", "table_3d/"}) {
      for (const auto& [n, time] : times_[kind + "brute_force"]) {
        GetOutputStream() << kind << n << ": incremental " << time / times_[kind + "incremental"][n]
                          << " times faster\n";
      }
    }
  }

 private:
  using Times = std::map<double, double>;

  static double exponent(const Times& times) {
    double x = 0, y = 0, xx = 0, xy = 0;
    for (const auto& [n, time] : times) {
      x += std::log(n);
      y += std::log(time);
      xx += std::log(n) * std::log(n);
      xy += std::log(n) * std::log(time);
    }
    const auto count = static_cast<double>(times.size());
    return (count * xy - x * y) / (count * xx - x * x);
  }

  std::map<std::string, Times> times_;
};

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  GrowthReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  return 0;
}
