#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace tetraglass::mesh {

/// Takes numbers one after the other from the content of a file, written as words or in binary,
/// where each has the size that its function says. Errors name the file and the place.
class NumberStream {
 public:
  /// Throws ReadError where the file cannot be read.
  explicit NumberStream(const std::string& file);

  void set_binary(bool binary) { binary_ = binary; }
  void set_swapped(bool swapped) { swapped_ = swapped; }  ///< the byte order is not this machine's
  [[nodiscard]] bool binary() const { return binary_; }

  [[nodiscard]] std::size_t position() const { return at_; }
  void seek(std::size_t position) { at_ = position; }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }
  [[nodiscard]] const std::string& file() const { return file_; }

  /// The rest of the line, without spaces at its ends; false at the end of the file.
  bool line(std::string_view& text);
  /// The next word, whether or not the numbers are in binary; empty at the end of the file.
  std::string_view word();

  std::int32_t int32();
  std::int64_t int64();
  float float32();
  double float64();
  /// A count of things (64 bits) that take at least a byte each.
  std::size_t count(const char* things);

  /// Throws ReadError: "FILE: WHAT (at byte N)".
  [[noreturn]] void fail(const std::string& what) const;

 private:
  template <typename T>
  T take();

  std::string file_;
  std::string bytes_;
  std::size_t at_ = 0;
  bool binary_ = false;
  bool swapped_ = false;
};

}  // namespace tetraglass::mesh
