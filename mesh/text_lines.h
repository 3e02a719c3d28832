#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tetraglass::mesh {

/// The lines of a text file that have words in them, one after the other; a comment lasts from its
/// character to the end of the line. Errors name the file and the line.
class TextLines {
 public:
  /// Throws ReadError where the file cannot be read.
  explicit TextLines(const std::string& file, char comment = '#');
  TextLines(const TextLines&) = delete;  // the words look into the content
  TextLines& operator=(const TextLines&) = delete;

  /// Goes on to the next line with words; false at the end of the file.
  bool next();
  /// As `next`, but the end of the file is an error: "ends where WHAT should be".
  void expect(const std::string& what);

  [[nodiscard]] const std::vector<std::string_view>& words() const { return words_; }

  /// Word `i` of the line as a number. Throws ReadError if it is none or is not there.
  [[nodiscard]] double number(std::size_t i) const;
  [[nodiscard]] std::int64_t integer(std::size_t i) const;
  /// A number of things that the file goes on to list; it cannot be larger than the file.
  [[nodiscard]] std::size_t count(std::size_t i, const std::string& things) const;
  /// An index into `size` things, of which the first has the number `base`; the result counts from
  /// 0.
  [[nodiscard]] std::uint32_t index(std::size_t i, std::size_t size, std::int64_t base = 0) const;

  /// As `index`, for a word as in Wavefront files: I, I/T, I/T/N or I//N, where I counts from 1, or
  /// back from the last point if it is negative.
  [[nodiscard]] std::uint32_t obj_index(std::size_t i, std::size_t size) const;

  /// Throws ReadError: "FILE: line N: WHAT".
  [[noreturn]] void fail(const std::string& what) const;

 private:
  [[nodiscard]] std::string_view word(std::size_t i) const;
  [[nodiscard]] std::int64_t integer(std::string_view text) const;
  [[nodiscard]] std::uint32_t checked_index(std::int64_t value, std::size_t size,
                                            std::int64_t base) const;

  std::string file_;
  std::string content_;
  std::size_t at_ = 0;
  std::size_t line_ = 0;
  char comment_;
  std::vector<std::string_view> words_;
};

}  // namespace tetraglass::mesh
