#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/file_name.h"
#include "mesh/number_text.h"
#include "mesh/read_surface.h"

namespace tetraglass::mesh {
namespace {

enum class Number { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct Property {
  std::string name;
  Number type = Number::float32;
  std::optional<Number> count_type;  ///< of a list
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

enum class Encoding { text, little_endian, big_endian };

struct Header {
  Encoding encoding = Encoding::text;
  std::vector<Element> elements;
  std::size_t size = 0;  ///< in bytes
};

std::optional<Number> number_type(std::string_view word) {
  constexpr std::array<std::string_view, 8> kOld = {"char", "uchar", "short", "ushort",
                                                    "int",  "uint",  "float", "double"};
  constexpr std::array<std::string_view, 8> kNew = {"int8",  "uint8",  "int16",   "uint16",
                                                    "int32", "uint32", "float32", "float64"};
  for (std::size_t i = 0; i < kOld.size(); ++i) {
    if (word == kOld[i] || word == kNew[i]) return static_cast<Number>(i);
  }
  return std::nullopt;
}

class PlyReader {
 public:
  explicit PlyReader(const std::string& file) : file_(file), bytes_(content_of(file)) {}

  MeshData read();

 private:
  [[noreturn]] void fail(const std::string& what) const { throw base::ReadError(file_, what); }
  std::vector<std::string_view> header_line(std::size_t& at) const;
  Header read_header() const;
  void add_element(const std::vector<std::string_view>& words, Header& header) const;
  void add_property(const std::vector<std::string_view>& words, Header& header) const;
  void read_vertices(const Element& element);
  void read_faces(const Element& element);
  void skip(const Element& element);
  double next(Number type);
  double next_text();
  template <typename T>
  double next_binary();
  std::size_t next_count(const Property& list);

