#include "mesh/read_plot3d.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/file_name.h"
#include "mesh/memory.h"
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

struct Dimensions {
  std::array<std::uint64_t, 3> n;
  [[nodiscard]] std::uint64_t points() const { return n[0] * n[1] * n[2]; }
  bool operator==(const Dimensions&) const = default;
};

enum class Content { grid, solution };

std::uint32_t word_at(const std::string& bytes, std::size_t at, bool swapped) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return swapped ? __builtin_bswap32(word) : word;
}

constexpr std::uint64_t kMark = 4;  ///< bytes of a record's length

/// The dimensions of all grids, where they make sense for a file of that size in that layout.
std::optional<std::vector<Dimensions>> read_dimensions(const std::string& bytes,
                                                       const Layout& layout) {
  std::size_t at = layout.records ? kMark : 0;
  std::uint64_t grids = 1;
  if (layout.many) {
    if (bytes.size() < at + 4) return std::nullopt;
    grids = word_at(bytes, at, layout.swapped);
    at += 4 + (layout.records ? 2 * kMark : 0);
  }
  if (grids == 0 || at > bytes.size() || grids > (bytes.size() - at) / 12) return std::nullopt;
  std::vector<Dimensions> dimensions(grids);
  std::uint64_t points = 0;
  for (Dimensions& d : dimensions) {
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

std::uint64_t expected_size(const Layout& layout, const std::vector<Dimensions>& dimensions,
                            Content content) {
  std::uint64_t size = header_size(layout, dimensions.size());
  for (const Dimensions& d : dimensions) {
    if (content == Content::grid) {
      size += framed(d.points() * (3 * layout.real + (layout.blanks ? 4 : 0)), layout);
    } else {
      size += framed(4 * layout.real, layout) + framed(5 * d.points() * layout.real, layout);
    }
  }
  return size;
}

struct Detected {
  Layout layout;
  std::vector<Dimensions> dimensions;
};

/// Whether every record stands between two lengths that are its own.
bool marks_agree(const std::string& bytes, const Detected& format, Content content) {
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
  return std::ranges::all_of(format.dimensions, [&](const Dimensions& d) {
    if (content == Content::grid) {
      return record(d.points() * (3 * layout.real + (layout.blanks ? 4 : 0)));
    }
    return record(4 * layout.real) && record(5 * d.points() * layout.real);
  });
}

/// The layout in which the dimensions at the head of the file agree with its size. A solution, the
/// dimensions of which must be those of the grid, may have zeros after its values.
std::optional<Detected> detect(const std::string& bytes, Content content,
                               const std::vector<Dimensions>* wanted = nullptr) {
  for (unsigned choice = 0; choice < 32; ++choice) {
    Layout layout;
    layout.swapped = ((choice & 1U) != 0) != (std::endian::native == std::endian::big);
    layout.records = (choice & 2U) != 0;
    layout.many = (choice & 4U) != 0;
    layout.blanks = (choice & 8U) != 0;
    layout.real = (choice & 16U) != 0 ? 8 : 4;
    if (content == Content::solution && layout.blanks) continue;
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

/// One grid or solution: the channels one after the other, each with a value per point.
struct Block {
  Dimensions dimensions;
  std::vector<double> values;
  std::vector<double> blanks;  ///< per point, empty if the file has none
};

std::vector<Block> read_binary(const std::string& bytes, const Detected& format, Content content) {
  BlockReader reader(bytes, format);
  std::vector<Block> blocks;
  for (const Dimensions& d : format.dimensions) {
    Block block{d, {}, {}};
    if (content == Content::solution) {
      std::array<double, 4> conditions{};  // Mach number, angle of attack, Reynolds number, time
      reader.begin();
      reader.read(conditions);
      reader.end();
    }
    block.values.resize((content == Content::grid ? 3 : 5) * d.points());
    reader.begin();
    reader.read(block.values);
    if (content == Content::grid && format.layout.blanks) {
      block.blanks.resize(d.points());
      reader.read_integers(block.blanks);
    }
    reader.end();
    blocks.push_back(std::move(block));
  }
  return blocks;
}

/// Whole dimensions at the head of the numbers of a text file; nothing where they are none.
std::optional<std::vector<Dimensions>> text_dimensions(std::span<const double> numbers, bool many) {
  const auto whole = [&](std::size_t at) -> std::uint64_t {
    const double value = at < numbers.size() ? numbers[at] : 0;
    const auto most = static_cast<double>(numbers.size());
    return value >= 1 && value <= most && value == std::floor(value)
               ? static_cast<std::uint64_t>(value)
               : 0;
  };
  const std::uint64_t grids = many ? whole(0) : 1;
  if (grids == 0 || 3 * grids > numbers.size()) return std::nullopt;
  std::vector<Dimensions> dimensions(grids);
  std::size_t at = many ? 1 : 0;
  for (Dimensions& d : dimensions) {
    std::uint64_t product = 1;
    for (std::uint64_t& n : d.n) {
      n = whole(at++);
      if (n == 0 || product > numbers.size() / n) return std::nullopt;
      product *= n;
    }
  }
  return dimensions;
}

std::optional<std::vector<Block>> read_text(std::span<const double> numbers, Content content) {
  for (const bool many : {false, true}) {
    const auto dimensions = text_dimensions(numbers, many);
    if (!dimensions) continue;
    const std::size_t head = (many ? 1 : 0) + 3 * dimensions->size();
    std::uint64_t points = 0;
    for (const Dimensions& d : *dimensions) points += d.points();
    for (const bool blanks : {false, true}) {
      if (content == Content::solution && blanks) continue;
      const std::size_t size = content == Content::grid
                                   ? head + points * (blanks ? 4 : 3)
                                   : head + 4 * dimensions->size() + points * 5;
      if (size != numbers.size()) continue;
      std::vector<Block> blocks;
      std::size_t at = head;
      const auto take = [&](std::size_t count) {
        const auto taken = numbers.subspan(at, count);
        at += count;
        return std::vector<double>(taken.begin(), taken.end());
      };
      for (const Dimensions& d : *dimensions) {
        Block block{d, {}, {}};
        if (content == Content::solution) at += 4;
        block.values = take((content == Content::grid ? 3 : 5) * d.points());
        if (blanks) block.blanks = take(d.points());
        blocks.push_back(std::move(block));
      }
      return blocks;
    }
  }
  return std::nullopt;
}

std::optional<std::vector<Block>> read_blocks(const std::string& file, Content content,
                                              const std::vector<Dimensions>* wanted = nullptr) {
  const std::string bytes = content_of(file);
  if (is_text(bytes)) {
    const auto numbers = parse_numbers(bytes, Repetition::allowed);
    return numbers ? read_text(*numbers, content) : std::nullopt;
  }
  const auto format = detect(bytes, content, wanted);
  if (!format) return std::nullopt;
  return read_binary(bytes, *format, content);
}

/// The names a solution may have beside that grid file, likeliest first.
std::vector<std::string> solution_names(const std::string& grid) {
  const std::filesystem::path path(grid);
  const std::string stem = path.stem().string();
  std::vector<std::string> names;
  constexpr std::string_view kGridWord = "xyz";
  if (stem.size() > kGridWord.size() && stem.ends_with(kGridWord)) {
    names.push_back(stem.substr(0, stem.size() - kGridWord.size()) + "q" +
                    path.extension().string());
  }
  names.push_back(stem + ".q");
  names.push_back(stem + ".Q");
  for (std::string& name : names) name = (path.parent_path() / name).string();
  return names;
}

void add_grid(MeshData& mesh, const Block& grid) {
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  const std::size_t points = grid.dimensions.points();
  for (std::size_t i = 0; i < points; ++i) {
    mesh.points.emplace_back(grid.values[i], grid.values[points + i], grid.values[2 * points + i]);
  }
  const auto [ni, nj, nk] = grid.dimensions.n;
  const auto visible = [&](std::uint32_t i) {
    return grid.blanks.empty() || grid.blanks[i - first] != 0;
  };
  std::size_t blanked = 0;
  for (std::uint64_t k = 0; k + 1 < nk; ++k) {
    for (std::uint64_t j = 0; j + 1 < nj; ++j) {
      for (std::uint64_t i = 0; i + 1 < ni; ++i) {
        const auto a = static_cast<std::uint32_t>(first + (k * nj + j) * ni + i);
        const auto b = static_cast<std::uint32_t>(a + ni);
        const auto up = static_cast<std::uint32_t>(ni * nj);
        const std::array<std::uint32_t, 8> corners = {a,      a + 1,      b + 1,      b,
                                                      a + up, a + 1 + up, b + 1 + up, b + up};
        if (std::ranges::all_of(corners, visible)) {
          mesh.add_cell(CellType::hexahedron, corners);
        } else {
          ++blanked;
        }
      }
    }
  }
  if (blanked > 0) mesh.notes.push_back(fmt::format("{} cells are blanked and left out", blanked));
}

void add_solution(MeshData& mesh, const std::vector<Block>& blocks,
                  const std::vector<Block>& grids) {
  Field density{"density", Location::point, 1, {}};
  Field momentum{"momentum", Location::point, 3, {}};
  Field energy{"stagnation_energy", Location::point, 1, {}};
  Field velocity{"velocity", Location::point, 3, {}};
  Field pressure{"pressure", Location::point, 1, {}};
  bool has_velocity = true;
  bool is_gas = true;
  bool is_constant = true;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const std::size_t n = blocks[b].dimensions.points();
    const std::vector<double>& q = blocks[b].values;
    for (std::size_t i = 0; i < n; ++i) {
      const double rho = q[i];
      const Eigen::Vector3d m(q[n + i], q[2 * n + i], q[3 * n + i]);
      const double e = q[4 * n + i];
      const Eigen::Vector3d u = m / rho;
      constexpr double kHeatRatio = 1.4;
      const double p = (kHeatRatio - 1) * (e - 0.5 * m.dot(u));
      density.values.push_back(rho);
      energy.values.push_back(e);
      pressure.values.push_back(p);
      momentum.values.insert(momentum.values.end(), m.begin(), m.end());
      velocity.values.insert(velocity.values.end(), u.begin(), u.end());
      if (!grids[b].blanks.empty() && grids[b].blanks[i] == 0) continue;
      has_velocity = has_velocity && rho != 0;
      is_gas = is_gas && rho > 0 && p > 0;
      is_constant = is_constant && rho == density.values.front();
    }
  }
  if (!is_gas && is_constant) {
    pressure.values = energy.values;
    mesh.notes.emplace_back(
        "the density is constant and the fifth channel is no energy of a gas: taken as the "
        "pressure");
  } else if (!is_gas) {
    mesh.notes.emplace_back("the solution is not that of an ideal gas: no pressure is derived");
  }
  mesh.fields.push_back(std::move(density));
  mesh.fields.push_back(std::move(momentum));
  if (is_gas || !is_constant) mesh.fields.push_back(std::move(energy));
  if (is_gas || is_constant) mesh.fields.push_back(std::move(pressure));
  if (has_velocity) mesh.fields.push_back(std::move(velocity));
}

void read_solution(MeshData& mesh, const std::string& file, const std::vector<Block>& grids) {
  std::vector<Dimensions> dimensions;
  for (const Block& grid : grids) dimensions.push_back(grid.dimensions);
  const auto same = [](const Block& block, const Dimensions& d) { return block.dimensions == d; };
  const auto blocks = read_blocks(file, Content::solution, &dimensions);
  if (!blocks || !std::ranges::equal(*blocks, dimensions, same)) {
    throw base::ReadError(file,
                          fmt::format("is not a complete PLOT3D solution for the grid beside "
                                      "it ({} x {} x {} points{})",
                                      dimensions[0].n[0], dimensions[0].n[1], dimensions[0].n[2],
                                      grids.size() > 1 ? ", the first of several" : ""));
  }
  add_solution(mesh, *blocks, grids);
}

}  // namespace

MeshData read_plot3d(const std::string& file) {
  const auto grids = read_blocks(file, Content::grid);
  if (!grids) {
    if (read_blocks(file, Content::solution)) {
      throw base::ReadError(file, "is a PLOT3D solution; give the grid file beside it instead");
    }
    throw base::ReadError(file,
                          fmt::format("is not a complete PLOT3D grid: its {} bytes agree with the "
                                      "dimensions at its head in no byte order and precision, with "
                                      "or without record marks and iblank",
                                      std::filesystem::file_size(file)));
  }
  MeshData mesh;
  std::size_t points = 0;
  for (const Block& grid : *grids) points += grid.dimensions.points();
  check_mesh_fits(points, points);
  for (const Block& grid : *grids) add_grid(mesh, grid);
  const std::vector<std::string> names = solution_names(file);
  const auto found = std::ranges::find_if(
      names, [](const std::string& name) { return std::filesystem::is_regular_file(name); });
  if (found != names.end()) {
    read_solution(mesh, *found, *grids);
    mesh.notes.push_back("solution: " + *found);
  } else {
    mesh.notes.push_back("there is no solution file beside it (" + names.front() + ")");
  }
  return mesh;
}

}  // namespace tetraglass::mesh
