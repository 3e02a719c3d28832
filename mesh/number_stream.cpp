#include "mesh/number_stream.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>

#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/file_name.h"
#include "mesh/number_text.h"

namespace tetraglass::mesh {
namespace {

constexpr std::string_view kSpaces = " \t\r\n\f\v";

}  // namespace

NumberStream::NumberStream(const std::string& file) : file_(file), bytes_(content_of(file)) {}

bool NumberStream::line(std::string_view& text) {
  if (at_ >= bytes_.size()) return false;
  const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
  text = std::string_view(bytes_).substr(at_, end - at_);
  at_ = std::min(end + 1, bytes_.size());
  text.remove_prefix(std::min(text.find_first_not_of(kSpaces), text.size()));
  text = text.substr(0, text.find_last_not_of(kSpaces) + 1);
  return true;
}

std::string_view NumberStream::word() {
  // Everything up to the space is one, in text.
  const auto is_space = [](char c) { return static_cast<unsigned char>(c) <= ' '; };
  std::size_t start = at_;
  while (start < bytes_.size() && is_space(bytes_[start])) ++start;
  at_ = start;
  while (at_ < bytes_.size() && !is_space(bytes_[at_])) ++at_;
  return std::string_view(bytes_).substr(start, at_ - start);
}

template <typename T>
T NumberStream::take() {
  if (binary_) {
    std::array<char, sizeof(T)> raw{};
    if (bytes_.size() - at_ < sizeof(T)) fail("ends within its numbers");
    std::memcpy(raw.data(), bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    if (swapped_) std::ranges::reverse(raw);
    return std::bit_cast<T>(raw);
  }
  const std::string_view text = word();
  if (text.empty()) fail("ends within its numbers");
  if constexpr (std::is_floating_point_v<T>) {
    const auto value = parse_number(text);
    if (!value) fail(fmt::format("'{}' is no number", text));
    return static_cast<T>(*value);
  } else {
    T value{};
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || stop != text.data() + text.size()) {
      fail(fmt::format("'{}' is no whole number of {} bits", text, 8 * sizeof(T)));
    }
    return value;
  }
}

std::int32_t NumberStream::int32() {
  return take<std::int32_t>();
}
std::int64_t NumberStream::int64() {
  return take<std::int64_t>();
}
float NumberStream::float32() {
  return take<float>();
}
double NumberStream::float64() {
  return take<double>();
}

std::size_t NumberStream::count(const char* things) {
  const std::int64_t value = int64();
  if (value < 0 || static_cast<std::uint64_t>(value) > bytes_.size()) {
    fail(fmt::format("{} {} cannot be in a file of {} bytes", value, things, bytes_.size()));
  }
  return static_cast<std::size_t>(value);
}

void NumberStream::fail(const std::string& what) const {
  std::string printable = what;
  for (char& c : printable) {
    if (c < ' ' || c > '~') c = '.';
  }
  constexpr std::size_t kLongest = 200;
  if (printable.size() > kLongest) printable = printable.substr(0, kLongest) + "...";
  throw base::ReadError(file_, fmt::format("{} (at byte {})", printable, at_));
}

}  // namespace tetraglass::mesh
