#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/volume.h"

namespace tetraglass::mesh {

/// The words of a text between spaces.
[[nodiscard]] std::vector<std::string_view> words_of(std::string_view text);

/// A text without the spaces at its ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// The head of a file of a volume: values in text by their keys (in lower case).
class VolumeHeader {
 public:
  explicit VolumeHeader(std::string file) : file_(std::move(file)) {}

  /// Of a key that is there twice the first value counts.
  void add(std::string key, std::string value) { values_.try_emplace(std::move(key), value); }

  /// The value of the first of the keys that is there; nothing if none is.
  [[nodiscard]] std::optional<std::string_view> find(
      std::initializer_list<std::string_view> keys) const;
  /// As `find`. Throws ReadError where no such key is.
  [[nodiscard]] std::string_view get(std::initializer_list<std::string_view> keys) const;

  /// Whole numbers (of at least `least`) and numbers of a value, between spaces. Throw ReadError.
  [[nodiscard]] std::vector<std::size_t> counts(std::string_view key, std::string_view value,
                                                std::size_t least) const;
  [[nodiscard]] std::vector<double> numbers(std::string_view key, std::string_view value) const;
  /// A file that is named by the value, beside this one. Throws ReadError where there is none.
  [[nodiscard]] std::string beside(std::string_view name) const;

  /// The names that "PATTERN MIN MAX STEP" stands for, as in C: PATTERN has one %d, %i or %u, which
  /// may have a width and zeros before it. Throws ReadError.
  [[nodiscard]] std::vector<std::string> numbered(std::string_view value) const;
  /// What the files beside this one hold, one after the other, each without its first `skip` bytes.
  /// Throws ReadError where one is missing or is shorter.
  [[nodiscard]] std::string joined(const std::vector<std::string>& names, std::size_t skip) const;

  /// Throws ReadError: "FILE: WHAT".
  [[noreturn]] void fail(const std::string& what) const;

 private:
  std::string file_;
  std::map<std::string, std::string, std::less<>> values_;
};

/// How values are stored.
enum class Packing : std::uint8_t { none, gzip, bzip2, text };

/// Puts the values into the volume (whose size and components are known): `bytes` from the first
/// one on, in `packing`; `skip` bytes of those that are unpacked come first (-1: the values are the
/// last bytes). Throws InputError where they are not all there.
void take_values(Volume& volume, std::string_view bytes, Packing packing, ValueType type,
                 bool big_endian, std::int64_t skip = 0);

}  // namespace tetraglass::mesh
