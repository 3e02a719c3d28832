#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tetraglass::base {

/// The number of insertions, deletions, substitutions and swaps of neighbours that turn `a` into
/// `b` (optimal string alignment), ignoring case.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// Up to `count` of `known` that a person who typed `wrong` may have meant, nearest first: names
/// that contain it or that it contains, then names at an edit distance of at most a third of its
/// length + 1.
[[nodiscard]] std::vector<std::string> nearest_names(std::string_view wrong,
                                                     const std::vector<std::string>& known,
                                                     std::size_t count = 3);

/// A sentence for an error message: "; did you mean 'a' or 'b'?", else "; there are: a, b, c", else
/// "; there are none".
[[nodiscard]] std::string suggestion(std::string_view wrong, const std::vector<std::string>& known);

/// The same for the extension (".jpg", or "" of a name without one) of a file: "its extension
/// '.jpg' is not known; there are: .png .exr"; first those that one letter makes of it.
[[nodiscard]] std::string unknown_extension(std::string_view extension,
                                            const std::vector<std::string>& known);

}  // namespace tetraglass::base
