#include "mesh/read_abaqus.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/file_name.h"
#include "mesh/number_text.h"
#include "mesh/tag_map.h"

namespace tetraglass::mesh {
namespace {

/// Elements whose name begins so; `order` has the node that each of the cell's points is (in order,
/// if empty).
struct Element {
  std::string_view name;
  std::size_t nodes;
  CellType type;
  std::vector<std::size_t> order;
};

// Of names that begin alike the longer one comes first. Its wedge has the first triangle seen from
// inside, VTK's from outside.
const std::vector<Element>& elements() {
  static const std::vector<Element> kTable = {
      {"C3D10", 10, CellType::quadratic_tetra, {}},
      {"C3D15", 15, CellType::quadratic_wedge, {3, 4, 5, 0, 1, 2, 9, 10, 11, 6, 7, 8, 12, 13, 14}},
      {"C3D20", 20, CellType::quadratic_hexahedron, {}},
      {"C3D4", 4, CellType::tetra, {}},
      {"C3D5", 5, CellType::pyramid, {}},
      {"C3D6", 6, CellType::wedge, {3, 4, 5, 0, 1, 2}},
      {"C3D8", 8, CellType::hexahedron, {}},
      {"DC3D10", 10, CellType::quadratic_tetra, {}},
      {"DC3D15", 15, CellType::quadratic_wedge, {3, 4, 5, 0, 1, 2, 9, 10, 11, 6, 7, 8, 12, 13, 14}},
      {"DC3D20", 20, CellType::quadratic_hexahedron, {}},
      {"DC3D4", 4, CellType::tetra, {}},
      {"DC3D6", 6, CellType::wedge, {3, 4, 5, 0, 1, 2}},
      {"DC3D8", 8, CellType::hexahedron, {}},
      {"CPE3", 3, CellType::triangle, {}},
      {"CPE4", 4, CellType::quad, {}},
      {"CPS3", 3, CellType::triangle, {}},
      {"CPS4", 4, CellType::quad, {}},
      {"M3D3", 3, CellType::triangle, {}},
      {"M3D4", 4, CellType::quad, {}},
      {"R3D3", 3, CellType::triangle, {}},
      {"R3D4", 4, CellType::quad, {}},
      {"SFM3D3", 3, CellType::triangle, {}},
      {"SFM3D4", 4, CellType::quad, {}},
      {"STRI3", 3, CellType::triangle, {}},
      {"S3", 3, CellType::triangle, {}},
      {"S4", 4, CellType::quad, {}},
      {"T3D2", 2, CellType::line, {}},
      {"B31", 2, CellType::line, {}},
  };
  return kTable;
}

std::string upper(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (std::isspace(static_cast<unsigned char>(c)) == 0) {
      result += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    }
  }
  return result;
}

class AbaqusReader {
 public:
  explicit AbaqusReader(const std::string& file) : file_(file), content_(content_of(file)) {}

  MeshData read();

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw base::ReadError(file_, fmt::format("line {}: {}", line_number_, what));
  }
  /// The next line that is no remark; false at the end.
  bool next();
  [[nodiscard]] bool is_keyword() const { return line_.starts_with('*'); }
  [[nodiscard]] std::vector<double> numbers() const;
  [[nodiscard]] std::uint64_t tag(double number) const;
  void read_nodes();
  void read_elements(const std::string& keyword);
  void number_cells();

  std::string file_;
  std::string content_;
  std::size_t at_ = 0;
  std::size_t line_number_ = 0;
  std::string_view line_;
  MeshData mesh_;
  std::vector<std::uint64_t> node_tags_;
  std::vector<std::uint64_t> corners_;  ///< of all cells, by the numbers of their nodes
  std::size_t parts_ = 0;
  std::map<std::string, std::size_t> left_out_;
};

bool AbaqusReader::next() {
  while (at_ < content_.size()) {
    const std::size_t end = std::min(content_.find('\n', at_), content_.size());
    line_ = std::string_view(content_).substr(at_, end - at_);
    at_ = end + 1;
    ++line_number_;
    const std::size_t start = line_.find_first_not_of(" \t\r");
    line_.remove_prefix(std::min(start, line_.size()));
    line_ = line_.substr(0, line_.find_last_not_of(" \t\r") + 1);
    if (!line_.empty() && !line_.starts_with("**")) return true;
  }
  line_ = {};
  return false;
}

