#include "mesh/read_tetgen.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <vector>

#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/file_name.h"
#include "mesh/text_lines.h"
#include "mesh/triangulate_facet.h"

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
  using Polygon = std::vector<std::uint32_t>;

  void read_facets();
  void read_polygons();
  void read_triangles();
  void read_marks();
  [[nodiscard]] Eigen::Vector3d place() const;
  /// The polygon of the points from word `at` on; it may go on in the next lines.
  Polygon read_polygon(std::size_t at, std::size_t size);
  void add_facet(const std::vector<Polygon>& polygons, const std::vector<Eigen::Vector3d>& holes);

  std::string file_;
  TextLines lines_;
  MeshData mesh_;
  std::int64_t first_ = 0;
  std::size_t loose_ = 0;  ///< facets that are points and segments alone
};

std::string node_file(const std::string& file) {
  std::string nodes = std::filesystem::path(file).replace_extension(".node").string();
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
    read_marks();
  }
  if (loose_ > 0) {
    mesh_.notes.push_back(
        fmt::format("{} facets that are points or segments alone are left out", loose_));
  }
  return std::move(mesh_);
}

BoundaryReader::Polygon BoundaryReader::read_polygon(std::size_t at, std::size_t size) {
  Polygon polygon;
  while (polygon.size() < size) {
    if (at == lines_.words().size()) {
      lines_.expect("the other points of a polygon");
      at = 0;
    }
    polygon.push_back(lines_.index(at++, mesh_.points.size(), first_));
  }
  return polygon;
}

void BoundaryReader::add_facet(const std::vector<Polygon>& polygons,
                               const std::vector<Eigen::Vector3d>& holes) {
  if (std::ranges::all_of(polygons, [](const Polygon& polygon) { return polygon.size() < 3; })) {
    ++loose_;
  } else if (polygons.size() == 1 && polygons[0].size() == 3 && holes.empty()) {
    mesh_.add_cell(CellType::triangle, polygons[0]);
  } else {
    try {
      for (const auto& t : triangulate_facet(mesh_.points, polygons, holes)) {
        mesh_.add_cell(CellType::triangle, t);
      }
    } catch (const base::InputError& error) {
      lines_.fail(error.what());
    }
  }
}

/// Facets of polygons, with holes.
void BoundaryReader::read_facets() {
  lines_.expect("the number of facets");
  const std::size_t count = lines_.count(0, "facets");
  for (std::size_t i = 0; i < count; ++i) {
    lines_.expect(fmt::format("facet {} of {}", i + 1, count));
    std::vector<Polygon> polygons(lines_.count(0, "polygons"));
    std::vector<Eigen::Vector3d> holes(lines_.words().size() > 1 ? lines_.count(1, "holes") : 0);
    for (std::size_t k = 0; k < polygons.size(); ++k) {
      lines_.expect(fmt::format("polygon {} of facet {}", k + 1, i + 1));
      polygons[k] = read_polygon(1, lines_.count(0, "points"));
    }
    for (std::size_t k = 0; k < holes.size(); ++k) {
      lines_.expect(fmt::format("hole {} of facet {}", k + 1, i + 1));
      holes[k] = place();
    }
    add_facet(polygons, holes);
  }
}

void BoundaryReader::read_polygons() {
  lines_.expect("the number of facets");
  const std::size_t count = lines_.count(0, "facets");
  for (std::size_t i = 0; i < count; ++i) {
    lines_.expect(fmt::format("facet {} of {}", i + 1, count));
    add_facet({read_polygon(1, lines_.count(0, "points"))}, {});
  }
}

void BoundaryReader::read_triangles() {
  lines_.expect("the number of faces");
  const std::size_t count = lines_.count(0, "faces");
  for (std::size_t i = 0; i < count; ++i) {
    lines_.expect(fmt::format("face {} of {}", i + 1, count));
    add_facet({read_polygon(1, 3)}, {});
  }
}

/// After the number of a hole or a region.
Eigen::Vector3d BoundaryReader::place() const {
  return {lines_.number(1), lines_.number(2), lines_.number(3)};
}

/// The places of holes and regions; both lists may be missing at the end of the file.
void BoundaryReader::read_marks() {
  RegionMarks& marks = mesh_.marks.emplace();
  if (!lines_.next()) return;
  marks.holes.resize(lines_.count(0, "holes"));
  for (std::size_t i = 0; i < marks.holes.size(); ++i) {
    lines_.expect(fmt::format("hole {} of {}", i + 1, marks.holes.size()));
    marks.holes[i] = place();
  }
  if (!lines_.next()) return;
  marks.regions.resize(lines_.count(0, "regions"));
  std::size_t bounded = 0;
  for (std::size_t i = 0; i < marks.regions.size(); ++i) {
    lines_.expect(fmt::format("region {} of {}", i + 1, marks.regions.size()));
    const std::size_t words = lines_.words().size();
    marks.regions[i] = {place(), words > 4 ? lines_.number(4) : static_cast<double>(i + 1)};
    if (words > 5 && lines_.number(5) > 0) ++bounded;
  }
  if (bounded > 0) {
    mesh_.notes.push_back(
        fmt::format("the largest volumes of {} regions are not used; give --max-volume", bounded));
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
