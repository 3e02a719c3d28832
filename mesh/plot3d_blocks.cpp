#include "mesh/plot3d_blocks.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <span>

#include "mesh/file_name.h"
#include "mesh/number_text.h"

namespace tetraglass::mesh {
namespace {

/// How the numbers of a file are stored.
struct Layout {
  bool swapped = false;  ///< the byte order is not this machine's
  bool records = false;  ///< every block between two 4-byte lengths, as Fortran writes it
  bool many = false;     ///< the number of grids comes first
  bool blanks = false;   ///< an integer per point after the coordinates
  std::size_t real = 4;  ///< bytes of a value
};

std::uint32_t word_at(const std::string& bytes, std::size_t at, bool swapped) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return swapped ? __builtin_bswap32(word) : word;
}

constexpr std::uint64_t kMark = 4;  ///< bytes of a record's length

/// The dimensions of all grids, where they make sense for a file of that size in that layout.
std::optional<std::vector<Plot3dDimensions>> read_dimensions(const std::string& bytes,
                                                             const Layout& layout) {
  std::size_t at = layout.records ? kMark : 0;
  std::uint64_t grids = 1;
  if (layout.many) {
    if (bytes.size() < at + 4) return std::nullopt;
    grids = word_at(bytes, at, layout.swapped);
    at += 4 + (layout.records ? 2 * kMark : 0);
  }
  if (grids == 0 || at > bytes.size() || grids > (bytes.size() - at) / 12) return std::nullopt;
  std::vector<Plot3dDimensions> dimensions(grids);
  std::uint64_t points = 0;
  for (Plot3dDimensions& d : dimensions) {
    std::uint64_t product = 1;
    for (std::uint64_t& n : d.n) {
      n = word_at(bytes, at, layout.swapped);
      at += 4;
      // Each point takes more than one byte, so this also keeps the products from overflowing.
      if (n == 0 || n > bytes.size() || product > bytes.size() / n) return std::nullopt;
      product *= n;
    }
    points += product;
    if (points > bytes.size()) return std::nullopt;
  }
  return dimensions;
}

/// The bytes of a block with its record marks.
std::uint64_t framed(std::uint64_t bytes, const Layout& layout) {
  return bytes + (layout.records ? 2 * kMark : 0);
}

std::uint64_t header_size(const Layout& layout, std::size_t grids) {
  return (layout.many ? framed(4, layout) : 0) + framed(12 * grids, layout);
}

std::uint64_t expected_size(const Layout& layout, const std::vector<Plot3dDimensions>& dimensions,
                            Plot3dContent content) {
  std::uint64_t size = header_size(layout, dimensions.size());
  for (const Plot3dDimensions& d : dimensions) {
    if (content == Plot3dContent::grid) {
      size += framed(d.points() * (3 * layout.real + (layout.blanks ? 4 : 0)), layout);
    } else {
      size += framed(4 * layout.real, layout) + framed(5 * d.points() * layout.real, layout);
    }
  }
  return size;
}

struct Detected {
  Layout layout;
  std::vector<Plot3dDimensions> dimensions;
};

/// Whether every record stands between two lengths that are its own.
bool marks_agree(const std::string& bytes, const Detected& format, Plot3dContent content) {
  const Layout& layout = format.layout;
  std::size_t at = 0;
  const auto record = [&](std::uint64_t size) {
    const std::size_t end = at + kMark + size;
    if (end + kMark > bytes.size()) return false;
    const bool agrees =
        word_at(bytes, at, layout.swapped) == size && word_at(bytes, end, layout.swapped) == size;
    at = end + kMark;
    return agrees;
  };
  if (layout.many && !record(4)) return false;
  if (!record(12 * format.dimensions.size())) return false;
  return std::ranges::all_of(format.dimensions, [&](const Plot3dDimensions& d) {
    if (content == Plot3dContent::grid) {
      return record(d.points() * (3 * layout.real + (layout.blanks ? 4 : 0)));
    }
    return record(4 * layout.real) && record(5 * d.points() * layout.real);
  });
}

/// The layout in which the dimensions at the head of the file agree with its size. A solution, the
/// dimensions of which must be those of the grid, may have zeros after its values.
std::optional<Detected> detect(const std::string& bytes, Plot3dContent content,
                               const std::vector<Plot3dDimensions>* wanted = nullptr) {
  for (unsigned choice = 0; choice < 32; ++choice) {
    Layout layout;
    layout.swapped = ((choice & 1U) != 0) != (std::endian::native == std::endian::big);
    layout.records = (choice & 2U) != 0;
    layout.many = (choice & 4U) != 0;
    layout.blanks = (choice & 8U) != 0;
    layout.real = (choice & 16U) != 0 ? 8 : 4;
    if (content == Plot3dContent::solution && layout.blanks) continue;
    const auto dimensions = read_dimensions(bytes, layout);
    if (!dimensions) continue;
    const std::uint64_t size = expected_size(layout, *dimensions, content);
    if (wanted != nullptr && *dimensions != *wanted) continue;
    const bool fits =
        size == bytes.size() || (wanted != nullptr && size < bytes.size() &&
                                 bytes.find_first_not_of('\0', size) == std::string::npos);
    const Detected format{layout, *dimensions};
    if (fits && (!layout.records || marks_agree(bytes, format, content))) return format;
  }
  return std::nullopt;
}

/// Takes the blocks of a binary file one after the other.
class BlockReader {
 public:
  BlockReader(const std::string& bytes, const Detected& format)
      : bytes_(bytes),
        layout_(format.layout),
        at_(header_size(format.layout, format.dimensions.size())) {}

