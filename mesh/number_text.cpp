#include "mesh/number_text.h"

#include <algorithm>
#include <charconv>
#include <string>

namespace tetraglass::mesh {
namespace {

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == ',';
}

}  // namespace

bool is_text(std::string_view bytes) {
  constexpr std::size_t kEnough = 4096;
  return std::ranges::all_of(bytes.substr(0, kEnough), [](unsigned char c) {
    return (c >= ' ' && c < 127) || c == '\t' || c == '\n' || c == '\r' || c == '\f';
  });
}

std::optional<double> parse_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const char* end = word.data() + word.size();
  auto [stop, error] = std::from_chars(word.data(), end, value);
  if (error == std::errc::result_out_of_range && stop == end) {
    // Beyond the range of a double: as strtod has it, infinite or zero.
    return std::strtod(std::string(word).c_str(), nullptr);
  }
  if (error != std::errc()) return std::nullopt;
  if (stop == end) return value;
  if (*stop != 'd' && *stop != 'D') return std::nullopt;
  std::string with_e(word);
  with_e[static_cast<std::size_t>(stop - word.data())] = 'e';
  const char* e_end = with_e.data() + with_e.size();
  const auto again = std::from_chars(with_e.data(), e_end, value);
  if (again.ec != std::errc() || again.ptr != e_end) return std::nullopt;
  return value;
}

std::optional<std::vector<double>> parse_numbers(std::string_view text, Repetition repetition) {
  std::vector<double> numbers;
  for (std::size_t at = 0;;) {
    while (at < text.size() && is_space(text[at])) ++at;
    if (at == text.size()) return numbers;
    std::size_t end = at;
    while (end < text.size() && !is_space(text[end])) ++end;
    std::string_view word = text.substr(at, end - at);
    std::size_t times = 1;
    if (const std::size_t star = word.find('*'); star != std::string_view::npos) {
      const auto [stop, error] = std::from_chars(word.data(), word.data() + star, times);
      constexpr std::size_t kMost = std::size_t{1} << 28U;
      if (repetition == Repetition::refused || error != std::errc() || stop != word.data() + star ||
          times > kMost || numbers.size() > kMost - times) {
        return std::nullopt;
      }
      word.remove_prefix(star + 1);
    }
    const std::optional<double> value = parse_number(word);
    if (!value) return std::nullopt;
    numbers.insert(numbers.end(), times, *value);
    at = end;
  }
}

}  // namespace tetraglass::mesh
