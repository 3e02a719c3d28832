#include "mesh/volume_header.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <filesystem>

#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/decompress.h"
#include "mesh/file_name.h"
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

std::vector<std::string> VolumeHeader::numbered(std::string_view value) const {
  const std::vector<std::string_view> words = words_of(value);
  constexpr std::string_view kDigits = "0123456789";
  const std::string_view pattern = words.empty() ? std::string_view() : words[0];
  const std::size_t start = std::min(pattern.find('%'), pattern.size());
  const std::size_t end = std::min(pattern.find_first_not_of(kDigits, start + 1), pattern.size());
  const std::string_view width =
      pattern.substr(std::min(start + 1, end), end - std::min(start + 1, end));
  constexpr std::size_t kWidest = 20;
  const bool is_pattern = start < end && end < pattern.size() && width.size() <= 3 &&
                          std::string_view("diu").find(pattern[end]) != std::string_view::npos &&
                          pattern.find('%', end) == std::string_view::npos;
  if (!is_pattern || words.size() < 4) {
    fail(fmt::format("its values are in files '{:.60}': NAME%03d.EXTENSION MIN MAX STEP is needed",
                     value));
  }
  const std::string range = fmt::format("{} {} {}", words[1], words[2], words[3]);
  const std::vector<std::size_t> numbers = counts("data file", range, 0);
  constexpr std::size_t kMost = 1'000'000;
  if (numbers[2] == 0 || numbers[1] < numbers[0] ||
      (numbers[1] - numbers[0]) / numbers[2] >= kMost) {
    fail(fmt::format("the numbers of its files, '{:.60}', are no range", range));
  }
  std::size_t least = 0;
  std::from_chars(width.data(), width.data() + width.size(), least);
  least = std::min(least, kWidest);
  const char filler = width.starts_with('0') ? '0' : ' ';
  std::vector<std::string> names;
  for (std::size_t i = numbers[0]; i <= numbers[1]; i += numbers[2]) {
    std::string number = std::to_string(i);
    if (number.size() < least) number.insert(0, least - number.size(), filler);
    names.push_back(
        fmt::format("{}{}{}", pattern.substr(0, start), number, pattern.substr(end + 1)));
  }
  return names;
}

std::string VolumeHeader::joined(const std::vector<std::string>& names, std::size_t skip) const {
  std::string all;
  for (const std::string& name : names) {
    const std::string content = content_of(beside(name));
    if (content.size() < skip) fail(fmt::format("its file {} ends within the bytes to skip", name));
    all.append(content, skip);
  }
  return all;
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
