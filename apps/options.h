#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "base/errors.h"
#include "base/suggest.h"

/// Values as the command line spells them. All throw UsageError, naming the option.
namespace tetraglass::apps {

/// A finite number.
[[nodiscard]] double parse_number(std::string_view text, std::string_view option);

/// A whole number >= `least`, such as 1000000 or 1e6.
[[nodiscard]] int parse_count(std::string_view text, std::string_view option, int least);

/// A whole number of bytes >= 1, such as 500000000 or 5e8.
[[nodiscard]] std::size_t parse_bytes(std::string_view text, std::string_view option);

/// Between `least` and `most` numbers with commas between them.
[[nodiscard]] std::vector<double> parse_numbers(std::string_view text, std::string_view option,
                                                std::size_t least, std::size_t most);

/// X,Y,Z.
[[nodiscard]] Eigen::Vector3d parse_vector(std::string_view text, std::string_view option);

/// +x, -y, z, ... or X,Y,Z; not zero.
[[nodiscard]] Eigen::Vector3d parse_direction(std::string_view text, std::string_view option);

/// WxH.
[[nodiscard]] std::pair<int, int> parse_size(std::string_view text, std::string_view option);

/// Throws UsageError where so many samples of so many pixels are more than a picture can have.
void check_side(int pixels, int samples);

/// LO:HI, LO < HI or equal.
[[nodiscard]] std::pair<double, double> parse_range(std::string_view text, std::string_view option);

/// The value that belongs to a name.
template <typename Value>
[[nodiscard]] Value parse_choice(const std::string& text, const std::string& option,
                                 const std::vector<std::pair<std::string, Value>>& choices) {
  std::vector<std::string> names;
  for (const auto& [name, value] : choices) {
    if (name == text) return value;
    names.push_back(name);
  }
  throw base::UsageError(option + " cannot be '" + text + "'" + base::suggestion(text, names));
}

}  // namespace tetraglass::apps
