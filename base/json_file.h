#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tetraglass::base {

/// A value in a JSON file. Every complaint is a ReadError that names the file and the value's place
/// in it, as in "FILE: points[2].color must be a number, not null".
class JsonValue {
 public:
  /// The whole of a file. Throws ReadError where it cannot be read or is not JSON.
  [[nodiscard]] static JsonValue read(const std::string& file);

  /// Members of an object; all of them throw where this is none.
  [[nodiscard]] JsonValue member(const std::string& key) const;  ///< throws where it is missing
  [[nodiscard]] std::optional<JsonValue> find(const std::string& key) const;
  /// Throws where there is a member of another name, with the nearest right ones.
  void allow_only(const std::vector<std::string>& keys) const;

  /// The elements of a list; `what` names them in the complaint: "a list of points".
  [[nodiscard]] std::vector<JsonValue> list(const std::string& what) const;

  /// A list of exactly so many numbers; `what` says them: "three numbers: red, green, blue".
  [[nodiscard]] std::vector<double> numbers(std::size_t count, const std::string& what) const;
  [[nodiscard]] double number() const;
  [[nodiscard]] std::string text() const;

  /// The elements where this is a list.
  [[nodiscard]] std::optional<std::vector<JsonValue>> elements() const;
  /// A text, or a number, true or false as it is written.
  [[nodiscard]] std::string word() const;

  /// Throws ReadError: FILE: PLACE what.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  struct Node;
  explicit JsonValue(std::shared_ptr<const Node> node);
  [[nodiscard]] JsonValue inside(const void* json, const std::string& place) const;
  void require_object() const;
  /// Its place, as a complaint calls it.
  [[nodiscard]] std::string name() const;

  std::shared_ptr<const Node> node_;
};

}  // namespace tetraglass::base
