#include "mesh/read_ucd.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <vector>

#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/memory.h"
#include "mesh/number_stream.h"
#include "mesh/number_text.h"
#include "mesh/tag_map.h"
#include "mesh/text_lines.h"

namespace tetraglass::mesh {
namespace {

constexpr char kBinaryMark = 7;

/// A kind of cell; `order` has the node that each of the cell's points is.
struct Kind {
  std::string_view name;
  CellType type;
  std::vector<std::size_t> order;
};

// In the order of their numbers in binary files. The apex of a pyramid comes first.
const std::vector<Kind>& kinds() {
  static const std::vector<Kind> kTable = {
      {"pt", CellType::vertex, {0}},
      {"line", CellType::line, {0, 1}},
      {"tri", CellType::triangle, {0, 1, 2}},
      {"quad", CellType::quad, {0, 1, 2, 3}},
      {"tet", CellType::tetra, {0, 1, 2, 3}},
      {"pyr", CellType::pyramid, {1, 2, 3, 4, 0}},
      {"prism", CellType::wedge, {0, 1, 2, 3, 4, 5}},
      {"hex", CellType::hexahedron, {0, 1, 2, 3, 4, 5, 6, 7}},
  };
  return kTable;
}

void add_material(MeshData& mesh, Field material) {
  const auto [low, high] = std::ranges::minmax_element(material.values);
  if (low != material.values.end() && *low < *high) mesh.fields.push_back(std::move(material));
}

class TextReader {
 public:
  explicit TextReader(const std::string& file) : lines_(file) {}

  MeshData read() {
    lines_.expect("the numbers of points and cells");
    const std::size_t points = lines_.count(0, "points");
    const std::size_t cells = lines_.count(1, "cells");
    const std::size_t point_values = lines_.count(2, "values at a point");
    const std::size_t cell_values = lines_.count(3, "values of a cell");
    check_mesh_fits(points, cells);
    read_points(points);
    read_cells(cells);
    if (point_values > 0) read_values(points_, Location::point, point_values);
    if (cell_values > 0) read_values(cells_, Location::cell, cell_values);
    return std::move(mesh_);
  }

 private:
  void read_points(std::size_t count) {
    std::vector<std::uint64_t> numbers;
    for (std::size_t i = 0; i < count; ++i) {
      lines_.expect(fmt::format("point {} of {}", i + 1, count));
      numbers.push_back(static_cast<std::uint64_t>(lines_.integer(0)));
      mesh_.points.emplace_back(lines_.number(1), lines_.number(2), lines_.number(3));
    }
    points_ = TagMap(numbers);
  }

  void read_cells(std::size_t count) {
    std::vector<std::uint64_t> numbers;
    Field material{"Material Id", Location::cell, 1, {}};
    std::vector<std::uint32_t> cell;
    for (std::size_t i = 0; i < count; ++i) {
      lines_.expect(fmt::format("cell {} of {}", i + 1, count));
      numbers.push_back(static_cast<std::uint64_t>(lines_.integer(0)));
      material.values.push_back(lines_.number(1));
      const auto kind = lines_.words().size() > 2
                            ? std::ranges::find(kinds(), lines_.words()[2], &Kind::name)
                            : kinds().end();
      if (kind == kinds().end()) lines_.fail("its third word is no type of a cell");
      cell.clear();
      for (const std::size_t k : kind->order) {
        const std::int64_t number = lines_.integer(3 + k);
        cell.push_back(points_.find(static_cast<std::uint64_t>(number)));
        if (cell.back() == TagMap::kAbsent)
          lines_.fail(fmt::format("there is no point {}", number));
      }
      mesh_.add_cell(kind->type, cell);
    }
    cells_ = TagMap(numbers);
    add_material(mesh_, std::move(material));
  }

