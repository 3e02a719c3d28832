// Visibility orders, VTK's beside them; items are cells. The eye goes around the mesh from frame to
// frame.

#include <array>
#include <map>
#include <memory>
#include <numeric>
#include <string>
#include <utility>

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <vtkCamera.h>
#include <vtkCellCenterDepthSort.h>
#include <vtkIdTypeArray.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkUnstructuredGrid.h>

#include "base/errors.h"
#include "bench/random_delaunay.h"
#include "bench/vtk_grid.h"
#include "mesh/samples.h"
#include "sort/cell_sorter.h"

namespace {

using namespace tetraglass;
using Eigen::Vector3d;
using sort::Method;

// The last mesh made is kept: benchmarks of one mesh follow each other.
const mesh::TetMesh& make_mesh(const std::string& name, std::int64_t cells) {
  static std::pair<std::string, std::int64_t> which;
  static mesh::TetMesh mesh;
  if (which != std::pair(name, cells)) {
    const auto n = static_cast<std::size_t>(cells);
    mesh = name == "random" ? bench::random_delaunay(static_cast<int>(static_cast<double>(cells) /
                                                                      bench::kCellsPerPoint))
                            : mesh::make_sample(name, n);
    which = {name, cells};
  }
  return mesh;
}

// A few degrees between views that follow each other.
class Flight {
 public:
  Flight(const mesh::TetMesh& mesh, bool parallel)
      : box_(mesh::bounds(mesh)), parallel_(parallel) {}

  sort::View next() {
    angle_ += 0.05;
    const Vector3d away = Vector3d(std::cos(angle_), std::sin(angle_), 0.6).normalized();
    return {parallel_, box_.center() + 1.5 * box_.diagonal().norm() * away, -away};
  }

 private:
  mesh::Box box_;
  bool parallel_;
  double angle_ = 0.6;
};

void order(benchmark::State& state, const std::string& name, Method method, bool parallel) {
  const mesh::TetMesh& mesh = make_mesh(name, state.range(0));
  std::vector<std::uint32_t> cells(mesh.cells.size());
  std::iota(cells.begin(), cells.end(), 0U);
  sort::CellSorter sorter(method, mesh, cells);
  Flight flight(mesh, parallel);
  benchmark::DoNotOptimize(sorter.sort(flight.next()));  // its buffers are made
  for (auto _ : state) benchmark::DoNotOptimize(sorter.sort(flight.next()).cells.data());
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(cells.size()));
}

// Also by centroids, to the end: it sorts further while it hands out the cells.
void vtk_cell_center_depth_sort(benchmark::State& state, const std::string& name, bool parallel) {
  const mesh::TetMesh& mesh = make_mesh(name, state.range(0));
  const vtkNew<vtkUnstructuredGrid> grid = bench::vtk_grid(mesh);
  const vtkNew<vtkCamera> camera;
  const vtkNew<vtkMatrix4x4> model;
  camera->SetParallelProjection(parallel ? 1 : 0);
  const vtkNew<vtkCellCenterDepthSort> sorter;
  sorter->SetInput(grid);
  sorter->SetCamera(camera);
  sorter->SetModelTransform(model);
  sorter->SetDirectionToBackToFront();
  Flight flight(mesh, parallel);
  for (auto _ : state) {
    const sort::View view = flight.next();
    const Vector3d target = view.eye + view.direction;
    camera->SetPosition(view.eye.data());
    camera->SetFocalPoint(target.data());
    sorter->InitTraversal();
    while (vtkIdTypeArray* some = sorter->GetNextCells()) benchmark::DoNotOptimize(some);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mesh.cells.size()));
}

void add(const std::string& mesh, std::int64_t size) {
  const auto set = [size](benchmark::internal::Benchmark* bench) {
    bench->Arg(size)->Unit(benchmark::kMillisecond)->UseRealTime();
  };
  for (const bool parallel : {true, false}) {
    const std::string view = parallel ? "/parallel" : "/perspective";
    for (const Method method : {Method::centroid, Method::power, Method::mpvo}) {
      if (method == Method::power && mesh == "shells") continue;  // not Delaunay
      set(benchmark::RegisterBenchmark(
          fmt::format("{}/{}{}", mesh, to_string(method), view).c_str(), order, mesh, method,
          parallel));
    }
    set(benchmark::RegisterBenchmark(fmt::format("{}/vtk{}", mesh, view).c_str(),
                                     vtk_cell_center_depth_sort, mesh, parallel));
  }
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  // Random points' Delaunay mesh, a grid of 5 cells per voxel, four shells in each other.
  for (const std::int64_t size : {100000, 1000000}) add("random", size);
  for (const std::int64_t size : {100000, 1000000, 10000000}) add("sphere", size);
  add("shells", 100000);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
