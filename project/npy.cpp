#include "project/npy.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <regex>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/errors.h"

namespace tetraglass::project {

static_assert(std::endian::native == std::endian::little,
              "arrays are written in the machine's own byte order");

namespace {

constexpr char kMagic[] = "\x93NUMPY";
constexpr std::size_t kMagicSize = 6;
constexpr std::size_t kAlignment = 64;  // of the data in the file, as the format asks for

struct Header {
  std::string text;
  std::size_t data_start = 0;
};

Header read_header(const std::string& bytes, const std::string& file) {
  if (bytes.size() < kMagicSize + 4 || bytes.compare(0, kMagicSize, kMagic) != 0) {
    throw base::ReadError(file, "is no NumPy array: its first bytes are not those of the format");
  }
  const auto version = static_cast<unsigned char>(bytes[kMagicSize]);
  const std::size_t length_bytes = version == 1 ? 2 : 4;
  std::uint32_t length = 0;
  const std::size_t start = kMagicSize + 2 + length_bytes;
  if (version < 1 || version > 3 || bytes.size() < start) {
    throw base::ReadError(file,
                          fmt::format("NumPy format version {} is not known; 1 to 3 are", version));
  }
  std::memcpy(&length, bytes.data() + kMagicSize + 2, length_bytes);
  if (bytes.size() - start < length) throw base::ReadError(file, "is cut off inside its header");
  return {bytes.substr(start, length), start + length};
}

}  // namespace

std::string to_npy(std::span<const std::size_t> shape, std::span<const float> values) {
  std::string header = fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}{}), }}",
                                   fmt::join(shape, ", "), shape.size() == 1 ? "," : "");
  const std::size_t before = kMagicSize + 4;
  header.append((kAlignment - (before + header.size() + 1) % kAlignment) % kAlignment, ' ');
  header += '\n';
  std::string bytes(kMagic, kMagicSize);
  const auto length = static_cast<std::uint16_t>(header.size());
  bytes += '\x01';
  bytes += '\x00';
  bytes.append(reinterpret_cast<const char*>(&length), sizeof length);
  bytes += header;
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  return bytes;
}

NpyArray parse_npy(const std::string& bytes, const std::string& file) {
  const Header header = read_header(bytes, file);
  std::smatch match;
  if (!std::regex_search(header.text, match, std::regex("'descr': *'([^']*)'")) ||
      (match[1] != "<f4" && match[1] != "<f8")) {
    throw base::ReadError(file, "holds no little-endian float32 or float64 numbers ('<f4', '<f8')");
  }
  const std::size_t size = match[1] == "<f4" ? 4 : 8;
  if (!std::regex_search(header.text, std::regex("'fortran_order': *False"))) {
    throw base::ReadError(file, "is in Fortran order; save it in C order");
  }
  if (!std::regex_search(header.text, match, std::regex("'shape': *\\(([0-9, ]*)\\)"))) {
    throw base::ReadError(file, "its header has no shape");
  }
  NpyArray array;
  const std::string shape = match[1];
  std::size_t count = 1;
  const std::size_t available = (bytes.size() - header.data_start) / size;
  const std::regex number("[0-9]+");
  for (std::sregex_iterator it(shape.begin(), shape.end(), number); it != std::sregex_iterator();
       ++it) {
    const std::string digits = it->str();
    const std::size_t extent = digits.size() > 18 ? SIZE_MAX : std::stoull(digits);
    if (extent != 0 && count > available / extent) {
      throw base::ReadError(
          file, fmt::format("is cut off: its shape ({}) needs more than its {} numbers", shape,
                            available));
    }
    array.shape.push_back(extent);
    count *= extent;
  }
  const char* data = bytes.data() + header.data_start;
  array.values.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (size == 4) {
      std::memcpy(&array.values[i], data + 4 * i, 4);
    } else {
      double value = 0;
      std::memcpy(&value, data + 8 * i, 8);
      array.values[i] = static_cast<float>(value);
    }
  }
  return array;
}

}  // namespace tetraglass::project
