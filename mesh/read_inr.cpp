#include <array>

#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/file_name.h"
#include "mesh/read_volume.h"
#include "mesh/volume_header.h"

namespace tetraglass::mesh {
namespace {

ValueType value_type(const VolumeHeader& header) {
  const std::string_view kind = header.get({"TYPE"});
  const std::string_view bits = header.get({"PIXSIZE"});
  struct Name {
    std::string_view kind;
    std::string_view bits;
    ValueType type;
  };
  constexpr auto kNames = std::to_array<Name>({{"unsigned fixed", "8 bits", ValueType::uint8},
                                               {"unsigned fixed", "16 bits", ValueType::uint16},
                                               {"unsigned fixed", "32 bits", ValueType::uint32},
                                               {"unsigned fixed", "64 bits", ValueType::uint64},
                                               {"signed fixed", "8 bits", ValueType::int8},
                                               {"signed fixed", "16 bits", ValueType::int16},
                                               {"signed fixed", "32 bits", ValueType::int32},
                                               {"signed fixed", "64 bits", ValueType::int64},
                                               {"float", "32 bits", ValueType::float32},
                                               {"float", "64 bits", ValueType::float64}});
  for (const Name& name : kNames) {
    if (name.kind == kind && name.bits == bits) return name.type;
  }
  header.fail(fmt::format("its type '{:.40}' of '{:.40}' is not known", kind, bits));
}

}  // namespace

Volume read_inr(const std::string& file) {
  const std::string content = content_of(file);
  VolumeHeader header(file);
  const std::size_t end = content.find("##}");
  if (!content.starts_with("#INRIMAGE-4#{") || end == std::string::npos) {
    header.fail("is no INRIMAGE-4 file: its head does not go from '#INRIMAGE-4#{' to '##}'");
  }
  std::string_view text = std::string_view(content).substr(0, end);
  while (!text.empty()) {
    const std::size_t stop = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, stop);
    text.remove_prefix(std::min(stop + 1, text.size()));
    const std::size_t equals = line.find('=');
    if (line.starts_with('#') || equals == std::string_view::npos) continue;
    header.add(std::string(trimmed(line.substr(0, equals))),
               std::string(trimmed(line.substr(equals + 1))));
  }
  constexpr std::array<std::array<std::string_view, 3>, 3> kKeys = {
      {{"XDIM", "VX", "TX"}, {"YDIM", "VY", "TY"}, {"ZDIM", "VZ", "TZ"}}};
  Volume volume;
  const auto number = [&](std::string_view key, double otherwise) {
    const auto value = header.find({key});
    if (!value) return otherwise;
    const std::vector<double> numbers = header.numbers(key, *value);
    if (numbers.size() != 1) header.fail(fmt::format("its '{}' is not one number", key));
    return numbers[0];
  };
  const auto count = [&](std::string_view key) {
    const std::vector<std::size_t> counts = header.counts(key, header.get({key}), 1);
    if (counts.size() != 1) header.fail(fmt::format("its '{}' is not one number", key));
    return counts[0];
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    volume.size[i] = count(kKeys[i][0]);
    volume.axes(axis, axis) = number(kKeys[i][1], 1);
    volume.origin[axis] = number(kKeys[i][2], 0);
  }
  if (header.find({"VDIM"})) {
    constexpr std::size_t kMost = 1U << 20U;
    volume.components = static_cast<int>(std::min(count("VDIM"), kMost));
  }
  const std::string_view machine = header.find({"CPU"}).value_or("decm");
  const bool big_endian = machine == "sun" || machine == "sgi";
  // The head is filled up to a multiple of 256 bytes.
  constexpr std::size_t kBlock = 256;
  const std::size_t start = (end + 3 + kBlock - 1) / kBlock * kBlock;
  take_values(volume, std::string_view(content).substr(std::min(start, content.size())),
              Packing::none, value_type(header), big_endian);
  return volume;
}

}  // namespace tetraglass::mesh
