#include "mesh/append.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/memory.h"

namespace tetraglass::mesh {
namespace {

bool is_same(const Field& a, const Field& b) {
  return a.name == b.name && a.location == b.location && a.components == b.components;
}

void append_cells(MeshData& all, const MeshData& more) {
  const auto first = static_cast<std::uint32_t>(all.points.size());
  all.points.insert(all.points.end(), more.points.begin(), more.points.end());
  for (std::size_t i = 0; i < more.cell_count(); ++i) {
    all.types.push_back(more.types[i]);
    const std::span<const std::uint32_t> cell = more.cell(i);
    if (more.types[i] == CellType::polyhedron) {  // counts stand between the points
      std::size_t at = 0;
      const auto copy = [&](std::uint32_t offset) {
        all.connectivity.push_back(cell[at++] + offset);
      };
      if (!cell.empty()) copy(0);
      while (at < cell.size()) {
        const std::size_t end = std::min(cell.size(), at + 1 + cell[at]);
        copy(0);
        while (at < end) copy(first);
      }
    } else {
      for (const std::uint32_t point : cell) all.connectivity.push_back(first + point);
    }
    all.offsets.push_back(all.connectivity.size());
  }
}

}  // namespace

MeshData append_meshes(std::vector<MeshData> meshes) {
  if (meshes.empty()) throw base::InputError("holds no mesh");
  if (meshes.size() == 1) return std::move(meshes[0]);
  std::size_t points = 0;
  std::size_t cells = 0;
  MeshData all;
  for (const MeshData& mesh : meshes) {
    points += mesh.points.size();
    cells += mesh.cell_count();
    for (const Field& field : mesh.fields) {
      if (std::ranges::none_of(all.fields, [&](const Field& f) { return is_same(f, field); })) {
        all.fields.push_back({field.name, field.location, field.components, {}});
      }
    }
  }
  check_mesh_fits(points, cells);
  Field part{"part", Location::cell, 1, {}};
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    MeshData& mesh = meshes[m];
    append_cells(all, mesh);
    part.values.insert(part.values.end(), mesh.cell_count(), static_cast<double>(m));
    for (const std::string& note : mesh.notes) {
      const std::string line = fmt::format("part {}: {}", m, note);
      all.notes.push_back(line);
    }
    for (Field& field : all.fields) {
      const auto found =
          std::ranges::find_if(mesh.fields, [&](const Field& f) { return is_same(f, field); });
      const std::size_t places =
          field.location == Location::point ? mesh.points.size() : mesh.cell_count();
      if (found != mesh.fields.end()) {
        field.values.insert(field.values.end(), found->values.begin(), found->values.end());
      } else {
        field.values.insert(field.values.end(), places * static_cast<std::size_t>(field.components),
                            std::numeric_limits<double>::quiet_NaN());
      }
    }
    mesh = {};
  }
  all.fields.push_back(std::move(part));
  return all;
}

}  // namespace tetraglass::mesh
