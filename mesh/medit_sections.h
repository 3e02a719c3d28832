#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "mesh/number_stream.h"

namespace tetraglass::mesh {

/// Goes through the sections of a file in Medit's format, text or binary.
class MeditSections {
 public:
  /// Throws ReadError where the file is no such file.
  explicit MeditSections(const std::string& file);

  /// Goes on to the next section, past what is left of this one; false at the end.
  bool next();

  /// Whether the section has this name, in text, or this number, in binary.
  [[nodiscard]] bool is(std::string_view name, int number) const;
  [[nodiscard]] std::string name() const;

  /// The next numbers of the section.
  std::int64_t integer();
  double real();
  /// The number of entries that the section begins with, which take at least `numbers` numbers
  /// each.
  std::size_t count(std::size_t numbers);
  /// Throws ReadError where so many entries of so many numbers each cannot follow.
  void expect(std::size_t entries, std::size_t numbers) const;
  /// An index of one of `size` things, counted from 1; the result counts from 0.
  std::uint32_t index(std::size_t size);

  [[noreturn]] void fail(const std::string& what) const { in_.fail(what); }

 private:
  std::string_view word();
  bool next_word();
  bool next_block();

  NumberStream in_;
  std::int32_t version_ = 1;
  std::string_view name_;     ///< in text
  std::int32_t number_ = -1;  ///< in binary
  std::size_t end_ = 0;       ///< of the section, in binary
};

}  // namespace tetraglass::mesh
