#include "mesh/read_volume.h"

#include <array>
#include <bit>
#include <charconv>
#include <filesystem>
#include <string_view>

#include <fmt/format.h>

#include "base/errors.h"
#include "base/suggest.h"
#include "mesh/file_name.h"

namespace tetraglass::mesh {
namespace {

constexpr std::array<std::string_view, 10> kTypeNames = {
    "int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64", "float32", "float64"};

struct Layout {
  Volume volume;
  ValueType type = ValueType::uint8;
  bool big_endian = false;
};

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  while (true) {
    const std::size_t end = text.find(separator);
    parts.emplace_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

Layout parse_layout(const std::string& text) {
  const auto fail = [&](const std::string& what) {
    throw base::UsageError(
        fmt::format("--raw needs WIDTHxHEIGHTxDEPTH:TYPE[:little|big], such as 64x64x64:uint8; "
                    "in '{}' {}",
                    text, what));
  };
  Layout layout;
  const std::vector<std::string> parts = split(text, ':');
  if (parts.size() < 2 || parts.size() > 3) fail("there is not one type behind the size");
  const std::vector<std::string> sides = split(parts[0], 'x');
  if (sides.size() != 3) fail(fmt::format("'{}' is no size of three numbers", parts[0]));
  for (std::size_t i = 0; i < 3; ++i) {
    const char* end = sides[i].data() + sides[i].size();
    const auto [stop, error] = std::from_chars(sides[i].data(), end, layout.volume.size[i]);
    if (error != std::errc() || stop != end || layout.volume.size[i] == 0) {
      fail(fmt::format("'{}' is no number of points", sides[i]));
    }
  }
  const auto* type = std::ranges::find(kTypeNames, parts[1]);
  if (type == kTypeNames.end()) {
    fail(fmt::format("the type '{}' is not known{}; there are {}", parts[1],
                     base::suggestion(parts[1], {kTypeNames.begin(), kTypeNames.end()}),
                     fmt::join(kTypeNames, " ")));
  }
  layout.type = static_cast<ValueType>(type - kTypeNames.begin());
  if (parts.size() == 3 && parts[2] != "little" && parts[2] != "big") {
    fail(fmt::format("'{}' is neither little nor big", parts[2]));
  }
  layout.big_endian = parts.size() == 3 && parts[2] == "big";
  return layout;
}

}  // namespace

MeshData read_raw(const std::string& file, const std::string& layout) {
  Layout wanted = parse_layout(layout);
  const std::size_t count = checked_value_count(wanted.volume);
  const std::size_t bytes = count * size_of(wanted.type);
  if (const std::uintmax_t size = std::filesystem::file_size(file); size != bytes) {
    throw base::ReadError(
        file, fmt::format("{} values of {} take {} bytes, but it has {}", count,
                          kTypeNames[static_cast<std::size_t>(wanted.type)], bytes, size));
  }
  const bool swapped = wanted.big_endian != (std::endian::native == std::endian::big);
  wanted.volume.values = decode_values(content_of(file), wanted.type, swapped);
  return volume_mesh(std::move(wanted.volume));
}

MeshData read_volume(const std::string& file) {
  const std::string extension = extension_of(file);
  if (extension == ".mhd" || extension == ".mha") return volume_mesh(read_metaimage(file));
  if (extension == ".inr") return volume_mesh(read_inr(file));
  if (extension == ".slc") return volume_mesh(read_slc(file));
  return volume_mesh(read_nrrd(file));
}

}  // namespace tetraglass::mesh
