#include "mesh/samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

#include "base/errors.h"
#include "base/suggest.h"
#include "mesh/heat_sink.h"
#include "mesh/voxel_grid.h"

namespace tetraglass::mesh {
namespace {

using Eigen::Vector3d;

// rho^6 (cos t sin^2 t cos 2p)^2 exp(-2 k rho) is largest at rho = 3 / k, sin^2 t = 2/3 and
// cos 2p = +-1; there the angular factor is 4/27.
double orbital(const Vector3d& p) {
  constexpr double kDecay = 8;
  static const double kLargest = 4.0 / 27.0 * std::pow(3 / kDecay, 6) * std::exp(-6.0);
  const double wave = p.z() * (p.x() * p.x() - p.y() * p.y());
  return wave * wave * std::exp(-2 * kDecay * p.norm()) / kLargest;
}

double distance_from_origin(const Vector3d& p) {
  return p.norm();
}

double linear(const Vector3d& p) {
  return 0.5 + (p.x() + 2 * p.y() + 3 * p.z()) / 12;
}

// Bytes that are not in use, of this machine; those of all its memory where that is not told.
double available_memory() {
  std::ifstream stream("/proc/meminfo");
  std::string key;
  double kilobytes = 0;
  std::string unit;
  while (stream >> key >> kilobytes && std::getline(stream, unit)) {
    if (key == "MemAvailable:") return 1024 * kilobytes;
  }
  return static_cast<double>(::sysconf(_SC_PHYS_PAGES)) *
         static_cast<double>(::sysconf(_SC_PAGESIZE));
}

// Before a sample is made: whether it will fit into the memory.
void check_sample_fits(double cells, double bytes) {
  constexpr double kProgram = 1.2e8;
  const double memory = available_memory();
  if (bytes + kProgram <= memory) return;
  constexpr double kGigabyte = 1e9;
  throw base::UsageError(
      fmt::format("a sample of {:.3g} cells takes {:.3g} GB of memory; {:.3g} GB are free", cells,
                  bytes / kGigabyte, memory / kGigabyte));
}

// What a mesh takes with the copy of it that is written: of each cell its indices, in 32 bits here
// and in 64 there, where it begins and its type; of each point its place and the field, twice.
double bytes_of_grid(double points, double cells) {
  return cells * (sizeof(Cell) + 5 * sizeof(std::int64_t) + 1) +
         points * 2 * (sizeof(Vector3d) + sizeof(double));
}

// The number of points along an edge for which 5 (n - 1)^3 comes nearest to `cells`.
std::size_t grid_size(double cells) {
  const auto count = [](double voxels) { return 5 * voxels * voxels * voxels; };
  const double low = std::max(1.0, std::floor(std::cbrt(cells / 5)));
  const double voxels = cells - count(low) <= count(low + 1) - cells ? low : low + 1;
  const double points = (voxels + 1) * (voxels + 1) * (voxels + 1);
  if (!(points < double(std::numeric_limits<std::uint32_t>::max()))) {
    throw base::UsageError(fmt::format(
        "a sample of {:.0f} cells has more points than 32-bit indices can number; ask for fewer",
        cells));
  }
  check_sample_fits(count(voxels), bytes_of_grid(points, count(voxels)));
  return static_cast<std::size_t>(voxels) + 1;
}

constexpr std::size_t kWeilerSize = 32;

std::size_t grid_size_or_default(std::size_t cells) {
  return cells == 0 ? kWeilerSize : grid_size(static_cast<double>(cells));
}

std::vector<double> even_axis(std::size_t n) {
  std::vector<double> axis(n);
  for (std::size_t i = 0; i < n; ++i) axis[i] = 2 * double(i) / double(n - 1) - 1;
  return axis;
}

TetMesh make_grid(std::size_t cells) {
  return make_voxel_grid(even_axis(grid_size_or_default(cells)));
}

// The even axis, bent so that the distances from 0 form a geometric sequence from 1 down to 2^-26.
TetMesh make_needles(std::size_t cells) {
  constexpr double kExponent = 26;
  std::vector<double> axis = even_axis(grid_size_or_default(cells));
  const std::size_t n = axis.size();
  const double smallest = n % 2 == 0 ? axis[n / 2] : axis[n / 2 + 1];
  for (double& x : axis) {
    if (x == 0 || smallest == 1) continue;
    x = std::copysign(std::exp2(-kExponent * (1 - std::abs(x)) / (1 - smallest)), x);
  }
  return make_voxel_grid(axis);
}

// Of seven cubic layers of the same thickness every other one, each point then drawn towards the
// sphere through the middle of its cube's sides.
TetMesh make_shells(std::size_t cells) {
  constexpr double kLayers = 7;
  constexpr double kShare = (343 - 216 + 125 - 64 + 27 - 8 + 1) / 343.0;  // of the voxels kept
  constexpr std::size_t kLeast = 15;  // 14 voxels: each layer has one on either side
  const std::size_t n = cells == 0 ? kWeilerSize : grid_size(double(cells) / kShare);
  TetMesh mesh = make_voxel_grid(even_axis(std::max(n, kLeast)));
  keep_voxels(mesh, [](const Vector3d& center) {
    return static_cast<int>(kLayers * center.cwiseAbs().maxCoeff()) % 2 == 0;
  });
  for (Vector3d& p : mesh.points) {
    // Drawn all the way, the cells at the edges of the cubes would become flat.
    constexpr double kRoundness = 0.8;
    const double norm = p.norm();
    if (norm > 0) p *= 1 - kRoundness + kRoundness * p.cwiseAbs().maxCoeff() / norm;
  }
  return mesh;
}

TetMesh make_cavity(std::size_t cells) {
  // Left out: a box inside, a square tunnel along z, and an octant's corner.
  const Box cavity(Vector3d(-0.75, -0.75, -0.5), Vector3d(-0.25, -0.25, 0.5));
  const Box tunnel(Vector3d(0.25, -0.75, -2), Vector3d(0.75, -0.25, 2));
  const Box corner(Vector3d(0, 0.25, 0), Vector3d(2, 2, 2));
  constexpr double kShare = 1 - (0.5 * 0.5 * 1 + 0.5 * 0.5 * 2 + 1 * 0.75 * 1) / 8;
  constexpr std::size_t kLeast = 9;  // 8 voxels: their sides meet those of the boxes
  const std::size_t n = cells == 0 ? kWeilerSize : grid_size(double(cells) / kShare);
  TetMesh mesh = make_voxel_grid(even_axis(std::max(n, kLeast)));
  keep_voxels(mesh, [&](const Vector3d& center) {
    return !cavity.contains(center) && !tunnel.contains(center) && !corner.contains(center);
  });
  return mesh;
}

void add_positive(TetMesh& mesh, Cell cell) {
  const auto& p = mesh.points;
  const Vector3d& a = p[cell[0]];
  if ((p[cell[1]] - a).cross(p[cell[2]] - a).dot(p[cell[3]] - a) < 0) std::swap(cell[2], cell[3]);
  mesh.cells.push_back(cell);
}

// A ring of triangular prisms whose cross-sections lean over by 45 degrees, like roof tiles: each
// lies on the next one. A prism is cut into the three cells of a stack, so that the faces in
// between lean too.
void add_ring(TetMesh& mesh, std::uint32_t sections) {
  constexpr std::array<std::array<double, 2>, 3> kSection = {{{0.6, 0.2}, {1, 0.2}, {0.8, -0.2}}};
  for (std::uint32_t i = 0; i < sections; ++i) {
    const double angle = 2 * std::numbers::pi * i / sections;
    const Vector3d outwards(std::cos(angle), std::sin(angle), 0);
    const Vector3d leaning =
        (Vector3d(-outwards.y(), outwards.x(), 0) + Vector3d::UnitZ()) / std::numbers::sqrt2;
    for (const auto& [radius, height] : kSection) {
      mesh.points.emplace_back(radius * outwards + height * leaning);
    }
  }
  for (std::uint32_t i = 0; i < sections; ++i) {
    const std::uint32_t a = 3 * i;
    const std::uint32_t b = 3 * ((i + 1) % sections);
    add_positive(mesh, {a, a + 1, a + 2, b});
    add_positive(mesh, {a + 1, a + 2, b, b + 1});
    add_positive(mesh, {a + 2, b, b + 1, b + 2});
  }
}

// Three rising bars along the sides of a triangle: the high end of each lies over the low end of
// the next.
void add_bars(TetMesh& mesh) {
  constexpr double kToSide = 0.1;  // from the middle of the triangle
  constexpr double kHalfLength = 0.28;
  constexpr double kRise = 0.1;
  constexpr double kHalfWidth = 0.03;
  for (int i = 0; i < 3; ++i) {
    const double angle = 2 * std::numbers::pi * i / 3;
    const Vector3d outwards(std::cos(angle), std::sin(angle), 0);
    const Vector3d along(-outwards.y(), outwards.x(), 0);
    const Vector3d half = kHalfLength * along + kRise * Vector3d::UnitZ();
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.emplace_back(kToSide * outwards - half - kHalfWidth * outwards);
    mesh.points.emplace_back(kToSide * outwards - half + kHalfWidth * outwards);
    mesh.points.emplace_back(kToSide * outwards + half - kHalfWidth * Vector3d::UnitZ());
    mesh.points.emplace_back(kToSide * outwards + half + kHalfWidth * Vector3d::UnitZ());
    add_positive(mesh, {first, first + 1, first + 2, first + 3});
  }
}

TetMesh make_cycle(std::size_t cells) {
  constexpr std::size_t kDefault = 8;
  constexpr std::size_t kLeast = 5;  // below, prisms of that lean would run into each other
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max() / 3 - 4;
  const std::size_t sections =
      cells == 0 ? kDefault : std::max(kLeast, (std::max<std::size_t>(cells, 3) - 2) / 3);
  if (sections > kMost) {
    throw base::UsageError(
        "a sample of so many cells has more points than 32-bit indices can number");
  }
  const double size = 3.0 * double(sections);
  check_sample_fits(size, bytes_of_grid(size, size));
  TetMesh mesh;
  add_ring(mesh, static_cast<std::uint32_t>(sections));
  add_bars(mesh);
  return mesh;
}

TetMesh make_heat_sink_that_fits(std::size_t cells) {
  constexpr double kBytesPerCell = 600;  // of TetGen and the solver, as measured
  check_sample_fits(double(cells), double(cells) * kBytesPerCell);
  return make_heat_sink(cells);
}

struct Sample {
  const char* name;
  TetMesh (*make)(std::size_t cells);
  double (*field)(const Vector3d&);  ///< null: `make` has added the field
};

constexpr std::array kSamples = {
    Sample{"orbital", make_grid, orbital}, Sample{"sphere", make_grid, distance_from_origin},
    Sample{"linear", make_grid, linear},   Sample{"needles", make_needles, linear},
    Sample{"shells", make_shells, linear}, Sample{"cavity", make_cavity, linear},
    Sample{"cycle", make_cycle, linear},   Sample{"heat-sink", make_heat_sink_that_fits, nullptr},
};

}  // namespace

std::vector<std::string> sample_names() {
  std::vector<std::string> names;
  names.reserve(kSamples.size());
  for (const Sample& sample : kSamples) names.emplace_back(sample.name);
  return names;
}

TetMesh make_sample(const std::string& name, std::size_t cells) {
  const auto* sample = std::find_if(kSamples.begin(), kSamples.end(),
                                    [&](const Sample& known) { return name == known.name; });
  if (sample == kSamples.end()) {
    throw base::UsageError(
        fmt::format("no sample '{}'{}", name, base::suggestion(name, sample_names())));
  }
  TetMesh mesh = sample->make(cells);
  if (sample->field == nullptr) return mesh;
  Field& field = mesh.fields.emplace_back(Field{name, Location::point, 1, {}});
  field.values.resize(mesh.points.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.points.size(), 4096),
                    [&](const auto& range) {
                      for (std::size_t i = range.begin(); i != range.end(); ++i) {
                        field.values[i] = sample->field(mesh.points[i]);
                      }
                    });
  return mesh;
}

}  // namespace tetraglass::mesh
