#include "mesh/read_medit.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/file_name.h"
#include "mesh/medit_sections.h"
#include "mesh/memory.h"

namespace tetraglass::mesh {
namespace {

/// A section of elements.
struct Elements {
  std::string_view name;
  int number;  ///< of the section in binary files
  std::size_t nodes;
  CellType type;
  std::size_t used;  ///< the first nodes, which the cell has
};

constexpr auto kElements =
    std::to_array<Elements>({{"Edges", 5, 2, CellType::line, 2},
                             {"Triangles", 6, 3, CellType::triangle, 3},
                             {"Quadrilaterals", 7, 4, CellType::quad, 4},
                             {"Tetrahedra", 8, 4, CellType::tetra, 4},
                             {"Prisms", 9, 6, CellType::wedge, 6},
                             {"Pentahedra", 9, 6, CellType::wedge, 6},
                             {"Hexahedra", 10, 8, CellType::hexahedron, 8},
                             {"Pyramids", 49, 5, CellType::pyramid, 5},
                             {"TrianglesP2", 24, 6, CellType::quadratic_triangle, 6},
                             {"EdgesP2", 25, 3, CellType::quadratic_edge, 3},
                             {"QuadrilateralsQ2", 27, 9, CellType::biquadratic_quad, 9},
                             {"TetrahedraP2", 30, 10, CellType::quadratic_tetra, 10},
                             {"HexahedraQ2", 33, 27, CellType::hexahedron, 8}});

class MeditReader {
 public:
  MeshData read(const std::string& file);

  /// As a field of the mesh that has been read.
  void add_references(MeshData& mesh);

 private:
  void read_points(MeditSections& sections);
  void read_elements(MeditSections& sections, const Elements& elements);

  MeshData mesh_;
  std::int64_t dimension_ = 3;
  std::vector<double> references_;  ///< of the cells
  std::size_t reduced_ = 0;         ///< elements of which the corners are used
};

MeshData MeditReader::read(const std::string& file) {
  MeditSections sections(file);
  while (sections.next()) {
    if (sections.is("Dimension", 3)) {
      dimension_ = sections.integer();
      if (dimension_ != 2 && dimension_ != 3) {
        sections.fail(fmt::format("the dimension {} is neither 2 nor 3", dimension_));
      }
    } else if (sections.is("Vertices", 4)) {
      read_points(sections);
    } else {
      const auto* found = std::ranges::find_if(kElements, [&](const Elements& elements) {
        return sections.is(elements.name, elements.number);
      });
      if (found != kElements.end()) read_elements(sections, *found);
    }
  }
  if (reduced_ > 0) {
    mesh_.notes.push_back(
        fmt::format("of {} hexahedra of 27 nodes the corners are used", reduced_));
  }
  return std::move(mesh_);
}

void MeditReader::read_points(MeditSections& sections) {
  if (!mesh_.points.empty()) sections.fail("has a second list of points");
  const auto dimension = static_cast<std::size_t>(dimension_);
  const std::size_t count = sections.count(dimension + 1);
  check_mesh_fits(count, 0);
  mesh_.points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    for (std::size_t axis = 0; axis < dimension; ++axis) {
      p[static_cast<Eigen::Index>(axis)] = sections.real();
    }
    sections.integer();  // its reference
    mesh_.points.push_back(p);
  }
}

void MeditReader::read_elements(MeditSections& sections, const Elements& elements) {
  const std::size_t count = sections.count(elements.nodes + 1);
  check_mesh_fits(mesh_.points.size(), mesh_.cell_count() + count);
  // Its prism has the first triangle seen from inside, VTK's wedge from outside.
  constexpr std::array<std::size_t, 6> kPrism = {3, 4, 5, 0, 1, 2};
  std::array<std::uint32_t, 27> nodes{};
  std::array<std::uint32_t, 27> cell{};
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < elements.nodes; ++k) nodes[k] = sections.index(mesh_.points.size());
    for (std::size_t k = 0; k < elements.used; ++k) {
      cell[k] = nodes[elements.type == CellType::wedge ? kPrism[k] : k];
    }
    mesh_.add_cell(elements.type, std::span(cell).first(elements.used));
    references_.push_back(static_cast<double>(sections.integer()));
  }
  if (elements.used < elements.nodes) reduced_ += count;
}

