#include "mesh/volume_header.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <filesystem>

#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/decompress.h"
#include "mesh/number_text.h"

namespace tetraglass::mesh {
namespace {

constexpr std::string_view kSpaces = " \t\r\n\f\v";

}  // namespace

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  for (std::size_t start = text.find_first_not_of(kSpaces); start != std::string_view::npos;) {
    const std::size_t stop = std::min(text.find_first_of(kSpaces, start), text.size());
    words.push_back(text.substr(start, stop - start));
    start = text.find_first_not_of(kSpaces, stop);
  }
  return words;
}

std::string_view trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kSpaces), text.size()));
  return text.substr(0, text.find_last_not_of(kSpaces) + 1);
}

std::optional<std::string_view> VolumeHeader::find(
    std::initializer_list<std::string_view> keys) const {
  for (const std::string_view key : keys) {
    const auto found = values_.find(key);
    if (found != values_.end()) return found->second;
  }
  return std::nullopt;
}

std::string_view VolumeHeader::get(std::initializer_list<std::string_view> keys) const {
  const auto value = find(keys);
  if (!value) fail(fmt::format("its head lacks '{}'", *keys.begin()));
  return *value;
}

std::vector<std::size_t> VolumeHeader::counts(std::string_view key, std::string_view value,
                                              std::size_t least) const {
  std::vector<std::size_t> counts;
  for (const std::string_view word : words_of(value)) {
    std::size_t count = 0;
    const char* end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, count);
    if (error != std::errc() || stop != end || count < least) {
      fail(fmt::format("its head has '{}' where '{}' needs whole numbers from {} on", word, key,
                       least));
    }
    counts.push_back(count);
  }
  return counts;
}

std::vector<double> VolumeHeader::numbers(std::string_view key, std::string_view value) const {
  std::vector<double> numbers;
  for (const std::string_view word : words_of(value)) {
    const auto number = parse_number(word);
    if (!number) fail(fmt::format("its head has '{}' where '{}' needs numbers", word, key));
    numbers.push_back(*number);
  }
  return numbers;
}

std::string VolumeHeader::beside(std::string_view name) const {
  std::filesystem::path other = std::filesystem::path(file_);
  other.replace_filename(std::filesystem::path(name));
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(other, ignored)) {
    fail(fmt::format("its values should be in the file {}, which is missing", other.string()));
  }
  return other.string();
}

void VolumeHeader::fail(const std::string& what) const {
  throw base::ReadError(file_, what);
}

void take_values(Volume& volume, std::string_view bytes, Packing packing, ValueType type,
                 bool big_endian, std::int64_t skip) {
  const std::size_t count = checked_value_count(volume);
  if (packing == Packing::text) {
    auto numbers = parse_numbers(bytes);
    if (!numbers || numbers->size() != count) {
      throw base::InputError(
          numbers ? fmt::format("has {} values, but its head tells of {}", numbers->size(), count)
                  : "has a word that is no number among its values");
    }
    volume.values = std::move(*numbers);
    return;
  }
  const std::size_t size = count * size_of(type);
  std::string unpacked;
  if (packing != Packing::none) {
    // With the values at the end all has to be unpacked; no more than twice of them is honest.
    const std::size_t most = skip < 0 ? 2 * size : size + static_cast<std::size_t>(skip);
    unpacked = packing == Packing::gzip ? gunzip(bytes, most) : bunzip2(bytes, most);
    bytes = unpacked;
  }
  const std::size_t first = skip >= 0             ? static_cast<std::size_t>(skip)
                            : bytes.size() > size ? bytes.size() - size
                                                  : 0;
  if (first > bytes.size() || bytes.size() - first < size) {
    throw base::InputError(fmt::format("is cut off: its values take {} bytes, it has {}", size,
                                       bytes.size() - std::min(first, bytes.size())));
  }
  const bool swapped = big_endian != (std::endian::native == std::endian::big);
  volume.values = decode_values(bytes.substr(first, size), type, swapped);
}

}  // namespace tetraglass::mesh