  /// The number of fields and of the values of each; a line with the name and the unit of each; and
  /// a line with all values of each point or cell.
  void read_values(const TagMap& places, Location location, std::size_t claimed) {
    lines_.expect("the number of fields");
    const std::size_t count = lines_.count(0, "fields");
    std::vector<Field> fields;
    std::size_t total = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t components = lines_.count(1 + i, "values");
      if (components == 0) lines_.fail("a field has no values");
      fields.push_back({"", location, static_cast<int>(components), {}});
      total += components;
    }
    if (total != claimed) {
      lines_.fail(fmt::format("fields of {} values, but the head tells of {}", total, claimed));
    }
    for (Field& field : fields) {
      lines_.expect("the name of a field");
      const std::string_view name = lines_.words()[0];
      field.name = name.substr(0, name.find(','));
    }
    const std::size_t size = location == Location::point ? mesh_.points.size() : mesh_.cell_count();
    std::vector<bool> seen(size);
    for (std::size_t i = 0; i < size; ++i) {
      lines_.expect(fmt::format("the values of {} of {}", i + 1, size));
      if (lines_.words().size() < 1 + total) lines_.fail("has too few values");
      if (i == 0) {
        for (Field& field : fields) {
          field.values.resize(size * static_cast<std::size_t>(field.components));
        }
      }
      const std::uint32_t place = places.find(static_cast<std::uint64_t>(lines_.integer(0)));
      if (place == TagMap::kAbsent || seen[place])
        lines_.fail("values of what is not there, or twice");
      seen[place] = true;
      std::size_t at = 1;
      for (Field& field : fields) {
        const auto n = static_cast<std::size_t>(field.components);
        for (std::size_t k = 0; k < n; ++k) field.values[place * n + k] = lines_.number(at++);
      }
    }
    for (Field& field : fields) mesh_.fields.push_back(std::move(field));
  }

  TextLines lines_;
  MeshData mesh_;
  TagMap points_;
  TagMap cells_;
};

class BinaryReader {
 public:
  explicit BinaryReader(const std::string& file) : in_(file) { in_.set_binary(true); }

  MeshData read() {
    in_.seek(1);
    // In the other byte order the number of points is larger than the file.
    const std::int32_t first = in_.int32();
    in_.set_swapped(first < 0 || static_cast<std::size_t>(first) > in_.bytes().size());
    in_.seek(1);
    const std::size_t points = count("points");
    const std::size_t cells = count("cells");
    const std::size_t point_values = count("values at points");
    const std::size_t cell_values = count("values of cells");
    const std::size_t model_values = count("values of the model");
    const std::size_t nodes = count("nodes of cells");
    static_cast<void>(model_values);
    check_mesh_fits(points, cells);
    read_cells(cells, nodes, points);
    std::array<std::vector<float>, 3> axes;
    for (auto& axis : axes) {
      for (std::size_t i = 0; i < points; ++i) axis.push_back(in_.float32());
    }
    for (std::size_t i = 0; i < points; ++i) {
      mesh_.points.emplace_back(axes[0][i], axes[1][i], axes[2][i]);
    }
    if (point_values > 0) read_values(Location::point, point_values);
    if (cell_values > 0) read_values(Location::cell, cell_values);
    return std::move(mesh_);
  }

 private:
  std::size_t count(const char* things) {
    const std::int32_t value = in_.int32();
    if (value < 0 || static_cast<std::size_t>(value) > in_.bytes().size()) {
      in_.fail(
          fmt::format("{} {} cannot be in a file of {} bytes", value, things, in_.bytes().size()));
    }
    return static_cast<std::size_t>(value);
  }

