#include "mesh/read_msh.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/gmsh_elements.h"
#include "mesh/memory.h"
#include "mesh/number_stream.h"
#include "mesh/number_text.h"
#include "mesh/read_gmsh.h"
#include "mesh/tag_map.h"
#include "mesh/time_step.h"

namespace tetraglass::mesh {
namespace {

class MshReader {
 public:
  explicit MshReader(const std::string& file) : in_(file) {}

  /// Whether the version is one of those that are read here.
  bool read_format();
  MeshData read(const std::string& time);

 private:
  /// Where the values of a time step of a field are in the file.
  struct DataStep {
    double time;
    std::size_t components;
    std::size_t count;
    std::size_t position;
  };
  using DataName = std::pair<Location, std::string>;

  void read_section(std::string_view name);
  void skip_to_end(std::string_view section);
  void read_entities();
  void read_physical(int dimension, int tag);
  void read_nodes_2();
  void read_nodes_4();
  void read_elements_2();
  void read_elements_4();
  const GmshElement& element_type(int number) const;
  void add_element(const GmshElement& element, std::uint64_t tag, double physical);
  void note_data(Location location);
  void read_data(const DataName& name, const DataStep& step);
  std::uint64_t tag_2() { return static_cast<std::uint32_t>(in_.int32()); }
  std::uint64_t tag_4() { return static_cast<std::uint64_t>(in_.int64()); }
  std::size_t count_line(const char* things);

