#include "mesh/medit_sections.h"

#include <cctype>

#include <fmt/format.h>

#include "mesh/number_text.h"

namespace tetraglass::mesh {
namespace {

constexpr std::int32_t kMark = 1;
constexpr std::int32_t kSwappedMark = 1 << 24;

}  // namespace

MeditSections::MeditSections(const std::string& file) : in_(file) {
  // Text begins with a word; a binary file with the number 1, which has bytes of 0.
  in_.set_binary(in_.bytes().substr(0, 4).find('\0') != std::string::npos);
  if (in_.binary()) {
    const std::int32_t mark = in_.int32();
    if (mark != kMark && mark != kSwappedMark) in_.fail("is no Medit file");
    in_.set_swapped(mark == kSwappedMark);
    version_ = in_.int32();
    if (version_ < 1 || version_ > 4) {
      in_.fail(fmt::format("has the version {} of Medit's format, which is not known", version_));
    }
    end_ = in_.position();
    return;
  }
  const std::string_view first = word();
  if (first == "MFEM") {
    in_.fail("is a mesh of MFEM, not of Medit; write it as .vtk or .vtu there");
  }
  if (first != "MeshVersionFormatted") {
    in_.fail("is no Medit file: it does not begin with 'MeshVersionFormatted'");
  }
  word();
}

/// A comment lasts from # to the end of its line.
std::string_view MeditSections::word() {
  while (true) {
    const std::string_view text = in_.word();
    if (!text.starts_with('#')) return text;
    in_.seek(in_.position() - text.size());
    std::string_view rest;
    in_.line(rest);
  }
}

bool MeditSections::next() {
  return in_.binary() ? next_block() : next_word();
}

/// A name is the next word that is no number.
bool MeditSections::next_word() {
  do {
    name_ = word();
    if (name_.empty() || name_ == "End") return false;
  } while (std::isalpha(static_cast<unsigned char>(name_[0])) == 0 || parse_number(name_));
  return true;
}

bool MeditSections::next_block() {
  constexpr std::int32_t kEnd = 54;
  if (end_ >= in_.bytes().size()) return false;
  in_.seek(end_);
  number_ = in_.int32();
  if (number_ == kEnd) return false;
  const std::int64_t end = version_ >= 3 ? in_.int64() : in_.int32();
  if (end < static_cast<std::int64_t>(in_.position()) ||
      end > static_cast<std::int64_t>(in_.bytes().size())) {
    in_.fail(fmt::format("section {} ends at byte {} of {}", number_, end, in_.bytes().size()));
  }
  end_ = static_cast<std::size_t>(end);
  return true;
}

bool MeditSections::is(std::string_view name, int number) const {
  return in_.binary() ? number_ == number : name_ == name;
}

std::string MeditSections::name() const {
  return in_.binary() ? fmt::format("section {}", number_) : std::string(name_);
}

std::int64_t MeditSections::integer() {
  if (in_.binary()) return version_ >= 4 ? in_.int64() : in_.int32();
  const std::string_view text = word();
  const auto value = parse_number(text);
  constexpr double kMost = 9e15;
  if (!value || !(*value >= -kMost && *value <= kMost) ||
      *value != static_cast<double>(static_cast<std::int64_t>(*value))) {
    in_.fail(text.empty() ? fmt::format("ends within {}", name_)
                          : fmt::format("'{:.40}' in {} is no whole number", text, name_));
  }
  return static_cast<std::int64_t>(*value);
}

double MeditSections::real() {
  if (in_.binary()) return version_ == 1 ? in_.float32() : in_.float64();
  const std::string_view text = word();
  const auto value = parse_number(text);
  if (!value) {
    in_.fail(text.empty() ? fmt::format("ends within {}", name_)
                          : fmt::format("'{:.40}' in {} is no number", text, name_));
  }
  return *value;
}

std::size_t MeditSections::count(std::size_t numbers) {
  const std::int64_t value = integer();
  if (value < 0) in_.fail(fmt::format("{} has {} entries", name(), value));
  expect(static_cast<std::size_t>(value), numbers);
  return static_cast<std::size_t>(value);
}

void MeditSections::expect(std::size_t entries, std::size_t numbers) const {
  // A number takes at least a digit and a space, or four bytes.
  const std::size_t least = numbers * (in_.binary() ? 4 : 2);
  const std::size_t left = in_.bytes().size() - in_.position() + 1;
  if (least > 0 && entries > left / least) {
    in_.fail(fmt::format("{} entries of {} cannot be in the {} bytes that are left", entries,
                         name(), left));
  }
}

std::uint32_t MeditSections::index(std::size_t size) {
  const std::int64_t value = integer();
  if (value < 1 || static_cast<std::uint64_t>(value) > size) {
    in_.fail(fmt::format("{} names point {}, but there are points 1 to {}", name(), value, size));
  }
  return static_cast<std::uint32_t>(value - 1);
}

}  // namespace tetraglass::mesh
