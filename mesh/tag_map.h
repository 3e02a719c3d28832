#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace tetraglass::mesh {

/// The place of each number in a list of numbers (those that a file gives its points and cells):
/// the first place, of a number that is there more than once.
class TagMap {
 public:
  static constexpr std::uint32_t kAbsent = 0xffffffffU;

  TagMap() = default;
  explicit TagMap(std::span<const std::uint64_t> tags);

  /// Where `tag` is in the list; `kAbsent` if it is not.
  [[nodiscard]] std::uint32_t find(std::uint64_t tag) const;

 private:
  std::vector<std::uint32_t> dense_;  ///< by tag, where tags are not much larger than their number
  std::unordered_map<std::uint64_t, std::uint32_t> sparse_;
};

}  // namespace tetraglass::mesh