  NumberStream in_;
  double version_ = 0;
  MeshData mesh_;
  std::vector<std::uint64_t> node_tags_;
  std::vector<std::uint64_t> element_tags_;
  TagMap nodes_;
  std::map<std::pair<int, int>, int> physical_of_;  ///< by dimension and tag of an entity
  Field physical_{"physical", Location::cell, 1, {}};
  bool has_physical_ = false;
  std::size_t reduced_ = 0;  ///< elements of which only the corners are used
  std::vector<std::uint64_t> element_nodes_;
  std::vector<std::pair<DataName, std::vector<DataStep>>> data_;  ///< in the order of the file
};

bool MshReader::read_format() {
  std::string_view line;
  while (in_.line(line) && line.empty()) {
  }
  if (line != "$MeshFormat") return false;
  version_ = in_.float64();
  const int type = in_.int32();
  const int size = in_.int32();
  if (type != 0 && type != 1) in_.fail("the file type has to be 0 (text) or 1 (binary)");
  if (size != 8) in_.fail(fmt::format("numbers of {} bytes are not read", size));
  in_.line(line);
  if (type == 1) {
    in_.set_binary(true);
    const std::int32_t one = in_.int32();
    if (one != 1) {
      if (static_cast<std::uint32_t>(one) != 0x01000000U) in_.fail("the byte order is not told");
      in_.set_swapped(true);
    }
  }
  skip_to_end("MeshFormat");
  return (version_ >= 2 && version_ < 3) || version_ == 4.1;
}

MeshData MshReader::read(const std::string& time) {
  std::string_view line;
  while (in_.line(line)) {
    if (!line.starts_with('$')) continue;
    read_section(line.substr(1));
  }
  if (reduced_ > 0) {
    mesh_.notes.push_back(
        fmt::format("of {} elements of high order the corners are used", reduced_));
  }
  if (has_physical_) mesh_.fields.push_back(std::move(physical_));
  for (const auto& [name, steps] : data_) {
    std::vector<double> times;
    for (const DataStep& step : steps) times.push_back(step.time);
    const std::size_t chosen = find_time_step(time, times);
    note_time_step(mesh_.notes, chosen, times, "'" + name.second + "': ");
    read_data(name, steps[chosen]);
  }
  return std::move(mesh_);
}

void MshReader::read_section(std::string_view name) {
  const std::string section(name);
  if (section == "Entities" && version_ > 4) {
    read_entities();
  } else if (section == "Nodes") {
    version_ > 4 ? read_nodes_4() : read_nodes_2();
    nodes_ = TagMap(node_tags_);
  } else if (section == "Elements") {
    version_ > 4 ? read_elements_4() : read_elements_2();
  } else if (section == "NodeData") {
    note_data(Location::point);
  } else if (section == "ElementData") {
    note_data(Location::cell);
  } else if (section == "ElementNodeData") {
    mesh_.notes.emplace_back("values at the nodes of each element ($ElementNodeData) are left out");
  }
  skip_to_end(section);
}

void MshReader::skip_to_end(std::string_view section) {
  const std::string mark = fmt::format("$End{}", section);
  const std::size_t found = in_.bytes().find(mark, in_.position());
  if (found == std::string::npos) in_.fail(fmt::format("there is no '{}'", mark));
  in_.seek(found + mark.size());
  std::string_view rest;
  in_.line(rest);
}

/// A count on a line of its own, which is text in binary files too.
std::size_t MshReader::count_line(const char* things) {
  const bool binary = in_.binary();
  in_.set_binary(false);
  const std::size_t count = in_.count(things);
  in_.set_binary(binary);
  std::string_view rest;
  if (binary) in_.line(rest);
  return count;
}

void MshReader::read_entities() {
  std::array<std::size_t, 4> counts{};
  for (std::size_t& count : counts) count = in_.count("entities");
  for (int dimension = 0; dimension < 4; ++dimension) {
    for (std::size_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) {
      const int tag = in_.int32();
      for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) in_.float64();  // place, or bounds
      const std::size_t groups = in_.count("physical groups");
      for (std::size_t k = 0; k < groups; ++k) {
        const int group = in_.int32();
        if (k == 0) physical_of_[{dimension, tag}] = group;
      }
      if (dimension == 0) continue;
      const std::size_t bounding = in_.count("bounding entities");
      for (std::size_t k = 0; k < bounding; ++k) in_.int32();
    }
  }
}

void MshReader::read_nodes_2() {
  const std::size_t count = count_line("nodes");
  for (std::size_t i = 0; i < count; ++i) {
    node_tags_.push_back(tag_2());
    Eigen::Vector3d& p = mesh_.points.emplace_back();
    for (double& x : p) x = in_.float64();
  }
}

void MshReader::read_nodes_4() {
  const std::size_t blocks = in_.count("blocks of nodes");
  check_mesh_fits(in_.count("nodes"), 0);
  in_.int64();
  in_.int64();
  for (std::size_t block = 0; block < blocks; ++block) {
    const int dimension = in_.int32();
    in_.int32();  // the entity
    const bool parametric = in_.int32() != 0;
    const std::size_t count = in_.count("nodes in a block");
    for (std::size_t i = 0; i < count; ++i) node_tags_.push_back(tag_4());
    for (std::size_t i = 0; i < count; ++i) {
      Eigen::Vector3d& p = mesh_.points.emplace_back();
      for (double& x : p) x = in_.float64();
      for (int k = 0; parametric && k < dimension; ++k) in_.float64();
    }
  }
}

const GmshElement& MshReader::element_type(int number) const {
  const GmshElement* element = find_gmsh_element(number);
  if (element == nullptr) in_.fail(fmt::format("element type {} is not known", number));
  return *element;
}

/// Adds the element whose node tags are in `element_nodes_`.
void MshReader::add_element(const GmshElement& element, std::uint64_t tag, double physical) {
  std::array<std::uint32_t, 125> points{};
  for (std::size_t k = 0; k < element_nodes_.size(); ++k) {
    points[k] = nodes_.find(element_nodes_[k]);
    if (points[k] == TagMap::kAbsent) {
      in_.fail(fmt::format("element {} names node {}, which is not among the {} nodes", tag,
                           element_nodes_[k], node_tags_.size()));
    }
  }
  add_gmsh_element(mesh_, element, points.data());
  if (is_reduced(element)) ++reduced_;
  element_tags_.push_back(tag);
  physical_.values.push_back(physical);
  has_physical_ = has_physical_ || (physical != 0 && dimension(element.type) == 3);
}

void MshReader::read_elements_2() {
  const std::size_t count = count_line("elements");
  std::size_t done = 0;
  while (done < count) {
    // In binary, elements of one type follow one head; in text each has its own.
    int tag = 0;
    if (!in_.binary()) tag = in_.int32();
    const GmshElement& element = element_type(in_.int32());
    const int following = in_.binary() ? in_.int32() : 1;
    const int tags = in_.int32();
    if (following < 1 || static_cast<std::size_t>(following) > count - done || tags < 0) {
      in_.fail("the head of a block of elements is damaged");
    }
    element_nodes_.resize(static_cast<std::size_t>(element.nodes));
    for (int i = 0; i < following; ++i, ++done) {
      if (in_.binary()) tag = in_.int32();
      double physical = 0;
      for (int k = 0; k < tags; ++k) {
        const int value = in_.int32();
        if (k == 0) physical = value;
      }
      for (std::uint64_t& node : element_nodes_) node = tag_2();
      add_element(element, static_cast<std::uint32_t>(tag), physical);
    }
  }
}

void MshReader::read_elements_4() {
  const std::size_t blocks = in_.count("blocks of elements");
  in_.count("elements");
  in_.int64();
  in_.int64();
  for (std::size_t block = 0; block < blocks; ++block) {
    const int dimension = in_.int32();
    const int entity = in_.int32();
    const GmshElement& element = element_type(in_.int32());
    const std::size_t count = in_.count("elements in a block");
    const auto physical = physical_of_.find({dimension, entity});
    element_nodes_.resize(static_cast<std::size_t>(element.nodes));
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint64_t tag = tag_4();
      for (std::uint64_t& node : element_nodes_) node = tag_4();
      add_element(element, tag, physical != physical_of_.end() ? physical->second : 0);
    }
  }
}

