#include "mesh/read_tetgen.h"

#include <array>
#include <filesystem>
#include <vector>

#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/text_lines.h"

namespace tetraglass::mesh {
namespace {

/// Attributes as fields: `name` if there is one, else `name 0`, `name 1`, ...
std::vector<Field> attribute_fields(const std::string& name, Location location, std::size_t count) {
  std::vector<Field> fields;
  for (std::size_t i = 0; i < count; ++i) {
    fields.push_back({count == 1 ? name : fmt::format("{} {}", name, i), location, 1, {}});
  }
  return fields;
}

/// Returns the number that the first point has.
std::int64_t read_points(const std::string& file, MeshData& mesh) {
  TextLines lines(file);
  lines.expect("the number of points");
  const std::size_t count = lines.count(0, "points");
  if (lines.words().size() > 1 && lines.integer(1) != 3) {
    lines.fail("points have to have 3 coordinates");
  }
  const std::size_t attributes = lines.words().size() > 2 ? lines.count(2, "attributes") : 0;
  std::vector<Field> fields = attribute_fields("attribute", Location::point, attributes);
  std::int64_t first = 0;
  for (std::size_t i = 0; i < count; ++i) {
    lines.expect(fmt::format("point {} of {}", i + 1, count));
    const std::int64_t number = lines.integer(0);
    if (i == 0) first = number;
    if (number != first + static_cast<std::int64_t>(i)) {
      lines.fail(fmt::format("point {} follows point {}", number,
                             first + static_cast<std::int64_t>(i) - 1));
    }
    mesh.points.emplace_back(lines.number(1), lines.number(2), lines.number(3));
    for (std::size_t k = 0; k < attributes; ++k) fields[k].values.push_back(lines.number(4 + k));
  }
  if (first != 0 && first != 1) lines.fail("points have to be counted from 0 or 1");
  for (Field& field : fields) mesh.fields.push_back(std::move(field));
  return first;
}

void read_tetrahedra(const std::string& file, std::int64_t first, MeshData& mesh) {
  TextLines lines(file);
  lines.expect("the number of tetrahedra");
  const std::size_t count = lines.count(0, "tetrahedra");
  const std::int64_t corners = lines.words().size() > 1 ? lines.integer(1) : 4;
  if (corners != 4 && corners != 10) lines.fail("tetrahedra have to have 4 or 10 points");
  const std::size_t attributes = lines.words().size() > 2 ? lines.count(2, "attributes") : 0;
  std::vector<Field> fields = attribute_fields("region", Location::cell, attributes);
  // TetGen's order of the points on the edges, in VTK's.
  constexpr std::array<std::size_t, 10> kOrder = {0, 1, 2, 3, 6, 7, 9, 5, 8, 4};
  const auto size = static_cast<std::size_t>(corners);
  std::vector<std::uint32_t> cell(size);
  for (std::size_t i = 0; i < count; ++i) {
    lines.expect(fmt::format("tetrahedron {} of {}", i + 1, count));
    for (std::size_t k = 0; k < size; ++k) {
      cell[k] = lines.index(1 + kOrder[k], mesh.points.size(), first);
    }
    mesh.add_cell(size == 4 ? CellType::tetra : CellType::quadratic_tetra, cell);
    for (std::size_t k = 0; k < attributes; ++k) {
      fields[k].values.push_back(lines.number(1 + size + k));
    }
  }
  for (Field& field : fields) mesh.fields.push_back(std::move(field));
}

}  // namespace

MeshData read_tetgen(const std::string& file) {
  const std::filesystem::path path(file);
  const std::string nodes = std::filesystem::path(path).replace_extension(".node").string();
  const std::string elements = std::filesystem::path(path).replace_extension(".ele").string();
  const bool has_elements = std::filesystem::is_regular_file(elements);
  if (!std::filesystem::is_regular_file(nodes)) {
    throw base::ReadError(file, fmt::format("the file with its points, {}, is missing", nodes));
  }
  MeshData mesh;
  const std::int64_t first = read_points(nodes, mesh);
  if (has_elements) read_tetrahedra(elements, first, mesh);
  return mesh;
}

}  // namespace tetraglass::mesh
