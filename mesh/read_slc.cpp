#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/file_name.h"
#include "mesh/number_text.h"
#include "mesh/read_volume.h"

namespace tetraglass::mesh {
namespace {

/// A head in text (magic number, sizes, spacing, units, compression), a small picture, and then
/// plane after plane.
class SlcReader {
 public:
  explicit SlcReader(const std::string& file) : file_(file), content_(content_of(file)) {}

  Volume read();

 private:
  [[noreturn]] void fail(const std::string& what) const { throw base::ReadError(file_, what); }
  std::string_view word();
  std::size_t count(const char* what);
  void expect_mark();
  std::string_view take(std::size_t size, const char* what);
  void unpack(std::string_view packed, std::size_t plane, std::vector<double>& values) const;

  std::string file_;
  std::string content_;
  std::size_t at_ = 0;
};

std::string_view SlcReader::word() {
  const auto is_space = [](char c) { return static_cast<unsigned char>(c) <= ' '; };
  while (at_ < content_.size() && is_space(content_[at_])) ++at_;
  const std::size_t start = at_;
  constexpr std::size_t kLongest = 64;
  while (at_ < content_.size() && at_ - start < kLongest && !is_space(content_[at_])) ++at_;
  return std::string_view(content_).substr(start, at_ - start);
}

std::size_t SlcReader::count(const char* what) {
  const std::string_view text = word();
  std::size_t value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size()) {
    fail(fmt::format("is no VolVis file, or is damaged: there is no number where its {} should be",
                     what));
  }
  return value;
}

/// An X stands between text and values in binary, which follow at once.
void SlcReader::expect_mark() {
  while (at_ < content_.size() && (content_[at_] == ' ' || content_[at_] == '\n')) ++at_;
  if (at_ >= content_.size() || content_[at_] != 'X') {
    fail("is damaged: an X should stand before its values");
  }
  ++at_;
}

std::string_view SlcReader::take(std::size_t size, const char* what) {
  if (content_.size() - at_ < size) {
    fail(fmt::format("is cut off: its {} takes {} bytes, it has {}", what, size,
                     content_.size() - at_));
  }
  at_ += size;
  return std::string_view(content_).substr(at_ - size, size);
}

/// Runs of bytes: a count, with the highest bit set for bytes that are written out, else for one
/// that is repeated; 0 ends the plane.
void SlcReader::unpack(std::string_view packed, std::size_t plane,
                       std::vector<double>& values) const {
  const std::size_t end = values.size() + plane;
  for (std::size_t i = 0; i < packed.size();) {
    const auto head = static_cast<unsigned char>(packed[i++]);
    const std::size_t length = head & 0x7fU;
    if (length == 0) break;
    const bool is_literal = (head & 0x80U) != 0;
    if (packed.size() - i < (is_literal ? length : 1) || end - values.size() < length) {
      fail("is damaged: a run of values goes beyond its plane");
    }
    for (std::size_t k = 0; k < length; ++k) {
      values.push_back(static_cast<unsigned char>(packed[is_literal ? i + k : i]));
    }
    i += is_literal ? length : 1;
  }
  if (values.size() != end) {
    fail(fmt::format("is damaged: a plane has {} values instead of {}",
                     plane - (end - values.size()), plane));
  }
}

Volume SlcReader::read() {
  constexpr std::size_t kMagic = 11111;
  if (count("magic number") != kMagic) fail("is no VolVis file: it does not begin with 11111");
  Volume volume;
  for (std::size_t& side : volume.size) side = count("size");
  if (const std::size_t bits = count("number of bits"); bits != 8) {
    fail(fmt::format("has values of {} bits; VolVis writes 8", bits));
  }
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto spacing = parse_number(word());
    if (!spacing) fail("is damaged: its spacing is no number");
    volume.axes(i, i) = *spacing;
  }
  count("unit");
  count("origin of the data");
  count("modification of the data");
  const std::size_t compression = count("compression");
  if (compression > 1) fail(fmt::format("its compression {} is not known", compression));
  const std::size_t width = count("picture's width");
  const std::size_t height = count("picture's height");
  expect_mark();
  constexpr std::size_t kMostPixels = 1U << 16U;
  if (width > kMostPixels || height > kMostPixels) fail("is damaged: its picture is too large");
  take(3 * width * height, "picture");
  const std::size_t values = checked_value_count(volume);
  const std::size_t plane = volume.size[0] * volume.size[1];
  // A byte tells of 127 values at most.
  if (values / 64 > content_.size()) {
    fail(fmt::format("is cut off: {} values cannot be in {} bytes", values, content_.size()));
  }
  volume.values.reserve(values);
  for (std::size_t k = 0; k < volume.size[2]; ++k) {
    if (compression == 0) {
      for (const char value : take(plane, "next plane")) {
        volume.values.push_back(static_cast<unsigned char>(value));
      }
      continue;
    }
    const std::size_t size = count("size of a plane");
    expect_mark();
    unpack(take(size, "next plane"), plane, volume.values);
  }
  return volume;
}

}  // namespace

Volume read_slc(const std::string& file) {
  return SlcReader(file).read();
}

}  // namespace tetraglass::mesh