std::vector<double> AbaqusReader::numbers() const {
  auto numbers = parse_numbers(line_);
  if (!numbers || numbers->empty()) fail("is not of numbers");
  return std::move(*numbers);
}

std::uint64_t AbaqusReader::tag(double number) const {
  constexpr double kMost = 9e15;
  if (!(number >= 0 && number <= kMost) ||
      number != static_cast<double>(static_cast<std::uint64_t>(number))) {
    fail(fmt::format("{} is no number of a node or an element", number));
  }
  return static_cast<std::uint64_t>(number);
}

void AbaqusReader::read_nodes() {
  bool more = next();
  for (; more && !is_keyword(); more = next()) {
    const std::vector<double> values = numbers();
    node_tags_.push_back(tag(values[0]));
    Eigen::Vector3d p = Eigen::Vector3d::Zero();  // coordinates that are 0 may be left out
    for (std::size_t i = 1; i < std::min<std::size_t>(values.size(), 4); ++i) {
      p[static_cast<Eigen::Index>(i - 1)] = values[i];
    }
    mesh_.points.push_back(p);
  }
}

void AbaqusReader::read_elements(const std::string& keyword) {
  const std::size_t type_at = keyword.find("TYPE=");
  if (type_at == std::string::npos) fail("*ELEMENT has no TYPE");
  const std::string type = keyword.substr(type_at + 5, keyword.find(',', type_at) - type_at - 5);
  const auto element =
      std::ranges::find_if(elements(), [&](const Element& e) { return type.starts_with(e.name); });
  bool more = next();
  while (more && !is_keyword()) {
    std::vector<double> values = numbers();
    // It goes on in the next line while nodes are missing or a comma stands at the end.
    const std::size_t nodes = element != elements().end() ? element->nodes : 0;
    while ((values.size() < 1 + nodes || line_.ends_with(',')) && (more = next()) &&
           !is_keyword()) {
      const std::vector<double> rest = numbers();
      values.insert(values.end(), rest.begin(), rest.end());
    }
    if (more && !is_keyword()) more = next();
    if (element == elements().end()) {
      ++left_out_[type];
      continue;
    }
    if (values.size() != 1 + nodes) {
      fail(fmt::format("before this line, an element {} has {} nodes instead of {}", type,
                       values.size() - 1, nodes));
    }
    for (std::size_t k = 0; k < nodes; ++k) {
      corners_.push_back(tag(values[1 + (element->order.empty() ? k : element->order[k])]));
    }
    mesh_.types.push_back(element->type);
    mesh_.offsets.push_back(corners_.size());
  }
}

void AbaqusReader::number_cells() {
  const TagMap nodes(node_tags_);
  for (const std::uint64_t corner : corners_) {
    mesh_.connectivity.push_back(nodes.find(corner));
    if (mesh_.connectivity.back() == TagMap::kAbsent) {
      throw base::ReadError(
          file_, fmt::format("an element names node {}, which is not in the file", corner));
    }
  }
}

MeshData AbaqusReader::read() {
  bool more = next();
  if (!more || !is_keyword())
    fail("is no input file of Abaqus: it does not begin with a keyword (*)");
  while (more) {
    const std::string keyword = upper(line_);
    if (keyword == "*NODE" || keyword.starts_with("*NODE,")) {
      read_nodes();
    } else if (keyword == "*ELEMENT" || keyword.starts_with("*ELEMENT,")) {
      read_elements(keyword);
    } else {
      if (keyword.starts_with("*INCLUDE")) fail("*INCLUDE is not read; put all into one file");
      if (keyword.starts_with("*PART") && ++parts_ > 1) {
        fail("several parts (*PART) are not read; write one mesh for all of them");
      }
      do {
        more = next();
      } while (more && !is_keyword());
    }
    more = !line_.empty();
  }
  number_cells();
  for (const auto& [type, count] : left_out_) {
    mesh_.notes.push_back(fmt::format("{} elements of type {:.40} are left out", count, type));
  }
  return std::move(mesh_);
}

}  // namespace

MeshData read_abaqus(const std::string& file) {
  return AbaqusReader(file).read();
}

}  // namespace tetraglass::mesh
