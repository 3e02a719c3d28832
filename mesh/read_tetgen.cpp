#include "mesh/read_tetgen.h"

#include <array>
#include <filesystem>
#include <vector>

#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/file_name.h"
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
std::int64_t read_points(TextLines& lines, MeshData& mesh) {
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

/// A boundary of facets, from a file whose list of points may be empty: they are in NAME.node then.
class BoundaryReader {
 public:
  explicit BoundaryReader(const std::string& file) : file_(file), lines_(file) {}

  MeshData read(const std::string& extension);

 private:
  void read_facets();
  void read_polygons();
  void read_triangles();
  void note_rest();
  /// The polygon of the points from word `at` on; it may go on in the next lines.
  void add_polygon(std::size_t at, std::size_t size);

  std::string file_;
  TextLines lines_;
  MeshData mesh_;
  std::int64_t first_ = 0;
  std::size_t segments_ = 0;
};

std::string node_file(const std::string& file) {
  const std::string nodes = std::filesystem::path(file).replace_extension(".node").string();
  if (!std::filesystem::is_regular_file(nodes)) {
    throw base::ReadError(file, fmt::format("the file with its points, {}, is missing", nodes));
  }
  return nodes;
}

MeshData BoundaryReader::read(const std::string& extension) {
  const bool has_points = extension != ".face";
  if (has_points) first_ = read_points(lines_, mesh_);
  if (mesh_.points.empty()) {
    mesh_.fields.clear();
    TextLines lines(node_file(file_));
    first_ = read_points(lines, mesh_);
  }
  if (extension == ".face") {
    read_triangles();
  } else {
    extension == ".poly" ? read_facets() : read_polygons();
    note_rest();
  }
  if (segments_ > 0) {
    mesh_.notes.push_back(
        fmt::format("{} segments and points within facets are left out", segments_));
  }
  return std::move(mesh_);
}

void BoundaryReader::add_polygon(std::size_t at, std::size_t size) {
  std::vector<std::uint32_t> polygon;
  while (polygon.size() < size) {
    if (at == lines_.words().size()) {
      lines_.expect("the other points of a polygon");
      at = 0;
    }
    polygon.push_back(lines_.index(at++, mesh_.points.size(), first_));
  }
  if (size < 3) {
    ++segments_;
  } else {
    const CellType type = size == 3   ? CellType::triangle
                          : size == 4 ? CellType::quad
                                      : CellType::polygon;
    mesh_.add_cell(type, polygon);
  }
}

/// Facets of polygons, with holes.
void BoundaryReader::read_facets() {
  lines_.expect("the number of facets");
  const std::size_t count = lines_.count(0, "facets");
  for (std::size_t i = 0; i < count; ++i) {
    lines_.expect(fmt::format("facet {} of {}", i + 1, count));
    const std::size_t polygons = lines_.count(0, "polygons");
    const std::size_t holes = lines_.words().size() > 1 ? lines_.count(1, "holes") : 0;
    if (holes > 0) lines_.fail("facets with holes are not read; cut them into polygons without");
    const std::size_t before = mesh_.cell_count();
    for (std::size_t k = 0; k < polygons; ++k) {
      lines_.expect(fmt::format("polygon {} of facet {}", k + 1, i + 1));
      add_polygon(1, lines_.count(0, "points"));
    }
    // Its outline, and others that lie on it.
    if (mesh_.cell_count() > before + 1) {
      lines_.fail("facets of several polygons are not read; give each polygon a facet of its own");
    }
  }
}

void BoundaryReader::read_polygons() {
  lines_.expect("the number of facets");
  const std::size_t count = lines_.count(0, "facets");
  for (std::size_t i = 0; i < count; ++i) {
    lines_.expect(fmt::format("facet {} of {}", i + 1, count));
    add_polygon(1, lines_.count(0, "points"));
  }
}

void BoundaryReader::read_triangles() {
  lines_.expect("the number of faces");
  const std::size_t count = lines_.count(0, "faces");
  for (std::size_t i = 0; i < count; ++i) {
    lines_.expect(fmt::format("face {} of {}", i + 1, count));
    add_polygon(1, 3);
  }
}

void BoundaryReader::note_rest() {
  if (!lines_.next()) return;
  if (const std::size_t holes = lines_.count(0, "holes"); holes > 0) {
    mesh_.notes.push_back(
        fmt::format("{} points that tell of holes are not used: what is a cavity is told by the "
                    "direction of its faces",
                    holes));
  }
}

}  // namespace

MeshData read_tetgen(const std::string& file) {
  const std::string extension = extension_of(file);
  if (extension == ".poly" || extension == ".smesh" || extension == ".face") {
    return BoundaryReader(file).read(extension);
  }
  const std::string nodes = node_file(file);
  const std::string elements = std::filesystem::path(file).replace_extension(".ele").string();
  MeshData mesh;
  TextLines lines(nodes);
  const std::int64_t first = read_points(lines, mesh);
  if (std::filesystem::is_regular_file(elements)) read_tetrahedra(elements, first, mesh);
  return mesh;
}

}  // namespace tetraglass::mesh