  /// The heads of all cells (number, material, size, type), then the nodes of all.
  void read_cells(std::size_t cells, std::size_t nodes, std::size_t points) {
    Field material{"Material Id", Location::cell, 1, {}};
    std::vector<const Kind*> types;
    std::size_t total = 0;
    for (std::size_t i = 0; i < cells; ++i) {
      in_.int32();
      material.values.push_back(in_.int32());
      const std::int32_t size = in_.int32();
      const std::int32_t type = in_.int32();
      if (type < 0 || static_cast<std::size_t>(type) >= kinds().size()) {
        in_.fail(fmt::format("cell {} has the type {}, which is not known", i, type));
      }
      types.push_back(&kinds()[static_cast<std::size_t>(type)]);
      if (size < 0 || static_cast<std::size_t>(size) != types.back()->order.size()) {
        in_.fail(fmt::format("cell {} ({}) has {} nodes", i, types.back()->name, size));
      }
      total += static_cast<std::size_t>(size);
    }
    if (total != nodes) {
      in_.fail(fmt::format("the cells have {} nodes, but the head tells of {}", total, nodes));
    }
    std::array<std::uint32_t, 8> list{};
    std::vector<std::uint32_t> cell;
    for (const Kind* kind : types) {
      for (std::size_t k = 0; k < kind->order.size(); ++k) {
        const std::int32_t node = in_.int32();
        if (node < 1 || static_cast<std::size_t>(node) > points) {
          in_.fail(
              fmt::format("a cell names point {}, but there are points 1 to {}", node, points));
        }
        list[k] = static_cast<std::uint32_t>(node - 1);
      }
      cell.clear();
      for (const std::size_t k : kind->order) cell.push_back(list[k]);
      mesh_.add_cell(kind->type, cell);
    }
    add_material(mesh_, std::move(material));
  }

  std::string text(std::size_t size) {
    if (in_.bytes().size() - in_.position() < size) in_.fail("ends within the names of its fields");
    const std::string result = in_.bytes().substr(in_.position(), size);
    in_.seek(in_.position() + size);
    return result.substr(0, result.find('\0'));
  }

  /// Names and units with dots between them, the numbers of values of the fields, smallest and
  /// largest values, the values of one field after the other, and marks.
  void read_values(Location location, std::size_t claimed) {
    constexpr std::size_t kText = 1024;
    const std::string names = text(kText);
    text(kText);
    const std::size_t fields = count("fields");
    std::vector<std::size_t> components;
    for (std::size_t i = 0; i < fields; ++i) components.push_back(count("values"));
    std::size_t total = 0;
    for (const std::size_t n : components) total += n;
    if (fields > claimed || total != claimed) {
      in_.fail(fmt::format("fields of {} values, but the head tells of {}", total, claimed));
    }
    // The list has a place for each value, whatever the number of fields.
    for (std::size_t i = fields; i < claimed; ++i) in_.int32();
    for (std::size_t i = 0; i < 2 * claimed; ++i) in_.float32();
    const std::size_t size = location == Location::point ? mesh_.points.size() : mesh_.cell_count();
    std::size_t name_at = 0;
    for (const std::size_t n : components) {
      const std::size_t end = std::min(names.find('.', name_at), names.size());
      Field field{names.substr(std::min(name_at, names.size()), end - std::min(name_at, end)),
                  location,
                  static_cast<int>(n),
                  {}};
      name_at = end + 1;
      if (n == 0) in_.fail("a field has no values");
      for (std::size_t i = 0; i < size * n; ++i) field.values.push_back(in_.float32());
      mesh_.fields.push_back(std::move(field));
    }
    for (std::size_t i = 0; i < claimed; ++i) in_.int32();
  }

  NumberStream in_;
  MeshData mesh_;
};

}  // namespace

bool is_ucd(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  if (stream.peek() == kBinaryMark) return true;
  constexpr std::size_t kLongest = 1000;
  std::string line(kLongest, '\0');
  do {
    stream.getline(line.data(), kLongest);
  } while (stream && line[0] == '#');
  const auto numbers = parse_numbers(line.substr(0, line.find('\0')));
  return numbers && numbers->size() == 5;
}

MeshData read_ucd(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return stream.peek() == kBinaryMark ? BinaryReader(file).read() : TextReader(file).read();
}

}  // namespace tetraglass::mesh