void MshReader::note_data(Location location) {
  std::string name = "data";
  const std::size_t strings = count_line("names");
  std::string_view line;
  if (!in_.binary()) in_.line(line);  // the rest of the line of the count
  for (std::size_t i = 0; i < strings; ++i) {
    if (!in_.line(line)) in_.fail("ends within the names of a field");
    if (line.size() > 1 && line.front() == '"' && line.back() == '"') {
      line = line.substr(1, line.size() - 2);
    }
    if (i == 0) name = line;
  }
  const bool binary = in_.binary();
  in_.set_binary(false);
  DataStep step{};
  const std::size_t reals = in_.count("real numbers");
  for (std::size_t i = 0; i < reals; ++i) {
    const double value = in_.float64();
    if (i == 0) step.time = value;
  }
  const std::size_t integers = in_.count("whole numbers");
  for (std::size_t i = 0; i < integers; ++i) {
    const std::int64_t value = in_.int64();  // the first one numbers the time steps
    if (i == 0) continue;
    if (value < 0 || static_cast<std::uint64_t>(value) > in_.bytes().size()) {
      in_.fail(fmt::format("{} values cannot be in the file", value));
    }
    if (i == 1) step.components = static_cast<std::size_t>(value);
    if (i == 2) step.count = static_cast<std::size_t>(value);
  }
  in_.line(line);
  in_.set_binary(binary);
  if (integers < 3 || step.components < 1) in_.fail("the head of a field is damaged");
  step.position = in_.position();
  const std::size_t size = binary ? step.count * (4 + 8 * step.components) : 0;
  if (size > in_.bytes().size() - in_.position()) in_.fail("ends within the values of a field");
  in_.seek(in_.position() + size);
  const DataName key{location, name};
  const auto found = std::ranges::find(data_, key, [](const auto& entry) { return entry.first; });
  if (found != data_.end()) {
    found->second.push_back(step);
  } else {
    data_.emplace_back(key, std::vector<DataStep>{step});
  }
}

void MshReader::read_data(const DataName& name, const DataStep& step) {
  const bool at_points = name.first == Location::point;
  const TagMap elements = at_points ? TagMap() : TagMap(element_tags_);
  const TagMap& places = at_points ? nodes_ : elements;
  const std::size_t size = at_points ? mesh_.points.size() : mesh_.cell_count();
  Field field{
      name.second, name.first, static_cast<int>(step.components),
      std::vector<double>(size * step.components, std::numeric_limits<double>::quiet_NaN())};
  in_.seek(step.position);
  for (std::size_t i = 0; i < step.count; ++i) {
    const std::uint64_t tag = tag_2();
    const std::uint32_t place = places.find(tag);
    if (place == TagMap::kAbsent) {
      in_.fail(fmt::format("the field '{}' has a value for the {} {}, which is not there",
                           name.second, at_points ? "node" : "element", tag));
    }
    for (std::size_t k = 0; k < step.components; ++k) {
      field.values[place * step.components + k] = in_.float64();
    }
  }
  mesh_.fields.push_back(std::move(field));
}

}  // namespace

MeshData read_msh(const std::string& file, const std::string& time) {
  MshReader reader(file);
  if (!reader.read_format()) return read_gmsh(file, time);
  return reader.read(time);
}

}  // namespace tetraglass::mesh
