#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/file_name.h"
#include "mesh/read_volume.h"
#include "mesh/volume_header.h"

namespace tetraglass::mesh {
namespace {

class MetaImageReader {
 public:
  explicit MetaImageReader(const std::string& file)
      : file_(file), content_(content_of(file)), header_(file) {}

  Volume read();

 private:
  void read_header();
  [[nodiscard]] bool is_true(std::initializer_list<std::string_view> keys) const;
  [[nodiscard]] std::vector<double> three_numbers(
      std::initializer_list<std::string_view> keys) const;
  void place(Volume& volume) const;
  [[nodiscard]] ValueType value_type() const;
  [[nodiscard]] std::vector<std::string> listed_files() const;

  std::string file_;
  std::string content_;
  std::size_t at_ = 0;
  VolumeHeader header_;
};

/// Lines "Key = value", of which the last one is ElementDataFile.
void MetaImageReader::read_header() {
  while (at_ < content_.size()) {
    const std::size_t end = std::min(content_.find('\n', at_), content_.size());
    const std::string_view line = std::string_view(content_).substr(at_, end - at_);
    at_ = std::min(end + 1, content_.size());
    if (trimmed(line).empty()) continue;
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) {
      header_.fail("is no MetaImage file: a line of its head is not 'Key = value'");
    }
    const std::string_view key = trimmed(line.substr(0, equals));
    header_.add(std::string(key), std::string(trimmed(line.substr(equals + 1))));
    if (key == "ElementDataFile") return;
  }
  header_.fail("is no complete MetaImage file: 'ElementDataFile' is missing");
}

bool MetaImageReader::is_true(std::initializer_list<std::string_view> keys) const {
  const auto value = header_.find(keys);
  return value && !value->empty() &&
         (value->front() == 'T' || value->front() == 't' || value->front() == '1');
}

/// Empty where no such key is.
std::vector<double> MetaImageReader::three_numbers(
    std::initializer_list<std::string_view> keys) const {
  const auto value = header_.find(keys);
  if (!value) return {};
  std::vector<double> numbers = header_.numbers(*keys.begin(), *value);
  if (numbers.size() != 3) header_.fail(fmt::format("'{}' is not of 3 numbers", *keys.begin()));
  return numbers;
}

void MetaImageReader::place(Volume& volume) const {
  const std::vector<std::size_t> size = header_.counts("DimSize", header_.get({"DimSize"}), 1);
  const std::vector<std::size_t> dimensions = header_.counts("NDims", header_.get({"NDims"}), 1);
  if (dimensions.size() != 1 || dimensions[0] != size.size()) {
    header_.fail("'NDims' and the number of sizes in 'DimSize' differ");
  }
  if (size.size() != 3) {
    throw base::InputError(fmt::format("has {} dimensions, and is no volume", size.size()));
  }
  std::ranges::copy(size, volume.size.begin());
  if (const auto matrix = header_.find({"TransformMatrix", "Rotation", "Orientation"})) {
    const std::vector<double> numbers = header_.numbers("TransformMatrix", *matrix);
    if (numbers.size() != 9) header_.fail("'TransformMatrix' is not of 9 numbers");
    volume.axes = Eigen::Matrix3d(numbers.data());  // a direction after the other
  }
  // Of both the spacing is that of the points, the size that of what is measured around each.
  const std::vector<double> spacing = three_numbers({"ElementSpacing", "ElementSize"});
  for (std::size_t i = 0; i < spacing.size(); ++i) {
    volume.axes.col(static_cast<Eigen::Index>(i)) *= spacing[i];
  }
  const std::vector<double> origin = three_numbers({"Offset", "Position", "Origin"});
  if (!origin.empty()) volume.origin = Eigen::Vector3d(origin.data());
  if (const auto channels = header_.find({"ElementNumberOfChannels"})) {
    const std::vector<std::size_t> count = header_.counts("ElementNumberOfChannels", *channels, 1);
    constexpr std::size_t kMost = 1U << 20U;
    volume.components = static_cast<int>(std::min(count.empty() ? 1 : count[0], kMost));
  }
}

ValueType MetaImageReader::value_type() const {
  struct Name {
    std::string_view name;
    ValueType type;
  };
  constexpr auto kNames = std::to_array<Name>({{"MET_CHAR", ValueType::int8},
                                               {"MET_UCHAR", ValueType::uint8},
                                               {"MET_SHORT", ValueType::int16},
                                               {"MET_USHORT", ValueType::uint16},
                                               {"MET_INT", ValueType::int32},
                                               {"MET_UINT", ValueType::uint32},
                                               {"MET_LONG", ValueType::int32},
                                               {"MET_ULONG", ValueType::uint32},
                                               {"MET_LONG_LONG", ValueType::int64},
                                               {"MET_ULONG_LONG", ValueType::uint64},
                                               {"MET_FLOAT", ValueType::float32},
                                               {"MET_DOUBLE", ValueType::float64}});
  std::string_view name = header_.get({"ElementType"});
  std::string scalar(name);
  if (const std::size_t array = scalar.find("_ARRAY"); array != std::string::npos) {
    scalar.erase(array);
  }
  const auto* found = std::ranges::find(kNames, scalar, &Name::name);
  if (found == kNames.end()) header_.fail(fmt::format("its type '{:.40}' is not known", name));
  return found->type;
}

/// The lines that follow the head.
std::vector<std::string> MetaImageReader::listed_files() const {
  std::vector<std::string> names;
  std::string_view rest = std::string_view(content_).substr(at_);
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view name = trimmed(rest.substr(0, end));
    if (!name.empty()) names.emplace_back(name);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return names;
}

Volume MetaImageReader::read() {
  read_header();
  Volume volume;
  place(volume);
  const ValueType type = value_type();
  std::string other_file;
  std::string_view bytes = std::string_view(content_).substr(at_);
  const std::string_view data_file = header_.get({"ElementDataFile"});
  const bool is_listed = data_file.starts_with("LIST");
  const bool several = is_listed || data_file.find('%') != std::string_view::npos;
  if (!several && data_file != "LOCAL" && data_file != "Local" && data_file != "local") {
    other_file = content_of(header_.beside(data_file));
    bytes = other_file;
  }
  const bool is_text = header_.find({"BinaryData"}) && !is_true({"BinaryData"});
  const Packing packing = is_true({"CompressedData"}) ? Packing::gzip
                          : is_text                   ? Packing::text
                                                      : Packing::none;
  std::int64_t skip = 0;
  if (const auto value = header_.find({"HeaderSize"})) {
    const std::vector<double> size = header_.numbers("HeaderSize", *value);
    constexpr double kMost = 1e15;
    if (size.size() != 1 || !(size[0] >= -1 && size[0] < kMost) || size[0] != std::floor(size[0])) {
      header_.fail("'HeaderSize' is neither -1 nor a number of bytes");
    }
    skip = static_cast<std::int64_t>(size[0]);
  }
  if (several) {
    if (packing != Packing::none || skip < 0) {
      header_.fail(
          "its values are in several files, which are read raw only, from a known byte on");
    }
    other_file = header_.joined(is_listed ? listed_files() : header_.numbered(data_file),
                                static_cast<std::size_t>(skip));
    bytes = other_file;
    skip = 0;
  }
  if (packing == Packing::gzip && skip > 0) {  // the head of a packed file is not packed
    bytes.remove_prefix(std::min<std::size_t>(bytes.size(), static_cast<std::size_t>(skip)));
    skip = 0;
  }
  take_values(volume, bytes, packing, type,
              is_true({"BinaryDataByteOrderMSB", "ElementByteOrderMSB"}), skip);
  return volume;
}

}  // namespace

Volume read_metaimage(const std::string& file) {
  return MetaImageReader(file).read();
}

}  // namespace tetraglass::mesh
