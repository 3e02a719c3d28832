#include "mesh/read_gambit.h"

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>

#include "mesh/memory.h"
#include "mesh/tag_map.h"
#include "mesh/text_lines.h"

namespace tetraglass::mesh {
namespace {

/// A kind of element; `order` has the node that each of the cell's points is.
struct Element {
  std::int64_t kind;
  std::size_t nodes;
  CellType type;
  std::vector<std::size_t> order;
};

// Bricks and the bases of pyramids are numbered in rows; wedges have their first triangle seen from
// inside.
const std::vector<Element>& elements() {
  static const std::vector<Element> kTable = {
      {1, 2, CellType::line, {0, 1}},
      {2, 4, CellType::quad, {0, 1, 2, 3}},
      {3, 3, CellType::triangle, {0, 1, 2}},
      {4, 8, CellType::hexahedron, {0, 1, 3, 2, 4, 5, 7, 6}},
      {5, 6, CellType::wedge, {3, 4, 5, 0, 1, 2}},
      {6, 4, CellType::tetra, {0, 1, 2, 3}},
      {7, 5, CellType::pyramid, {0, 1, 3, 2, 4}},
  };
  return kTable;
}

class GambitReader {
 public:
  explicit GambitReader(const std::string& file) : lines_(file, '\0') {}

  MeshData read();

 private:
  void read_sizes();
  void read_points();
  void read_elements();
  void read_group();

  TextLines lines_;
  MeshData mesh_;
  std::size_t point_count_ = 0;
  std::size_t element_count_ = 0;
  std::size_t left_out_ = 0;
  std::size_t groups_ = 0;
  TagMap points_;
  TagMap tags_;
  Field group_{"group", Location::cell, 1, {}};
};

MeshData GambitReader::read() {
  lines_.expect("'CONTROL INFO'");
  if (lines_.words()[0] != "CONTROL")
    lines_.fail("is no neutral file of Gambit: 'CONTROL INFO' should be here");
  read_sizes();
  while (lines_.next()) {
    const std::string_view key = lines_.words()[0];
    if (key == "NODAL") {
      read_points();
    } else if (key == "ELEMENTS/CELLS") {
      read_elements();
    } else if (key == "ELEMENT") {
      read_group();
    }
  }
  if (mesh_.points.size() != point_count_ || group_.values.size() != element_count_) {
    lines_.fail(fmt::format("ends with {} of {} points and {} of {} elements", mesh_.points.size(),
                            point_count_, group_.values.size(), element_count_));
  }
  if (left_out_ > 0) {
    mesh_.notes.push_back(
        fmt::format("{} elements with nodes on their edges are left out: their "
                    "order is not known",
                    left_out_));
  }
  if (groups_ > 1) mesh_.fields.push_back(std::move(group_));
  return std::move(mesh_);
}

/// The head: remarks, the names of the sizes, and these.
void GambitReader::read_sizes() {
  do {
    lines_.expect("the numbers of points and elements");
  } while (lines_.words()[0] != "NUMNP");
  lines_.expect("the numbers of points and elements");
  point_count_ = lines_.count(0, "points");
  element_count_ = lines_.count(1, "elements");
  check_mesh_fits(point_count_, element_count_);
  if (lines_.words().size() > 4 && lines_.integer(4) != 3)
    lines_.fail("only meshes of dimension 3 are read");
}

void GambitReader::read_points() {
  std::vector<std::uint64_t> numbers;
  for (std::size_t i = 0; i < point_count_; ++i) {
    lines_.expect(fmt::format("point {} of {}", i + 1, point_count_));
    numbers.push_back(static_cast<std::uint64_t>(lines_.integer(0)));
    mesh_.points.emplace_back(lines_.number(1), lines_.number(2), lines_.number(3));
  }
  points_ = TagMap(numbers);
}

void GambitReader::read_elements() {
  std::vector<std::uint64_t> numbers;
  std::vector<std::uint32_t> nodes;
  std::vector<std::uint32_t> cell;
  for (std::size_t i = 0; i < element_count_; ++i) {
    lines_.expect(fmt::format("element {} of {}", i + 1, element_count_));
    numbers.push_back(static_cast<std::uint64_t>(lines_.integer(0)));
    const std::int64_t kind = lines_.integer(1);
    const std::size_t size = lines_.count(2, "nodes");
    nodes.clear();
    for (std::size_t at = 3; nodes.size() < size; ++at) {
      if (at == lines_.words().size()) {  // more are on the next line
        lines_.expect(fmt::format("the other nodes of element {}", numbers.back()));
        at = 0;
      }
      const std::int64_t number = lines_.integer(at);
      nodes.push_back(points_.find(static_cast<std::uint64_t>(number)));
      if (nodes.back() == TagMap::kAbsent) lines_.fail(fmt::format("there is no point {}", number));
    }
    const auto element = std::ranges::find_if(
        elements(), [&](const Element& e) { return e.kind == kind && e.nodes == size; });
    group_.values.push_back(0);
    cell.clear();
    if (element == elements().end()) {
      ++left_out_;
      mesh_.add_cell(static_cast<CellType>(0), {});  // it keeps its place
      continue;
    }
    for (const std::size_t k : element->order) cell.push_back(nodes[k]);
    mesh_.add_cell(element->type, cell);
  }
  tags_ = TagMap(numbers);
}

/// A line with the sizes, its name, its flags, and the numbers of its elements.
void GambitReader::read_group() {
  lines_.expect("the head of a group");
  const auto find = [&](std::string_view key) {
    const auto found = std::ranges::find(lines_.words(), key);
    return static_cast<std::size_t>(found - lines_.words().begin()) + 1;
  };
  const std::int64_t number = lines_.integer(find("GROUP:"));
  const std::size_t count = lines_.count(find("ELEMENTS:"), "elements");
  const std::size_t flags = lines_.count(find("NFLAGS:"), "flags");
  lines_.expect("the name of a group");
  ++groups_;
  std::size_t seen = 0;
  while (seen < flags + count && lines_.next() && lines_.words()[0] != "ENDOFSECTION") {
    for (std::size_t i = 0; i < lines_.words().size(); ++i, ++seen) {
      if (seen < flags) continue;
      const std::uint32_t place = tags_.find(static_cast<std::uint64_t>(lines_.integer(i)));
      if (place == TagMap::kAbsent) lines_.fail("a group has an element that is not there");
      group_.values[place] = static_cast<double>(number);
    }
  }
}

}  // namespace

MeshData read_gambit(const std::string& file) {
  return GambitReader(file).read();
}

}  // namespace tetraglass::mesh
