#include "mesh/read_plot3d.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <vector>

#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/memory.h"
#include "mesh/plot3d_blocks.h"

namespace tetraglass::mesh {
namespace {

/// The names a solution may have beside that grid file, likeliest first.
std::vector<std::string> solution_names(const std::string& grid) {
  const std::filesystem::path path(grid);
  const std::string stem = path.stem().string();
  std::vector<std::string> names;
  constexpr std::string_view kGridWord = "xyz";
  if (stem.size() > kGridWord.size() && stem.ends_with(kGridWord)) {
    names.push_back(stem.substr(0, stem.size() - kGridWord.size()) + "q" +
                    path.extension().string());
  }
  names.push_back(stem + ".q");
  names.push_back(stem + ".Q");
  for (std::string& name : names) name = (path.parent_path() / name).string();
  return names;
}

void add_grid(MeshData& mesh, const Plot3dBlock& grid) {
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  const std::size_t points = grid.dimensions.points();
  for (std::size_t i = 0; i < points; ++i) {
    mesh.points.emplace_back(grid.values[i], grid.values[points + i], grid.values[2 * points + i]);
  }
  const auto [ni, nj, nk] = grid.dimensions.n;
  const auto visible = [&](std::uint32_t i) {
    return grid.blanks.empty() || grid.blanks[i - first] != 0;
  };
  std::size_t blanked = 0;
  for (std::uint64_t k = 0; k + 1 < nk; ++k) {
    for (std::uint64_t j = 0; j + 1 < nj; ++j) {
      for (std::uint64_t i = 0; i + 1 < ni; ++i) {
        const auto a = static_cast<std::uint32_t>(first + (k * nj + j) * ni + i);
        const auto b = static_cast<std::uint32_t>(a + ni);
        const auto up = static_cast<std::uint32_t>(ni * nj);
        const std::array<std::uint32_t, 8> corners = {a,      a + 1,      b + 1,      b,
                                                      a + up, a + 1 + up, b + 1 + up, b + up};
        if (std::ranges::all_of(corners, visible)) {
          mesh.add_cell(CellType::hexahedron, corners);
        } else {
          ++blanked;
        }
      }
    }
  }
  if (blanked > 0) mesh.notes.push_back(fmt::format("{} cells are blanked and left out", blanked));
}

void add_solution(MeshData& mesh, const std::vector<Plot3dBlock>& blocks,
                  const std::vector<Plot3dBlock>& grids) {
  Field density{"density", Location::point, 1, {}};
  Field momentum{"momentum", Location::point, 3, {}};
  Field energy{"stagnation_energy", Location::point, 1, {}};
  Field velocity{"velocity", Location::point, 3, {}};
  Field pressure{"pressure", Location::point, 1, {}};
  bool has_velocity = true;
  bool is_gas = true;
  bool is_constant = true;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const std::size_t n = blocks[b].dimensions.points();
    const std::vector<double>& q = blocks[b].values;
    for (std::size_t i = 0; i < n; ++i) {
      const double rho = q[i];
      const Eigen::Vector3d m(q[n + i], q[2 * n + i], q[3 * n + i]);
      const double e = q[4 * n + i];
      const Eigen::Vector3d u = m / rho;
      constexpr double kHeatRatio = 1.4;
      const double p = (kHeatRatio - 1) * (e - 0.5 * m.dot(u));
      density.values.push_back(rho);
      energy.values.push_back(e);
      pressure.values.push_back(p);
      momentum.values.insert(momentum.values.end(), m.begin(), m.end());
      velocity.values.insert(velocity.values.end(), u.begin(), u.end());
      if (!grids[b].blanks.empty() && grids[b].blanks[i] == 0) continue;
      has_velocity = has_velocity && rho != 0;
      is_gas = is_gas && rho > 0 && p > 0;
      is_constant = is_constant && rho == density.values.front();
    }
  }
  if (!is_gas && is_constant) {
    pressure.values = energy.values;
    mesh.notes.emplace_back(
        "the density is constant and the fifth channel is no energy of a gas: taken as the "
        "pressure");
  } else if (!is_gas) {
    mesh.notes.emplace_back("the solution is not that of an ideal gas: no pressure is derived");
  }
  mesh.fields.push_back(std::move(density));
  mesh.fields.push_back(std::move(momentum));
  if (is_gas || !is_constant) mesh.fields.push_back(std::move(energy));
  if (is_gas || is_constant) mesh.fields.push_back(std::move(pressure));
  if (has_velocity) mesh.fields.push_back(std::move(velocity));
}

void read_solution(MeshData& mesh, const std::string& file, const std::vector<Plot3dBlock>& grids) {
  std::vector<Plot3dDimensions> dimensions;
  for (const Plot3dBlock& grid : grids) dimensions.push_back(grid.dimensions);
  const auto same = [](const Plot3dBlock& block, const Plot3dDimensions& d) {
    return block.dimensions == d;
  };
  const auto blocks = read_plot3d_blocks(file, Plot3dContent::solution, &dimensions);
  if (!blocks || !std::ranges::equal(*blocks, dimensions, same)) {
    throw base::ReadError(file,
                          fmt::format("is not a complete PLOT3D solution for the grid beside "
                                      "it ({} x {} x {} points{})",
                                      dimensions[0].n[0], dimensions[0].n[1], dimensions[0].n[2],
                                      grids.size() > 1 ? ", the first of several" : ""));
  }
  add_solution(mesh, *blocks, grids);
}

}  // namespace

MeshData read_plot3d(const std::string& file) {
  const auto grids = read_plot3d_blocks(file, Plot3dContent::grid);
  if (!grids) {
    if (read_plot3d_blocks(file, Plot3dContent::solution)) {
      throw base::ReadError(file, "is a PLOT3D solution; give the grid file beside it instead");
    }
    throw base::ReadError(file,
                          fmt::format("is not a complete PLOT3D grid: its {} bytes agree with the "
                                      "dimensions at its head in no byte order and precision, with "
                                      "or without record marks and iblank",
                                      std::filesystem::file_size(file)));
  }
  MeshData mesh;
  std::size_t points = 0;
  for (const Plot3dBlock& grid : *grids) points += grid.dimensions.points();
  check_mesh_fits(points, points);
  for (const Plot3dBlock& grid : *grids) add_grid(mesh, grid);
  const std::vector<std::string> names = solution_names(file);
  const auto found = std::ranges::find_if(
      names, [](const std::string& name) { return std::filesystem::is_regular_file(name); });
  if (found != names.end()) {
    read_solution(mesh, *found, *grids);
    mesh.notes.push_back("solution: " + *found);
  } else {
    mesh.notes.push_back("there is no solution file beside it (" + names.front() + ")");
  }
  return mesh;
}

}  // namespace tetraglass::mesh
