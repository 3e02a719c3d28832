#include "mesh/tag_map.h"

#include <algorithm>

namespace tetraglass::mesh {

TagMap::TagMap(std::span<const std::uint64_t> tags) {
  const std::uint64_t largest = tags.empty() ? 0 : *std::ranges::max_element(tags);
  // A table takes 4 bytes a tag, the map about 40 for each entry.
  constexpr std::uint64_t kTimes = 8;
  if (largest / kTimes <= tags.size()) dense_.assign(largest + 1, kAbsent);
  for (std::uint32_t i = 0; i < tags.size(); ++i) {
    if (dense_.empty()) {
      sparse_.try_emplace(tags[i], i);
    } else if (dense_[tags[i]] == kAbsent) {
      dense_[tags[i]] = i;
    }
  }
}

std::uint32_t TagMap::find(std::uint64_t tag) const {
  if (!dense_.empty()) return tag < dense_.size() ? dense_[tag] : kAbsent;
  const auto found = sparse_.find(tag);
  return found != sparse_.end() ? found->second : kAbsent;
}

}  // namespace tetraglass::mesh