  void begin() { at_ += layout_.records ? kMark : 0; }
  void end() { at_ += layout_.records ? kMark : 0; }

  void read(std::span<double> values) {
    for (double& value : values) {
      if (layout_.real == 4) {
        value = std::bit_cast<float>(word_at(bytes_, at_, layout_.swapped));
      } else {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes_.data() + at_, sizeof word);
        value = std::bit_cast<double>(layout_.swapped ? __builtin_bswap64(word) : word);
      }
      at_ += layout_.real;
    }
  }

  void read_integers(std::span<double> values) {
    for (double& value : values) {
      value = static_cast<std::int32_t>(word_at(bytes_, at_, layout_.swapped));
      at_ += 4;
    }
  }

 private:
  const std::string& bytes_;
  const Layout layout_;
  std::size_t at_;
};

std::vector<Plot3dBlock> read_binary(const std::string& bytes, const Detected& format,
                                     Plot3dContent content) {
  BlockReader reader(bytes, format);
  std::vector<Plot3dBlock> blocks;
  for (const Plot3dDimensions& d : format.dimensions) {
    Plot3dBlock block{d, {}, {}};
    if (content == Plot3dContent::solution) {
      std::array<double, 4> conditions{};  // Mach number, angle of attack, Reynolds number, time
      reader.begin();
      reader.read(conditions);
      reader.end();
    }
    block.values.resize((content == Plot3dContent::grid ? 3 : 5) * d.points());
    reader.begin();
    reader.read(block.values);
    if (content == Plot3dContent::grid && format.layout.blanks) {
      block.blanks.resize(d.points());
      reader.read_integers(block.blanks);
    }
    reader.end();
    blocks.push_back(std::move(block));
  }
  return blocks;
}

/// Whole dimensions at the head of the numbers of a text file; nothing where they are none.
std::optional<std::vector<Plot3dDimensions>> text_dimensions(std::span<const double> numbers,
                                                             bool many) {
  const auto whole = [&](std::size_t at) -> std::uint64_t {
    const double value = at < numbers.size() ? numbers[at] : 0;
    const auto most = static_cast<double>(numbers.size());
    return value >= 1 && value <= most && value == std::floor(value)
               ? static_cast<std::uint64_t>(value)
               : 0;
  };
  const std::uint64_t grids = many ? whole(0) : 1;
  if (grids == 0 || 3 * grids > numbers.size()) return std::nullopt;
  std::vector<Plot3dDimensions> dimensions(grids);
  std::size_t at = many ? 1 : 0;
  for (Plot3dDimensions& d : dimensions) {
    std::uint64_t product = 1;
    for (std::uint64_t& n : d.n) {
      n = whole(at++);
      if (n == 0 || product > numbers.size() / n) return std::nullopt;
      product *= n;
    }
  }
  return dimensions;
}

std::optional<std::vector<Plot3dBlock>> read_text(std::span<const double> numbers,
                                                  Plot3dContent content) {
  for (const bool many : {false, true}) {
    const auto dimensions = text_dimensions(numbers, many);
    if (!dimensions) continue;
    const std::size_t head = (many ? 1 : 0) + 3 * dimensions->size();
    std::uint64_t points = 0;
    for (const Plot3dDimensions& d : *dimensions) points += d.points();
    for (const bool blanks : {false, true}) {
      if (content == Plot3dContent::solution && blanks) continue;
      const std::size_t size = content == Plot3dContent::grid
                                   ? head + points * (blanks ? 4 : 3)
                                   : head + 4 * dimensions->size() + points * 5;
      if (size != numbers.size()) continue;
      std::vector<Plot3dBlock> blocks;
      std::size_t at = head;
      const auto take = [&](std::size_t count) {
        const auto taken = numbers.subspan(at, count);
        at += count;
        return std::vector<double>(taken.begin(), taken.end());
      };
      for (const Plot3dDimensions& d : *dimensions) {
        Plot3dBlock block{d, {}, {}};
        if (content == Plot3dContent::solution) at += 4;
        block.values = take((content == Plot3dContent::grid ? 3 : 5) * d.points());
        if (blanks) block.blanks = take(d.points());
        blocks.push_back(std::move(block));
      }
      return blocks;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::vector<Plot3dBlock>> read_plot3d_blocks(
    const std::string& file, Plot3dContent content, const std::vector<Plot3dDimensions>* wanted) {
  const std::string bytes = content_of(file);
  if (is_text(bytes)) {
    const auto numbers = parse_numbers(bytes, Repetition::allowed);
    return numbers ? read_text(*numbers, content) : std::nullopt;
  }
  const auto format = detect(bytes, content, wanted);
  if (!format) return std::nullopt;
  return read_binary(bytes, *format, content);
}

}  // namespace tetraglass::mesh
