#include "mesh/legacy_vtk_check.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <string_view>

#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/number_stream.h"
#include "mesh/number_text.h"

namespace tetraglass::mesh {
namespace {

std::string lower(std::string_view word) {
  std::string text(word);
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// The bits of a value in the file; 0 for a type of no fixed size.
std::size_t bits(const std::string& type) {
  struct Type {
    std::string_view name;
    std::size_t bits;
  };
  constexpr auto kTypes = std::to_array<Type>({{"bit", 1},
                                               {"char", 8},
                                               {"unsigned_char", 8},
                                               {"signed_char", 8},
                                               {"short", 16},
                                               {"unsigned_short", 16},
                                               {"int", 32},
                                               {"unsigned_int", 32},
                                               {"long", 64},
                                               {"unsigned_long", 64},
                                               {"float", 32},
                                               {"double", 64},
                                               {"vtkidtype", 32},
                                               {"vtktypeint64", 64},
                                               {"vtktypeuint64", 64}});
  const auto* found = std::ranges::find(kTypes, type, &Type::name);
  return found != kTypes.end() ? found->bits : 0;
}

class LegacyChecker {
 public:
  explicit LegacyChecker(const std::string& file) : in_(file) {}
  void check();

 private:
  bool check_section(const std::string& keyword);
  std::size_t count(const char* things) {
    in_.set_binary(false);
    return in_.count(things);
  }
  /// Goes behind the line, where binary values begin.
  void begin_values() {
    std::string_view rest;
    if (binary_) in_.line(rest);
    in_.set_binary(binary_);
  }
  bool skip_values(std::size_t number, const std::string& type, const char* what);
  bool check_field();
  void skip_metadata();
  void check_cells();
  bool check_offsets();

  NumberStream in_;
  double version_ = 0;
  bool binary_ = false;
};

void LegacyChecker::check() {
  constexpr std::string_view kTitle = "# vtk DataFile Version";
  std::string_view line;
  in_.line(line);
  if (!line.starts_with(kTitle)) {
    throw base::ReadError(
        in_.file(), "is no legacy VTK file: it does not begin with '" + std::string(kTitle) + "'");
  }
  version_ = parse_number(line.substr(std::min(kTitle.size() + 1, line.size()))).value_or(0);
  in_.line(line);  // a title
  const std::string format = lower(in_.word());
  binary_ = format == "binary";
  if (!binary_ && format != "ascii") in_.fail("is neither ASCII nor BINARY");
  in_.set_swapped(std::endian::native == std::endian::little);
  while (true) {
    in_.set_binary(false);
    const std::string keyword = lower(in_.word());
    if (keyword.empty() || !check_section(keyword)) return;
  }
}

/// Whether the section is known and has been passed over.
bool LegacyChecker::check_section(const std::string& keyword) {
  if (keyword == "dataset") {
    in_.word();
  } else if (keyword == "dimensions" || keyword == "origin" || keyword == "spacing" ||
             keyword == "aspect_ratio") {
    for (int i = 0; i < 3; ++i) in_.word();
  } else if (keyword == "points") {
    const std::size_t points = count("points");
    return skip_values(3 * points, lower(in_.word()), "points");
  } else if (keyword.ends_with("_coordinates")) {
    const std::size_t number = count("coordinates");
    return skip_values(number, lower(in_.word()), "coordinates");
  } else if (keyword == "cells" || keyword == "polygons" || keyword == "lines" ||
             keyword == "vertices" || keyword == "triangle_strips") {
    if (version_ >= 5) return check_offsets();
    check_cells();
  } else if (keyword == "cell_types") {
    return skip_values(count("cell types"), "int", "cell types");
  } else if (keyword == "field") {
    return check_field();
  } else if (keyword == "metadata") {
    skip_metadata();
  } else {
    return false;
  }
  return true;
}

bool LegacyChecker::skip_values(std::size_t number, const std::string& type, const char* what) {
  const std::size_t size = bits(type);
  if (size == 0) return false;
  begin_values();
  if (binary_) {
    const std::size_t bytes = (number * size + 7) / 8;
    if (bytes > in_.bytes().size() - in_.position()) {
      in_.fail(fmt::format("is cut off: {} values of its {} take {} bytes, there are {}", number,
                           what, bytes, in_.bytes().size() - in_.position()));
    }
    in_.seek(in_.position() + bytes);
  } else {
    for (std::size_t i = 0; i < number; ++i) {
      if (in_.word().empty()) {
        in_.fail(fmt::format("is cut off: {} of {} values of its {} are there", i, number, what));
      }
    }
  }
  return true;
}

bool LegacyChecker::check_field() {
  in_.word();  // its name
  const std::size_t arrays = count("arrays");
  for (std::size_t i = 0; i < arrays; ++i) {
    const std::string name = lower(in_.word());
    if (name == "metadata") {
      skip_metadata();
      --i;
      continue;
    }
    if (name.empty()) return false;
    if (name == "null_array") continue;
    const std::size_t components = count("components");
    const std::size_t tuples = count("values");
    if (!skip_values(components * tuples, lower(in_.word()), "arrays")) return false;
    in_.set_binary(false);
  }
  return true;
}

/// It lasts until an empty line.
void LegacyChecker::skip_metadata() {
  std::string_view line;
  in_.line(line);
  while (in_.line(line) && !line.empty()) {
  }
}

/// (n, n points) for each cell, as many numbers as `size` says.
void LegacyChecker::check_cells() {
  const std::size_t cells = count("cells");
  const std::size_t size = count("numbers of cells");
  begin_values();
  std::size_t at = 0;
  for (std::size_t i = 0; i < cells; ++i) {
    const std::int64_t points = at < size ? in_.int32() : -1;
    if (points < 0 || static_cast<std::size_t>(points) > size - at - 1) {
      in_.fail(fmt::format("cell {} of {} does not fit into the {} numbers that the cells take", i,
                           cells, size));
    }
    for (std::int64_t k = 0; k < points; ++k) in_.int32();
    at += static_cast<std::size_t>(points) + 1;
  }
  if (at != size) {
    in_.fail(fmt::format("{} cells take {} numbers, not {}", cells, at, size));
  }
}

/// Version 5: where each cell begins, then all points of the cells.
bool LegacyChecker::check_offsets() {
  const std::size_t offsets = count("cells");
  const std::size_t points = count("points of cells");
  if (offsets == 0) return true;
  if (lower(in_.word()) != "offsets") return false;
  const std::string type = lower(in_.word());
  if (type != "vtktypeint64" && type != "vtktypeint32" && type != "int" && type != "long") {
    return false;
  }
  const bool is_long = type.ends_with("64") || type == "long";
  begin_values();
  std::int64_t last = 0;
  for (std::size_t i = 0; i < offsets; ++i) {
    const std::int64_t offset = is_long ? in_.int64() : in_.int32();
    if (offset < last || (i == 0 && offset != 0)) {
      in_.fail(fmt::format("cell {} begins at {}, the one before it at {}", i, offset, last));
    }
    last = offset;
  }
  if (static_cast<std::size_t>(last) != points) {
    in_.fail(fmt::format("the cells have {} points, not {}", last, points));
  }
  in_.set_binary(false);
  if (lower(in_.word()) != "connectivity") return false;
  std::string connectivity = lower(in_.word());
  if (connectivity == "vtktypeint32") connectivity = "int";
  return skip_values(points, connectivity, "cells");
}

}  // namespace

void check_legacy_vtk(const std::string& file) {
  LegacyChecker(file).check();
}

}  // namespace tetraglass::mesh
