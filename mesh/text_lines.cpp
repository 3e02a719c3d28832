#include "mesh/text_lines.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/file_name.h"
#include "mesh/number_text.h"

namespace tetraglass::mesh {
namespace {

constexpr std::string_view kSpaces = " \t\r\f\v";

}  // namespace

TextLines::TextLines(const std::string& file, char comment)
    : file_(file), content_(content_of(file)), comment_(comment) {}

bool TextLines::next() {
  while (at_ < content_.size()) {
    const std::size_t end = std::min(content_.find('\n', at_), content_.size());
    std::string_view line = std::string_view(content_).substr(at_, end - at_);
    at_ = end + 1;
    ++line_;
    line = line.substr(0, line.find(comment_));
    words_.clear();
    for (std::size_t start = line.find_first_not_of(kSpaces); start != std::string_view::npos;) {
      const std::size_t stop = std::min(line.find_first_of(kSpaces, start), line.size());
      words_.push_back(line.substr(start, stop - start));
      start = line.find_first_not_of(kSpaces, stop);
    }
    if (!words_.empty()) return true;
  }
  words_.clear();
  return false;
}

void TextLines::expect(const std::string& what) {
  if (!next()) {
    throw base::ReadError(file_, fmt::format("ends at line {}, where {} should be", line_, what));
  }
}

std::string_view TextLines::word(std::size_t i) const {
  if (i >= words_.size()) {
    fail(fmt::format("{} {} where there should be more", words_.size(),
                     words_.size() == 1 ? "word" : "words"));
  }
  return words_[i];
}

double TextLines::number(std::size_t i) const {
  const auto value = parse_number(word(i));
  if (!value) fail(fmt::format("'{}' is no number", words_[i]));
  return *value;
}

std::int64_t TextLines::integer(std::size_t i) const {
  return integer(word(i));
}

std::int64_t TextLines::integer(std::string_view text) const {
  std::int64_t value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size()) {
    fail(fmt::format("'{}' is no whole number", text));
  }
  return value;
}

std::size_t TextLines::count(std::size_t i, const std::string& things) const {
  const std::int64_t value = integer(i);
  if (value < 0 || static_cast<std::uint64_t>(value) > content_.size()) {
    fail(fmt::format("{} {} cannot be in a file of {} bytes", value, things, content_.size()));
  }
  return static_cast<std::size_t>(value);
}

std::uint32_t TextLines::index(std::size_t i, std::size_t size, std::int64_t base) const {
  return checked_index(integer(i), size, base);
}

std::uint32_t TextLines::obj_index(std::size_t i, std::size_t size) const {
  const std::string_view text = word(i);
  const std::int64_t value = integer(text.substr(0, text.find('/')));
  return checked_index(value < 0 ? value + static_cast<std::int64_t>(size) + 1 : value, size, 1);
}

std::uint32_t TextLines::checked_index(std::int64_t value, std::size_t size,
                                       std::int64_t base) const {
  if (value < base || static_cast<std::uint64_t>(value - base) >= size) {
    fail(fmt::format("point {} is named, but there are {} points, counted from {}", value, size,
                     base));
  }
  return static_cast<std::uint32_t>(value - base);
}

void TextLines::fail(const std::string& what) const {
  throw base::ReadError(file_, fmt::format("line {}: {}", line_, what));
}

}  // namespace tetraglass::mesh