void MeditReader::add_references(MeshData& mesh) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::size_t i = 0; i < references_.size(); ++i) {
    if (dimension(mesh.types[i]) < 3) continue;
    low = std::min(low, references_[i]);
    high = std::max(high, references_[i]);
  }
  if (low < high) {
    mesh.fields.push_back({"reference", Location::cell, 1, std::move(references_)});
  }
}

/// The file of that name with the first of the extensions for which there is one; empty if none.
std::string beside(const std::string& file, std::array<const char*, 2> extensions) {
  for (const char* extension : extensions) {
    const auto other = std::filesystem::path(file).replace_extension(extension);
    std::error_code ignored;
    if (std::filesystem::is_regular_file(other, ignored)) return other.string();
  }
  return {};
}

/// Values at points or of tetrahedra, for a mesh that has been read.
class SolutionReader {
 public:
  SolutionReader(const std::string& file, MeshData& mesh) : sections_(file), mesh_(mesh) {}

  void read() {
    while (sections_.next()) {
      if (sections_.is("Dimension", 3)) {
        dimension_ = sections_.integer();
        if (dimension_ != 2 && dimension_ != 3) {
          sections_.fail(fmt::format("the dimension {} is neither 2 nor 3", dimension_));
        }
      } else if (sections_.is("SolAtVertices", 62)) {
        read_values(Location::point);
      } else if (sections_.is("SolAtTetrahedra", 66)) {
        read_values(Location::cell);
      } else {
        mesh_.notes.push_back(fmt::format("solution: '{}' is left out", sections_.name()));
      }
    }
  }

 private:
  void read_values(Location location) {
    std::vector<std::size_t> places;  // where the values go
    const std::size_t size = location == Location::point ? mesh_.points.size() : mesh_.cell_count();
    for (std::size_t i = 0; i < size; ++i) {
      if (location == Location::point || mesh_.types[i] == CellType::tetra ||
          mesh_.types[i] == CellType::quadratic_tetra) {
        places.push_back(i);
      }
    }
    const std::size_t count = sections_.count(1);
    if (count != places.size()) {
      sections_.fail(fmt::format("has {} values for {} {}", count, places.size(),
                                 location == Location::point ? "points" : "tetrahedra"));
    }
    const std::size_t kinds = sections_.count(1);
    std::vector<Field> fields;
    std::size_t numbers = 0;  // of a place
    for (std::size_t i = 0; i < kinds; ++i) {
      const int n = components(sections_.integer());
      fields.push_back({kinds == 1 ? "solution" : fmt::format("solution {}", i), location, n, {}});
      numbers += static_cast<std::size_t>(n);
    }
    sections_.expect(count, numbers);
    for (Field& field : fields) {
      field.values.assign(size * static_cast<std::size_t>(field.components),
                          std::numeric_limits<double>::quiet_NaN());
    }
    for (const std::size_t place : places) {
      for (Field& field : fields) {
        const auto n = static_cast<std::size_t>(field.components);
        for (std::size_t k = 0; k < n; ++k) field.values[place * n + k] = sections_.real();
      }
    }
    for (Field& field : fields) mesh_.fields.push_back(std::move(field));
  }

  /// Scalars, vectors, symmetric and full matrices.
  [[nodiscard]] int components(std::int64_t kind) const {
    const auto n = static_cast<int>(dimension_);
    switch (kind) {
      case 1:
        return 1;
      case 2:
        return n;
      case 3:
        return n * (n + 1) / 2;
      case 4:
        return n * n;
      default:
        sections_.fail(fmt::format("values of the kind {} are not known", kind));
    }
  }

  MeditSections sections_;
  MeshData& mesh_;
  std::int64_t dimension_ = 3;
};

}  // namespace

MeshData read_medit(const std::string& file) {
  const std::string extension = extension_of(file);
  const bool is_solution = extension == ".sol" || extension == ".solb";
  const std::string grid = is_solution ? beside(file, {".mesh", ".meshb"}) : file;
  if (grid.empty()) {
    throw base::ReadError(file, "is a solution, and its mesh (.mesh or .meshb) is not beside it");
  }
  const std::string solution = is_solution ? file : beside(file, {".sol", ".solb"});
  MeditReader reader;
  MeshData mesh = reader.read(grid);
  if (!solution.empty()) {
    SolutionReader(solution, mesh).read();
    mesh.notes.push_back("solution: " + solution);
  }
  reader.add_references(mesh);  // the last field: not what is looked at first
  return mesh;
}

}  // namespace tetraglass::mesh
