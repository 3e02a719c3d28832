#include "mesh/heat_sink.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <vector>

#include "base/errors.h"
#include "mesh/heat_conduction.h"
#include "mesh/tetrahedralize.h"

namespace tetraglass::mesh {
namespace {

constexpr double kMillimetre = 1e-3;
constexpr double kSide = 60;     // mm, of the plate
constexpr double kPlate = 6;     // mm high
constexpr double kFins = 24;     // mm high
constexpr double kFinWidth = 2;  // mm
constexpr int kFinCount = 9;
constexpr double kChip = 20;  // mm, a square below the middle

constexpr double kConductivity = 200;  // W / (m K), aluminium
constexpr double kAir = 25;            // degrees Celsius
constexpr double kTransfer = 40;       // W / (m^2 K), air moved by a fan
constexpr std::size_t kPaperCells = 121668;
constexpr std::size_t kMostCells =
    100'000'000;  // TetGen counts what it stores of them in 32-bit integers

/// Left end of a fin: the first and last one stand at the rims of the plate.
double fin_start(int fin) {
  return (kSide - kFinWidth) * fin / (kFinCount - 1);
}

/// All planes x = const (or y = const) at which something begins or ends.
std::vector<double> planes(bool across_fins) {
  std::vector<double> result = {0, (kSide - kChip) / 2, (kSide + kChip) / 2, kSide};
  for (int fin = 0; across_fins && fin < kFinCount; ++fin) {
    result.push_back(fin_start(fin));
    result.push_back(fin_start(fin) + kFinWidth);
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

/// Whether the material fills the block of the layer (0: plate, 1: fins) around this x.
bool is_solid(double x, int layer) {
  if (layer == 0) return true;
  for (int fin = 0; fin < kFinCount; ++fin) {
    if (x > fin_start(fin) && x < fin_start(fin) + kFinWidth) return true;
  }
  return false;
}

bool is_on_chip(const Eigen::Vector3d& p) {
  const double low = (kSide - kChip) / 2 * kMillimetre;
  const double high = (kSide + kChip) / 2 * kMillimetre;
  return p.z() == 0 && p.x() > low && p.x() < high && p.y() > low && p.y() < high;
}

}  // namespace

MeshData heat_sink_surface() {
  const std::array<std::vector<double>, 3> axes = {
      planes(true), planes(false), {0, kPlate, kPlate + kFins}};
  using Index = std::array<int, 3>;
  const auto size = [&](std::size_t axis) { return static_cast<int>(axes[axis].size()) - 1; };
  const auto solid = [&](const Index& block) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (block[axis] < 0 || block[axis] >= size(axis)) return false;
    }
    const auto x = static_cast<std::size_t>(block[0]);
    return is_solid((axes[0][x] + axes[0][x + 1]) / 2, block[2]);
  };
  MeshData data;
  std::map<Index, std::uint32_t> numbers;
  const auto corner = [&](const Index& at) {
    const auto [found, is_new] =
        numbers.try_emplace(at, static_cast<std::uint32_t>(data.points.size()));
    if (is_new) {
      Eigen::Vector3d p;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        p[static_cast<int>(axis)] = axes[axis][static_cast<std::size_t>(at[axis])] * kMillimetre;
      }
      data.points.push_back(p);
    }
    return found->second;
  };
  // A block's side is a face of the surface where the block beyond it is empty.
  const auto add_side = [&](const Index& block, std::size_t axis, int direction) {
    Index beyond = block;
    beyond[axis] += direction;
    if (solid(beyond)) return;
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    std::array<std::uint32_t, 4> face{};
    constexpr std::array<std::array<int, 2>, 4> kAround = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    for (std::size_t k = 0; k < 4; ++k) {
      Index at = block;
      at[axis] += direction > 0 ? 1 : 0;
      at[u] += kAround[k][0];
      at[v] += kAround[k][1];
      face[direction > 0 ? k : 3 - k] = corner(at);
    }
    data.add_cell(CellType::quad, face);
  };
  for (int k = 0; k < size(2); ++k) {
    for (int j = 0; j < size(1); ++j) {
      for (int i = 0; i < size(0); ++i) {
        if (!solid({i, j, k})) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          for (const int direction : {-1, 1}) add_side({i, j, k}, axis, direction);
        }
      }
    }
  }
  return data;
}

TetMesh make_heat_sink(std::size_t cells) {
  if (cells > kMostCells) {
    throw base::UsageError(
        "a heat sink of so many cells is more than TetGen can make; ask for at most 100 million");
  }
  std::vector<std::string> notes;  // a sample has nothing to tell that its name does not
  FillOptions options;
  options.cells = static_cast<double>(cells == 0 ? kPaperCells : cells);
  TetMesh mesh = fill_surface(heat_sink_surface(), notes, options);
  HeatProblem problem;
  problem.conductivity = kConductivity;
  problem.ambient = kAir;
  problem.surface = [](const Eigen::Vector3d& p) {
    constexpr double kChipArea = kChip * kChip * kMillimetre * kMillimetre;
    return is_on_chip(p) ? SurfaceCondition{0, kChipPower / kChipArea}
                         : SurfaceCondition{kTransfer, 0};
  };
  mesh.fields = {{"temperature", Location::point, 1, steady_temperature(mesh, problem)}};
  return mesh;
}

}  // namespace tetraglass::mesh
