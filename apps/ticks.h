#pragma once

#include <string>
#include <vector>

namespace tetraglass::apps {

/// Values of a scale that are marked, and what is written there.
struct Ticks {
  std::vector<double> values;       ///< ascending
  std::vector<std::string> labels;  ///< UTF-8; of each value, divided by 10^exponent
  int exponent = 0;                 ///< 0: labels say the values themselves
};

/// The multiples of 1, 2 or 5 times a power of ten in [low, high], as narrow as there are at most
/// `most` (>= 2) of them; the value itself where low == high. Finite, low <= high.
[[nodiscard]] Ticks linear_ticks(double low, double high, int most);

/// The same for a logarithmic scale, 0 < low <= high: powers of ten (where there are too many each
/// second, third, ...), with their multiples by 2 and 5 where there is room; linear ones where the
/// range is too narrow for three of these.
[[nodiscard]] Ticks logarithmic_ticks(double low, double high, int most);

/// A number for people: at most `digits` significant digits, without trailing zeros.
[[nodiscard]] std::string number_text(double value, int digits = 6);

/// "10" with the exponent raised, such as 10⁻³.
[[nodiscard]] std::string power_of_ten(int exponent);

}  // namespace tetraglass::apps
