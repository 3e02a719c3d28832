#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace tetraglass::mesh {

/// Whether the bytes (the first few thousand are looked at) are printable characters and spaces.
[[nodiscard]] bool is_text(std::string_view bytes);

/// One number as C and Fortran write it (1.5, -2e-3, 1.5D+03, nan, inf); nothing if there is more
/// or less.
[[nodiscard]] std::optional<double> parse_number(std::string_view word);

/// Whether Fortran's repetition (3*0.5) is a way to write numbers.
enum class Repetition { refused, allowed };

/// All numbers of a text that holds nothing else, between spaces or commas; repetition is written
/// out, to 2^28 numbers at most. Nothing if a word is no number.
[[nodiscard]] std::optional<std::vector<double>> parse_numbers(
    std::string_view text, Repetition repetition = Repetition::refused);

}  // namespace tetraglass::mesh