  std::string file_;
  std::string bytes_;
  Encoding encoding_ = Encoding::text;
  std::size_t at_ = 0;
  MeshData mesh_;
};

std::vector<std::string_view> PlyReader::header_line(std::size_t& at) const {
  const std::size_t end = bytes_.find('\n', at);
  if (end == std::string::npos) fail("its header has no end ('end_header')");
  std::string_view line = std::string_view(bytes_).substr(at, end - at);
  at = end + 1;
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t start = line.find_first_not_of(" \t\r");
    if (start == std::string_view::npos) return words;
    line.remove_prefix(start);
    const std::size_t stop = std::min(line.find_first_of(" \t\r"), line.size());
    words.push_back(line.substr(0, stop));
    line.remove_prefix(stop);
  }
}

Header PlyReader::read_header() const {
  if (!bytes_.starts_with("ply")) fail("is no PLY file: it does not begin with 'ply'");
  Header header;
  while (true) {
    const std::vector<std::string_view> words = header_line(header.size);
    if (words.empty()) continue;
    if (words[0] == "end_header") return header;
    if (words[0] == "format" && words.size() > 1) {
      if (words[1] == "binary_little_endian") {
        header.encoding = Encoding::little_endian;
      } else if (words[1] == "binary_big_endian") {
        header.encoding = Encoding::big_endian;
      } else if (words[1] != "ascii") {
        fail(fmt::format("its format '{}' is not known", words[1]));
      }
    } else if (words[0] == "element") {
      add_element(words, header);
    } else if (words[0] == "property") {
      add_property(words, header);
    }
  }
}

void PlyReader::add_element(const std::vector<std::string_view>& words, Header& header) const {
  const auto count = words.size() > 2 ? parse_number(words[2]) : std::nullopt;
  // The smallest element takes a byte.
  if (!count || *count < 0 || *count != std::floor(*count) ||
      *count > static_cast<double>(bytes_.size())) {
    fail(fmt::format("its header claims {} elements '{}' in {} bytes",
                     words.size() > 2 ? words[2] : "no number of", words.size() > 1 ? words[1] : "",
                     bytes_.size()));
  }
  header.elements.push_back({std::string(words[1]), static_cast<std::size_t>(*count), {}});
}

void PlyReader::add_property(const std::vector<std::string_view>& words, Header& header) const {
  const bool is_list = words.size() > 1 && words[1] == "list";
  const auto type =
      words.size() > (is_list ? 4 : 2) ? number_type(words[is_list ? 3 : 1]) : std::nullopt;
  const auto count_type = is_list && type ? number_type(words[2]) : std::nullopt;
  if (!type || (is_list && !count_type) || header.elements.empty()) {
    fail(fmt::format("its header has a property that is not understood: '{}'",
                     fmt::join(words, " ")));
  }
  header.elements.back().properties.push_back({std::string(words.back()), *type, count_type});
}

double PlyReader::next_text() {
  constexpr std::string_view kSpaces = " \t\r\n";
  const std::size_t start = bytes_.find_first_not_of(kSpaces, at_);
  if (start == std::string::npos) fail("is cut off: its values end too early");
  const std::size_t end = std::min(bytes_.find_first_of(kSpaces, start), bytes_.size());
  const std::string_view word = std::string_view(bytes_).substr(start, end - start);
  const auto value = parse_number(word);
  if (!value) fail(fmt::format("'{}' is no number", word));
  at_ = end;
  return *value;
}

template <typename T>
double PlyReader::next_binary() {
  std::array<char, sizeof(T)> raw{};
  if (bytes_.size() - at_ < sizeof(T)) fail("is cut off: its values end too early");
  std::memcpy(raw.data(), bytes_.data() + at_, sizeof(T));
  at_ += sizeof(T);
  const bool big = encoding_ == Encoding::big_endian;
  if (big != (std::endian::native == std::endian::big)) std::ranges::reverse(raw);
  return static_cast<double>(std::bit_cast<T>(raw));
}

double PlyReader::next(Number type) {
  if (encoding_ == Encoding::text) return next_text();
  switch (type) {
    case Number::int8:
      return next_binary<std::int8_t>();
    case Number::uint8:
      return next_binary<std::uint8_t>();
    case Number::int16:
      return next_binary<std::int16_t>();
    case Number::uint16:
      return next_binary<std::uint16_t>();
    case Number::int32:
      return next_binary<std::int32_t>();
    case Number::uint32:
      return next_binary<std::uint32_t>();
    case Number::float32:
      return next_binary<float>();
    case Number::float64:
      return next_binary<double>();
  }
  return 0;
}

std::size_t PlyReader::next_count(const Property& list) {
  const double count = next(*list.count_type);
  if (!(count >= 0) || count > static_cast<double>(bytes_.size() - at_)) {
    fail(fmt::format("a list '{}' of {} values cannot be in a file of {} bytes", list.name, count,
                     bytes_.size()));
  }
  return static_cast<std::size_t>(count);
}

void PlyReader::skip(const Element& element) {
  if (element.properties.empty()) return;
  for (std::size_t i = 0; i < element.count; ++i) {
    for (const Property& property : element.properties) {
      const std::size_t count = property.count_type ? next_count(property) : 1;
      for (std::size_t k = 0; k < count; ++k) next(property.type);
    }
  }
}

void PlyReader::read_vertices(const Element& element) {
  // How a vertex looks is no field to look at.
  constexpr auto kLooks =
      std::to_array<std::string_view>({"nx", "ny", "nz", "red", "green", "blue", "alpha", "u", "v",
                                       "s", "t", "texture_u", "texture_v"});
  const std::size_t n = element.properties.size();
  std::array<std::size_t, 3> axes{n, n, n};
  std::vector<std::size_t> field_of(n);  // 0: none, else the number of the field + 1
  std::vector<Field> fields;
  for (std::size_t i = 0; i < n; ++i) {
    const Property& property = element.properties[i];
    if (property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z') {
      axes[static_cast<std::size_t>(property.name[0] - 'x')] = i;
    } else if (!property.count_type &&
               std::ranges::find(kLooks, std::string_view(property.name)) == kLooks.end()) {
      fields.push_back({property.name, Location::point, 1, {}});
      field_of[i] = fields.size();
    }
  }
  if (std::ranges::find(axes, n) != axes.end()) fail("its points have no x, y and z");
  std::vector<double> values(n);
  for (std::size_t v = 0; v < element.count; ++v) {
    for (std::size_t i = 0; i < n; ++i) {
      const Property& property = element.properties[i];
      const std::size_t count = property.count_type ? next_count(property) : 1;
      for (std::size_t k = 0; k < count; ++k) values[i] = next(property.type);
      if (field_of[i] > 0) fields[field_of[i] - 1].values.push_back(values[i]);
    }
    mesh_.points.emplace_back(values[axes[0]], values[axes[1]], values[axes[2]]);
  }
  mesh_.fields = std::move(fields);
}

void PlyReader::read_faces(const Element& element) {
  std::vector<std::uint32_t> face;
  for (std::size_t i = 0; i < element.count; ++i) {
    for (const Property& property : element.properties) {
      const std::size_t count = property.count_type ? next_count(property) : 1;
      const bool corners = property.count_type &&
                           (property.name == "vertex_indices" || property.name == "vertex_index");
      face.clear();
      for (std::size_t k = 0; k < count; ++k) {
        const double value = next(property.type);
        if (!corners) continue;
        if (!(value >= 0) || value >= static_cast<double>(mesh_.points.size())) {
          fail(fmt::format("face {} names point {}, but there are {} points", i, value,
                           mesh_.points.size()));
        }
        face.push_back(static_cast<std::uint32_t>(value));
      }
      if (face.empty()) continue;
      mesh_.add_cell(face.size() == 3   ? CellType::triangle
                     : face.size() == 4 ? CellType::quad
                                        : CellType::polygon,
                     face);
    }
  }
}

MeshData PlyReader::read() {
  const Header header = read_header();
  encoding_ = header.encoding;
  at_ = header.size;
  for (const Element& element : header.elements) {
    if (element.name == "vertex") {
      read_vertices(element);
    } else if (element.name == "face") {
      read_faces(element);
    } else {
      skip(element);
    }
  }
  return std::move(mesh_);
}

}  // namespace

MeshData read_ply(const std::string& file) {
  return PlyReader(file).read();
}

}  // namespace tetraglass::mesh
