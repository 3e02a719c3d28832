#include "mesh/samples.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "base/errors.h"
#include "base/suggest.h"

namespace tetraglass::mesh {
namespace {

using Eigen::Vector3d;

// rho^6 (cos t sin^2 t cos 2p)^2 exp(-2 k rho) is largest at rho = 3 / k, sin^2 t = 2/3 and
// cos 2p = +-1; there the angular factor is 4/27.
double orbital(const Vector3d& p) {
  constexpr double kDecay = 8;
  static const double largest = 4.0 / 27.0 * std::pow(3 / kDecay, 6) * std::exp(-6.0);
  const double wave = p.z() * (p.x() * p.x() - p.y() * p.y());
  return wave * wave * std::exp(-2 * kDecay * p.norm()) / largest;
}

double sphere(const Vector3d& p) {
  return p.norm();
}

double linear(const Vector3d& p) {
  return 0.5 + (p.x() + 2 * p.y() + 3 * p.z()) / 12;
}

// The corners of a voxel are numbered by their offsets: bit 0 is x, bit 1 y, bit 2 z. A voxel keeps
// the tetrahedron of four alternating corners and cuts off the other four; the odd voxel is the
// mirror image of the even one, so the diagonals of a common side agree.
constexpr std::array<std::array<std::array<int, 4>, 5>, 2> kVoxelCells = {{
    {{{0, 3, 6, 5}, {1, 3, 0, 5}, {2, 0, 3, 6}, {4, 5, 0, 6}, {7, 3, 5, 6}}},
    {{{1, 2, 4, 7}, {0, 1, 2, 4}, {3, 2, 1, 7}, {5, 1, 4, 7}, {6, 4, 2, 7}}},
}};

// The number of points along an edge for which 5 (n - 1)^3 comes nearest to `cells`.
std::size_t grid_size(std::size_t cells) {
  if (cells == 0) return 32;
  const auto count = [](std::size_t voxels) { return 5.0 * std::pow(double(voxels), 3); };
  const double wanted = static_cast<double>(cells);
  auto low = static_cast<std::size_t>(std::cbrt(wanted / 5));
  if (low < 1) return 2;
  return (wanted - count(low) <= count(low + 1) - wanted ? low : low + 1) + 1;
}

using FieldFunction = double (*)(const Vector3d&);

TetMesh make_grid(const std::string& name, std::size_t cells, FieldFunction f) {
  const std::size_t n = grid_size(cells);
  if (double(n) * double(n) * double(n) > double(std::numeric_limits<std::uint32_t>::max())) {
    throw base::UsageError(fmt::format(
        "a sample of {} cells has more points than 32-bit indices can number; ask for fewer",
        cells));
  }
  TetMesh mesh;
  mesh.points.resize(n * n * n);
  mesh.fields.push_back({name, Location::point, 1, std::vector<double>(n * n * n)});
  std::vector<double>& values = mesh.fields[0].values;
  const auto coordinate = [n](std::size_t i) { return 2 * double(i) / double(n - 1) - 1; };
  tbb::parallel_for(std::size_t{0}, n, [&](std::size_t k) {
    std::size_t index = k * n * n;
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t i = 0; i < n; ++i, ++index) {
        mesh.points[index] = {coordinate(i), coordinate(j), coordinate(k)};
        values[index] = f(mesh.points[index]);
      }
    }
  });
  const std::size_t voxels = n - 1;
  mesh.cells.resize(5 * voxels * voxels * voxels);
  tbb::parallel_for(std::size_t{0}, voxels, [&](std::size_t k) {
    Cell* next = mesh.cells.data() + 5 * voxels * voxels * k;
    for (std::size_t j = 0; j < voxels; ++j) {
      for (std::size_t i = 0; i < voxels; ++i) {
        for (const auto& corners : kVoxelCells[(i + j + k) % 2]) {
          Cell& cell = *next++;
          for (std::size_t v = 0; v < 4; ++v) {
            const auto bits = static_cast<std::size_t>(corners[v]);
            cell[v] = static_cast<std::uint32_t>(((k + (bits >> 2)) * n + j + (bits >> 1 & 1)) * n +
                                                 i + (bits & 1));
          }
        }
      }
    }
  });
  return mesh;
}

struct Sample {
  const char* name;
  TetMesh (*make)(const std::string& name, std::size_t cells);
};

constexpr std::array kSamples = {
    Sample{"orbital", [](const auto& name, auto cells) { return make_grid(name, cells, orbital); }},
    Sample{"sphere", [](const auto& name, auto cells) { return make_grid(name, cells, sphere); }},
    Sample{"linear", [](const auto& name, auto cells) { return make_grid(name, cells, linear); }},
};

}  // namespace

std::vector<std::string> sample_names() {
  std::vector<std::string> names;
  for (const Sample& sample : kSamples) names.emplace_back(sample.name);
  return names;
}

TetMesh make_sample(const std::string& name, std::size_t cells) {
  for (const Sample& sample : kSamples) {
    if (name == sample.name) return sample.make(name, cells);
  }
  throw base::UsageError(
      fmt::format("no sample '{}'{}", name, base::suggestion(name, sample_names())));
}

}  // namespace tetraglass::mesh
