#include "base/suggest.h"

#include <algorithm>
#include <cctype>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tetraglass::base {
namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

}  // namespace

std::size_t edit_distance(std::string_view a_text, std::string_view b_text) {
  const std::string a = lower(a_text);
  const std::string b = lower(b_text);
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitution = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + substitution});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

std::vector<std::string> nearest_names(std::string_view wrong,
                                       const std::vector<std::string>& known, std::size_t count) {
  const std::string typed = lower(wrong);
  std::vector<std::pair<std::size_t, std::string>> ranked;
  for (const std::string& name : known) {
    const std::string candidate = lower(name);
    const bool contains =
        !typed.empty() && !candidate.empty() &&
        (candidate.find(typed) != std::string::npos || typed.find(candidate) != std::string::npos);
    const std::size_t distance = edit_distance(typed, candidate);
    if (contains) {
      ranked.emplace_back(0, name);
    } else if (distance <= typed.size() / 3 + 1) {
      ranked.emplace_back(distance, name);
    }
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> result;
  for (std::size_t i = 0; i < std::min(count, ranked.size()); ++i)
    result.push_back(ranked[i].second);
  return result;
}

std::string suggestion(std::string_view wrong, const std::vector<std::string>& known) {
  std::vector<std::string> near = nearest_names(wrong, known);
  if (!near.empty()) {
    for (std::string& name : near) name = fmt::format("'{}'", name);
    return fmt::format("; did you mean {}?", fmt::join(near, " or "));
  }
  if (known.empty()) return "; there are none";
  constexpr std::size_t kMost = 20;
  const bool all = known.size() <= kMost;
  return fmt::format(
      "; there are: {}{}",
      fmt::join(known.begin(), known.begin() + static_cast<long>(std::min(kMost, known.size())),
                ", "),
      all ? "" : ", ...");
}

std::string unknown_extension(std::string_view extension, const std::vector<std::string>& known) {
  const std::string there_are = fmt::format("; there are: {}", fmt::join(known, " "));
  if (extension.empty()) return "its name has no extension" + there_are;
  // They are so short that any two look alike at a distance of two.
  std::vector<std::string> near;
  std::ranges::copy_if(known, std::back_inserter(near), [&](const std::string& name) {
    return edit_distance(extension, name) == 1;
  });
  return fmt::format("its extension '{}' is not known{}{}", extension,
                     near.empty() ? "" : suggestion(extension, near), there_are);
}

}  // namespace tetraglass::base
