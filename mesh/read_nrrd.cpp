#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/file_name.h"
#include "mesh/number_text.h"
#include "mesh/read_volume.h"
#include "mesh/volume_header.h"

namespace tetraglass::mesh {
namespace {

/// An axis of the array: of space, or of the values at a point.
struct Axis {
  std::size_t size = 0;
  std::optional<Eigen::Vector3d> direction;
  std::optional<double> spacing;
  std::optional<double> min;
  std::string kind;

  [[nodiscard]] bool is_space() const {
    return direction || spacing || min || kind == "domain" || kind == "space";
  }
};

class NrrdReader {
 public:
  explicit NrrdReader(const std::string& file)
      : file_(file), content_(content_of(file)), header_(file) {}

  Volume read();

 private:
  std::string_view take_line();
  void read_header();
  void read_axes();
  void find_directions(std::string_view text);
  void place(Volume& volume) const;
  [[nodiscard]] std::vector<std::size_t> space_axes() const;
  [[nodiscard]] ValueType value_type() const;
  [[nodiscard]] Packing packing() const;
  std::string_view data(std::string& other_file);
  [[nodiscard]] std::string several_files(std::string_view name) const;

  std::string file_;
  std::string content_;
  std::size_t at_ = 0;
  VolumeHeader header_;
  std::vector<Axis> axes_;
  std::vector<std::string> listed_;  ///< the files with the values, where they are told one by one
};

std::string lower(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

std::string_view NrrdReader::take_line() {
  const std::size_t end = std::min(content_.find('\n', at_), content_.size());
  std::string_view line = std::string_view(content_).substr(at_, end - at_);
  at_ = std::min(end + 1, content_.size());
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

void NrrdReader::read_header() {
  if (!take_line().starts_with("NRRD000"))
    header_.fail("is no NRRD file: its first line is not NRRD000N");
  while (at_ < content_.size()) {
    const std::string_view line = take_line();
    if (line.empty()) return;
    if (line.starts_with('#')) continue;
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos) {
      header_.fail(fmt::format("its head has the line '{:.40}', which is no field", line));
    }
    // 'key:=value' is a remark of other programs.
    if (line.substr(colon + 1).starts_with('=')) continue;
    const std::string key = lower(trimmed(line.substr(0, colon)));
    const std::string_view value = trimmed(line.substr(colon + 1));
    header_.add(key, std::string(value));
    if ((key == "data file" || key == "datafile") && value.starts_with("LIST")) {
      while (at_ < content_.size()) listed_.emplace_back(trimmed(take_line()));
      std::erase(listed_, "");
    }
  }
}

/// "(1,0,0) none (0,2.5,0)": an entry for each axis.
void NrrdReader::find_directions(std::string_view text) {
  for (Axis& axis : axes_) {
    text = trimmed(text);
    if (text.starts_with("none")) {
      text.remove_prefix(4);
      axis.kind = "none";
      continue;
    }
    const std::size_t end = text.find(')');
    const auto numbers = text.starts_with('(') && end != std::string_view::npos
                             ? parse_numbers(text.substr(1, end - 1))
                             : std::nullopt;
    if (!numbers || numbers->size() != 3) {
      header_.fail("its 'space directions' are not of three numbers for each axis");
    }
    axis.direction = Eigen::Vector3d(numbers->data());
    text.remove_prefix(end + 1);
  }
}

void NrrdReader::read_axes() {
  const std::vector<std::size_t> sizes = header_.counts("sizes", header_.get({"sizes"}), 1);
  const std::vector<std::size_t> dimension =
      header_.counts("dimension", header_.get({"dimension"}), 1);
  constexpr std::size_t kMost = 16;  // the format's
  if (dimension.size() != 1 || dimension[0] != sizes.size() || sizes.size() > kMost) {
    header_.fail("its 'dimension' and its number of 'sizes' differ");
  }
  for (const std::size_t size : sizes) axes_.push_back({size, {}, {}, {}, {}});
  const auto each = [&](std::string_view key, const auto& take) {
    const auto value = header_.find({key});
    if (!value) return;
    const std::vector<std::string_view> words = words_of(*value);
    if (words.size() != axes_.size()) {
      header_.fail(fmt::format("its '{}' are {}, for {} axes", key, words.size(), axes_.size()));
    }
    for (std::size_t i = 0; i < words.size(); ++i) take(axes_[i], words[i]);
  };
  each("kinds", [](Axis& axis, std::string_view word) {
    if (word != "???") axis.kind = lower(word);
  });
  const auto number = [](std::string_view word) -> std::optional<double> {
    const auto value = parse_number(word);
    return value && std::isfinite(*value) ? value : std::nullopt;  // NaN: none
  };
  each("spacings", [&](Axis& axis, std::string_view word) { axis.spacing = number(word); });
  each("axis mins", [&](Axis& axis, std::string_view word) { axis.min = number(word); });
  if (const auto directions = header_.find({"space directions"})) find_directions(*directions);
}

/// The three axes that are of space, from what is told of them.
std::vector<std::size_t> NrrdReader::space_axes() const {
  std::vector<std::size_t> space;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (axes_[i].is_space()) space.push_back(i);
  }
  constexpr std::size_t kMostColors = 4;
  const bool nothing_told =
      space.empty() && std::ranges::all_of(axes_, [](const Axis& a) { return a.kind.empty(); });
  if (nothing_told && axes_.size() == 3) {
    // Colors come first, and are all that a first axis so short is used for.
    if (axes_[0].size <= kMostColors) {
      throw base::InputError(
          fmt::format("is an image of {} x {} pixels with {} values each, and no volume",
                      axes_[1].size, axes_[2].size, axes_[0].size));
    }
    return {0, 1, 2};
  }
  if (space.size() != 3) {
    throw base::InputError(
        fmt::format("is no volume: of its {} axes, {} are told to be of space ('kinds', "
                    "'spacings' or 'space directions')",
                    axes_.size(), space.size()));
  }
  return space;
}

void NrrdReader::place(Volume& volume) const {
  const std::vector<std::size_t> space = space_axes();
  for (std::size_t i = 0; i < 3; ++i) {
    const Axis& axis = axes_[space[i]];
    const auto column = static_cast<Eigen::Index>(i);
    volume.size[i] = axis.size;
    if (axis.direction) {
      volume.axes.col(column) = *axis.direction;
    } else {
      volume.axes.col(column) *= axis.spacing.value_or(1);
      volume.origin[column] = axis.min.value_or(0);
    }
  }
  if (const auto origin = header_.find({"space origin"})) {
    const std::string_view text = trimmed(*origin);
    const auto numbers = text.size() > 2 && text.front() == '(' && text.back() == ')'
                             ? parse_numbers(text.substr(1, text.size() - 2))
                             : std::nullopt;
    if (!numbers || numbers->size() != 3) {
      header_.fail("its 'space origin' is not of three numbers");
    }
    volume.origin = Eigen::Vector3d(numbers->data());
  }
  std::size_t components = 1;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (std::ranges::find(space, i) != space.end()) continue;
    // The values of a point lie beside each other only where their axis is the first one.
    if (i >= space[0] && axes_[i].size > 1) {
      throw base::InputError(fmt::format(
          "its axis {} is not of space and not before those that are; such files are not read", i));
    }
    components = std::min<std::size_t>(components * std::min<std::size_t>(axes_[i].size, 1U << 20U),
                                       1U << 20U);
  }
  volume.components = static_cast<int>(components);
}

ValueType NrrdReader::value_type() const {
  struct Name {
    std::string_view name;
    ValueType type;
  };
  constexpr auto kNames = std::to_array<Name>({{"signed char", ValueType::int8},
                                               {"int8", ValueType::int8},
                                               {"int8_t", ValueType::int8},
                                               {"uchar", ValueType::uint8},
                                               {"unsigned char", ValueType::uint8},
                                               {"uint8", ValueType::uint8},
                                               {"uint8_t", ValueType::uint8},
                                               {"short", ValueType::int16},
                                               {"short int", ValueType::int16},
                                               {"signed short", ValueType::int16},
                                               {"signed short int", ValueType::int16},
                                               {"int16", ValueType::int16},
                                               {"int16_t", ValueType::int16},
                                               {"ushort", ValueType::uint16},
                                               {"unsigned short", ValueType::uint16},
                                               {"unsigned short int", ValueType::uint16},
                                               {"uint16", ValueType::uint16},
                                               {"uint16_t", ValueType::uint16},
                                               {"int", ValueType::int32},
                                               {"signed int", ValueType::int32},
                                               {"int32", ValueType::int32},
                                               {"int32_t", ValueType::int32},
                                               {"uint", ValueType::uint32},
                                               {"unsigned int", ValueType::uint32},
                                               {"uint32", ValueType::uint32},
                                               {"uint32_t", ValueType::uint32},
                                               {"longlong", ValueType::int64},
                                               {"long long", ValueType::int64},
                                               {"long long int", ValueType::int64},
                                               {"signed long long", ValueType::int64},
                                               {"signed long long int", ValueType::int64},
                                               {"int64", ValueType::int64},
                                               {"int64_t", ValueType::int64},
                                               {"ulonglong", ValueType::uint64},
                                               {"unsigned long long", ValueType::uint64},
                                               {"unsigned long long int", ValueType::uint64},
                                               {"uint64", ValueType::uint64},
                                               {"uint64_t", ValueType::uint64},
                                               {"float", ValueType::float32},
                                               {"double", ValueType::float64}});
  const std::string name = lower(header_.get({"type"}));
  const auto* found = std::ranges::find(kNames, name, &Name::name);
  if (found == kNames.end()) header_.fail(fmt::format("its type '{:.40}' is not known", name));
  return found->type;
}

Packing NrrdReader::packing() const {
  const std::string name = lower(header_.get({"encoding"}));
  if (name == "raw") return Packing::none;
  if (name == "gzip" || name == "gz") return Packing::gzip;
  if (name == "bzip2" || name == "bz2") return Packing::bzip2;
  if (name == "text" || name == "txt" || name == "ascii") return Packing::text;
  header_.fail(fmt::format("its encoding '{:.40}' is not read", name));
}

/// The values in the files that LIST or a pattern tells of; of unpacked ones, that is, from the
/// first of their bytes on.
std::string NrrdReader::several_files(std::string_view name) const {
  if (packing() != Packing::none || header_.find({"line skip", "lineskip"}) ||
      header_.find({"byte skip", "byteskip"})) {
    header_.fail("its values are in several files, which are read raw and without skips only");
  }
  return header_.joined(name.starts_with("LIST") ? listed_ : header_.numbered(name), 0);
}

/// What follows the head, or the other files that it names, without the lines to skip.
std::string_view NrrdReader::data(std::string& other_file) {
  std::string_view bytes = std::string_view(content_).substr(at_);
  if (const auto name = header_.find({"data file", "datafile"})) {
    const bool several = name->starts_with("LIST") || name->find('%') != std::string_view::npos;
    other_file = several ? several_files(*name) : content_of(header_.beside(*name));
    bytes = other_file;
  }
  if (const auto skip = header_.find({"line skip", "lineskip"})) {
    const std::vector<std::size_t> count = header_.counts("line skip", *skip, 0);
    for (std::size_t i = 0; i < (count.empty() ? 0 : count[0]); ++i) {
      const std::size_t end = bytes.find('\n');
      if (end == std::string_view::npos) header_.fail("it ends within the lines to skip");
      bytes.remove_prefix(end + 1);
    }
  }
  return bytes;
}

Volume NrrdReader::read() {
  read_header();
  read_axes();
  Volume volume;
  if (const auto name = header_.find({"content"}); name && !name->empty()) volume.name = *name;
  place(volume);
  const ValueType type = value_type();
  const Packing packing = this->packing();
  const std::string endian(header_.find({"endian"}).value_or(""));
  if (size_of(type) > 1 && packing != Packing::text && endian != "little" && endian != "big") {
    header_.fail("its head does not tell the byte order ('endian')");
  }
  std::int64_t skip = 0;
  if (const auto value = header_.find({"byte skip", "byteskip"})) {
    const std::vector<double> numbers = header_.numbers("byte skip", *value);
    constexpr double kMost = 1e15;
    if (numbers.size() != 1 || !(numbers[0] >= -1 && numbers[0] < kMost) ||
        numbers[0] != std::floor(numbers[0])) {
      header_.fail(
          fmt::format("its 'byte skip' is {:.40}: -1 or a number of bytes is needed", *value));
    }
    skip = static_cast<std::int64_t>(numbers[0]);
  }
  std::string other_file;
  take_values(volume, data(other_file), packing, type, endian == "big", skip);
  return volume;
}

}  // namespace

Volume read_nrrd(const std::string& file) {
  return NrrdReader(file).read();
}

}  // namespace tetraglass::mesh
