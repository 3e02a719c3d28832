#include "mesh/read_netgen.h"

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>

#include "mesh/memory.h"
#include "mesh/text_lines.h"

namespace tetraglass::mesh {
namespace {

/// An element by its number of points; `order` has the point that each of the cell's is.
struct Element {
  std::size_t points;
  CellType type;
  std::vector<std::size_t> order;
};

// Netgen's solids are the mirror images of VTK's.
const std::vector<Element>& volume_elements() {
  static const std::vector<Element> kTable = {
      {4, CellType::tetra, {0, 2, 1, 3}},
      {5, CellType::pyramid, {0, 3, 2, 1, 4}},
      {6, CellType::wedge, {3, 5, 4, 0, 2, 1}},
      {8, CellType::hexahedron, {0, 3, 2, 1, 4, 7, 6, 5}},
      {10, CellType::quadratic_tetra, {0, 2, 1, 3, 5, 7, 4, 6, 9, 8}},
      {13, CellType::pyramid, {0, 3, 2, 1, 4}},
      {15, CellType::wedge, {3, 5, 4, 0, 2, 1}},
      {20, CellType::hexahedron, {0, 3, 2, 1, 4, 7, 6, 5}},
  };
  return kTable;
}

const std::vector<Element>& surface_elements() {
  static const std::vector<Element> kTable = {
      {3, CellType::triangle, {0, 1, 2}},
      {4, CellType::quad, {0, 1, 2, 3}},
      {6, CellType::triangle, {0, 1, 2}},
      {8, CellType::quad, {0, 1, 2, 3}},
  };
  return kTable;
}

class NetgenReader {
 public:
  explicit NetgenReader(const std::string& file) : lines_(file) {}

  MeshData read();

 private:
  void read_elements(const std::vector<Element>& table, std::size_t size_at, std::size_t points_at,
                     const char* what);
  void read_points();

  TextLines lines_;
  MeshData mesh_;
  Field domain_{"domain", Location::cell, 1, {}};
  std::size_t reduced_ = 0;  ///< volume elements of which the corners are used
};

MeshData NetgenReader::read() {
  lines_.expect("'mesh3d'");
  if (lines_.words()[0] != "mesh3d") lines_.fail("is no mesh of Netgen: 'mesh3d' should be here");
  while (lines_.next() && lines_.words()[0] != "endmesh") {
    const std::string_view key = lines_.words()[0];
    if (key == "dimension") {
      lines_.expect("the dimension");
      if (lines_.integer(0) != 3) lines_.fail("only meshes of dimension 3 are read");
    } else if (key == "volumeelements") {
      read_elements(volume_elements(), 1, 2, "volume elements");
    } else if (key.starts_with("surfaceelements")) {
      read_elements(surface_elements(), 4, 5, "surface elements");
    } else if (key == "points") {
      read_points();
    }
  }
  // Points may stand behind the elements.
  for (const std::uint32_t i : mesh_.connectivity) {
    if (i >= mesh_.points.size()) {
      lines_.fail(fmt::format("an element names point {}, but there are points 1 to {}",
                              std::int64_t{i} + 1, mesh_.points.size()));
    }
  }
  if (reduced_ > 0) {
    mesh_.notes.push_back(
        fmt::format("of {} elements of higher order the corners are used", reduced_));
  }
  const double high = domain_.values.empty() ? 0 : *std::ranges::max_element(domain_.values);
  if (std::ranges::any_of(domain_.values,
                          [&](double value) { return value != 0 && value != high; })) {
    mesh_.fields.push_back(std::move(domain_));
  }
  return std::move(mesh_);
}

void NetgenReader::read_elements(const std::vector<Element>& table, std::size_t size_at,
                                 std::size_t points_at, const char* what) {
  lines_.expect(fmt::format("the number of {}", what));
  const std::size_t count = lines_.count(0, what);
  check_mesh_fits(0, mesh_.cell_count() + count);
  std::array<std::uint32_t, 10> cell{};
  for (std::size_t i = 0; i < count; ++i) {
    lines_.expect(fmt::format("one of {} {}", count, what));
    const std::size_t size = lines_.count(size_at, "points");
    const auto element = std::ranges::find(table, size, &Element::points);
    if (element == table.end()) {
      lines_.fail(fmt::format("there are no {} of {} points", what, size));
    }
    for (std::size_t k = 0; k < element->order.size(); ++k) {
      constexpr std::size_t kMost = 0xfffffffeU;
      cell[k] = lines_.index(points_at + element->order[k], kMost, 1);
    }
    mesh_.add_cell(element->type, std::span(cell).first(element->order.size()));
    const bool is_solid = dimension(element->type) == 3;
    if (is_solid && element->order.size() < size) ++reduced_;
    domain_.values.push_back(is_solid ? static_cast<double>(lines_.integer(0)) : 0);
  }
}

void NetgenReader::read_points() {
  lines_.expect("the number of points");
  const std::size_t count = lines_.count(0, "points");
  check_mesh_fits(count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    lines_.expect(fmt::format("point {} of {}", i + 1, count));
    mesh_.points.emplace_back(lines_.number(0), lines_.number(1), lines_.number(2));
  }
}

}  // namespace

MeshData read_netgen(const std::string& file) {
  return NetgenReader(file).read();
}

}  // namespace tetraglass::mesh
